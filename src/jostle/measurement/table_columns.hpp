#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "jostle/math/mat3.hpp"
#include "jostle/run_files/series_file.hpp"

namespace jostle {

/// A column of a table that a run writes: what it is, and its value in the row of an `Item`.
template <class Item>
struct Column {
    SeriesColumn about;
    std::function<double(const Item&)> value;
};

/// A table that a run writes, NAME.csv; NAME.json tells what its columns are.
template <class Item>
struct TableColumns {
    std::string name;
    std::vector<Column<Item>> columns;

    /// Adds one column for each of the names, alike but for their element: `value(item, k)`.
    template <class Names, class Value>
    void add_elements(const Names& names, const SeriesColumn& about, Value value) {
        std::size_t k = 0;
        for (const char* element : names) {
            SeriesColumn column = about;
            column.name = element;
            columns.push_back({std::move(column), [value, element_number = k++](const Item& item) {
                                   return value(item, element_number);
                               }});
        }
    }

    std::vector<SeriesColumn> about() const {
        std::vector<SeriesColumn> all;
        for (const auto& column : columns) all.push_back(column.about);
        return all;
    }

    std::vector<double> row(const Item& item) const {
        std::vector<double> values;
        for (const auto& column : columns) values.push_back(column.value(item));
        return values;
    }
};

/// Element k of xx xy xz yy yz zz of a symmetric tensor.
inline double upper_element(const Mat3& tensor, std::size_t k) {
    constexpr std::size_t place[] = {0, 1, 2, 4, 5, 8};
    return tensor.m[place[k]];
}

}  // namespace jostle
