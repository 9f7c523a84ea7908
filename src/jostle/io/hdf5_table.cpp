#include "jostle/io/hdf5_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "jostle/io/durable_file.hpp"
#include "jostle/io/hdf5_objects.hpp"

namespace jostle {

namespace {

std::vector<std::string> names_in(hid_t file) {
    const Hdf5Id group(H5Gopen2(file, "/", H5P_DEFAULT), "open the root group");
    H5G_info_t content;
    hdf5_checked(H5Gget_info(group, &content), "list the root group");
    std::vector<std::string> names;
    for (hsize_t k = 0; k < content.nlinks; ++k) {
        const auto size = hdf5_checked(
            H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT), "read a name");
        std::string name(static_cast<std::size_t>(size) + 1, '\0');
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
        name.pop_back();
        names.push_back(name);
    }
    return names;
}

/// `count` texts, of fixed or varying length, that `read` brings into memory of the given type.
template <class Read>
std::vector<std::string> texts(hid_t type, hid_t space, std::size_t count, Read&& read) {
    std::vector<std::string> found(count);
    const Hdf5Id memory(H5Tcopy(type), "copy a type");
    if (H5Tis_variable_str(type) > 0) {
        std::vector<char*> words(count);
        read(memory, words.data());
        for (std::size_t k = 0; k < count; ++k) found[k] = words[k] ? words[k] : "";
        H5Dvlen_reclaim(memory, space, H5P_DEFAULT, words.data());
        return found;
    }
    const std::size_t size = H5Tget_size(type);
    std::string words(count * size, '\0');
    read(memory, words.data());
    for (std::size_t k = 0; k < count; ++k) {
        const std::string word = words.substr(k * size, size);
        found[k] = word.substr(0, word.find('\0'));
    }
    return found;
}

std::string attribute(hid_t file, const char* name) {
    if (H5Aexists(file, name) <= 0) return "";
    const Hdf5Id attribute(H5Aopen(file, name, H5P_DEFAULT), "open an attribute");
    const Hdf5Id type(H5Aget_type(attribute), "read the type of an attribute");
    const Hdf5Id space(H5Aget_space(attribute), "read the size of an attribute");
    if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
        throw Hdf5Failure{fmt::format("read the attribute {}", name), "it is no text", 0};
    return texts(type, space, 1, [&](hid_t memory, void* into) {
        hdf5_checked(H5Aread(attribute, memory, into), "read an attribute");
    })[0];
}

/// A dataset of one dimension; all must be as long as `rows` says, once it does.
class Column {
public:
    Column(hid_t file, const std::string& name, std::optional<std::size_t>& rows)
        : name_(name),
          dataset_(H5Dopen2(file, name.c_str(), H5P_DEFAULT), "open a dataset"),
          type_(H5Dget_type(dataset_), "read the type of a dataset"),
          space_(H5Dget_space(dataset_), "read the size of a dataset") {
        if (H5Sget_simple_extent_ndims(space_) != 1) refuse("it has not one dimension");
        count_ = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space_));
        if (!rows) rows = count_;
        if (count_ != *rows) refuse(fmt::format("it has {} rows, others have {}", count_, *rows));
    }

    std::vector<double> numbers() const {
        const H5T_class_t kind = H5Tget_class(type_);
        if (kind != H5T_INTEGER && kind != H5T_FLOAT) refuse("it holds no numbers");
        std::vector<double> values(count_);
        hdf5_checked(H5Dread(dataset_, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                     "read a dataset");
        return values;
    }

    std::vector<std::string> words() const {
        if (H5Tget_class(type_) != H5T_STRING) refuse("it holds no texts");
        return texts(type_, space_, count_, [&](hid_t memory, void* into) {
            hdf5_checked(H5Dread(dataset_, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, into), "read a dataset");
        });
    }

private:
    [[noreturn]] void refuse(std::string reason) const {
        throw Hdf5Failure{fmt::format("take the dataset {} as a column", name_), std::move(reason), 0};
    }

    std::string name_;
    Hdf5Id dataset_, type_, space_;
    std::size_t count_ = 0;
};

bool is_in(const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void read_columns(Table& table, hid_t file, const KnownColumns& known) {
    table.names = names_in(file);
    table.units = {attribute(file, "length_unit"), attribute(file, "force_unit")};
    std::optional<std::size_t> rows;
    for (const std::string& name : table.names) {
        if (is_in(name, known.numbers)) table.numbers[name] = Column(file, name, rows).numbers();
        if (is_in(name, known.words)) table.words[name] = Column(file, name, rows).words();
    }
    table.rows = rows.value_or(0);
}

}  // namespace

Table read_hdf5_table(const std::string& path, const KnownColumns& known) {
    const QuietHdf5 quiet;
    Table table(path);
    try {
        const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it as HDF5");
        read_columns(table, file, known);
    } catch (const Hdf5Failure& failure) {
        throw refused_file(path, fmt::format("cannot {}: {}", failure.operation, failure.reason), "");
    }
    for (auto& [name, column] : table.numbers)
        for (std::size_t row = 0; row < table.rows; ++row)
            if (std::isinf(column[row])) table.problems.add(row, fmt::format("{} is infinite", name));
    return table;
}

}  // namespace jostle
