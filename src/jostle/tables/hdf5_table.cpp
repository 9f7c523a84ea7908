#include "jostle/tables/hdf5_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/disk/hdf5_objects.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/tables/bytes_from_child.hpp"

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

[[noreturn]] void refuse_column(const std::string& name, std::string reason) {
    throw Hdf5Failure{fmt::format("take the dataset {} as a column", on_one_line(name)), std::move(reason), 0};
}

/// Opens a dataset of this file: a link to another one would read what the user has not named.
Hdf5Id opened_dataset(hid_t file, const std::string& name) {
    const Hdf5Id access(H5Pcreate(H5P_DATASET_ACCESS), "make a property list");
    const auto refuse_link = [](const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) -> herr_t {
        return -1;
    };
    hdf5_checked(H5Pset_elink_cb(access, refuse_link, nullptr), "set a property");
    H5L_info_t link;
    hdf5_checked(H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT), "read a link");
    if (link.type == H5L_TYPE_EXTERNAL) refuse_column(name, "it is a link to another file");
    H5O_info_t object;
    if (H5Oget_info_by_name(file, name.c_str(), &object, access) < 0) refuse_column(name, "it leads nowhere");
    if (object.type != H5O_TYPE_DATASET) refuse_column(name, "it is no dataset");
    const hid_t dataset = H5Dopen2(file, name.c_str(), access);
    if (dataset < 0) refuse_column(name, "it cannot be opened");
    return Hdf5Id(dataset, "open a dataset");
}

/// A dataset of one dimension; all must be as long as `rows` says, once it does.
class Column {
public:
    Column(hid_t file, const std::string& name, std::optional<std::size_t>& rows)
        : name_(name),
          dataset_(opened_dataset(file, name)),
          type_(H5Dget_type(dataset_), "read the type of a dataset"),
          space_(H5Dget_space(dataset_), "read the size of a dataset") {
        if (H5Sget_simple_extent_ndims(space_) != 1) refuse_column(name_, "it has not one dimension");
        count_ = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space_));
        require_stored(file);
        if (!rows) rows = count_;
        if (count_ != *rows) refuse_column(name_, fmt::format("it has {} rows, others have {}", count_, *rows));
    }

    std::vector<double> numbers() const {
        const H5T_class_t kind = H5Tget_class(type_);
        if (kind != H5T_INTEGER && kind != H5T_FLOAT) refuse_column(name_, "it holds no numbers");
        std::vector<double> values(count_);
        hdf5_checked(H5Dread(dataset_, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                     "read a dataset");
        return values;
    }

    std::vector<std::string> words() const {
        if (H5Tget_class(type_) != H5T_STRING) refuse_column(name_, "it holds no texts");
        return texts(type_, space_, count_, [&](hid_t memory, void* into) {
            hdf5_checked(H5Dread(dataset_, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, into), "read a dataset");
        });
    }

private:
    /// A few bytes may claim more rows than any memory holds; and the rows must lie in this file.
    void require_stored(hid_t file) const {
        const Hdf5Id made(H5Dget_create_plist(dataset_), "read how a dataset is stored");
        if (H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) > 0)
            refuse_column(name_, "its rows lie in another file");
        hsize_t in_file = 0;
        hdf5_checked(H5Fget_filesize(file, &in_file), "read the size of the file");
        constexpr double densest = 1100.0, small = 1 << 20;  // deflate makes 1032 bytes of one at most
        const auto stored = static_cast<double>(std::min(H5Dget_storage_size(dataset_), in_file));
        if (static_cast<double>(count_) * static_cast<double>(H5Tget_size(type_)) > densest * stored + small)
            refuse_column(name_, fmt::format("it claims {} rows, and {} bytes of them are there", count_, stored));
    }

    std::string name_;
    Hdf5Id dataset_, type_, space_;
    std::size_t count_ = 0;
};

void put_table(ByteWriter& to, const Table& table) {
    const auto put_texts = [&](const std::vector<std::string>& texts) {
        to.put(std::uint64_t{texts.size()});
        for (const std::string& text : texts) to.put_text(text);
    };
    put_texts(table.names);
    put_texts({table.units.length, table.units.force});
    to.put(std::uint64_t{table.rows});
    to.put(std::uint64_t{table.numbers.size()});
    for (const auto& [name, column] : table.numbers) {
        to.put_text(name);
        to.put_elements(column);
    }
    to.put(std::uint64_t{table.words.size()});
    for (const auto& [name, column] : table.words) {
        to.put_text(name);
        put_texts(column);
    }
}

void take_table(ByteReader& from, Table& table) {
    const auto take_texts = [&] {
        std::vector<std::string> texts;
        for (auto count = from.take<std::uint64_t>(); count > 0; --count) texts.push_back(from.take_text());
        return texts;
    };
    table.names = take_texts();
    const std::vector<std::string> units = take_texts();
    table.units = {units.at(0), units.at(1)};
    table.rows = from.take<std::uint64_t>();
    for (auto count = from.take<std::uint64_t>(); count > 0; --count) {
        std::vector<double>& column = table.numbers[from.take_text()];
        from.take_elements(table.rows, column);
    }
    for (auto count = from.take<std::uint64_t>(); count > 0; --count) {
        std::vector<std::string>& column = table.words[from.take_text()];
        column = take_texts();
    }
}

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

enum class Answer : char { table, refusal };

/// What the child sends: a table, or why there is none.
std::string answer_of(const std::string& path, const KnownColumns& known) {
    const QuietHdf5 quiet;
    ByteWriter answer;
    try {
        Table table(path);
        const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it as HDF5");
        read_columns(table, file, known);
        answer.put(Answer::table);
        put_table(answer, table);
    } catch (const Hdf5Failure& failure) {
        answer.put(Answer::refusal);
        answer.put_text(fmt::format("cannot {}: {}", failure.operation, failure.reason));
    }
    return answer.bytes();
}

}  // namespace

Table read_hdf5_table(const std::string& path, const KnownColumns& known) {
    // A megabyte holds a thousand at most, which take a second or two. In a damaged file the library may walk in
    // circles.
    const double seconds = 1.0 + 1e-5 * static_cast<double>(ReadFile(path).size());
    const std::string bytes = bytes_from_child(path, seconds, [&] { return answer_of(path, known); });
    ByteReader answer(bytes);
    if (answer.take<Answer>() == Answer::refusal) throw refused_file(path, answer.take_text(), "");
    Table table(path);
    take_table(answer, table);
    return table;
}

}  // namespace jostle
