#include <doctest/doctest.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <random>
#include <set>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/run_files/h5md_writer.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "support/full_disk.hpp"
#include "support/some_rods.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

const H5mdAttributes attributes = {
    "A. Student", "1.2.3", "seed = 5  # \xc3\xa9\n", "seed = 5\n", 5, "jostle run x.toml", "host", "SI", "um", "s",
    "pN um-2",    ""};

/// `frames` frames of `count` rods; with `varying`, of count, count - 1, ... rods in a box that grows.
void write_journal(const std::string& path, unsigned frames, unsigned count, bool varying = false) {
    TrajectoryJournal journal = TrajectoryJournal::create(path);
    for (unsigned k = 0; k < frames; ++k)
        journal.append(10 * k, 0.5 * k, Box{{4, 5, varying ? 6.0 + k : 6.0}, {true, false, true}},
                       some_rods(varying ? count - k % count : count, k));
}

SeriesTable stress_series(std::size_t rows) {
    SeriesTable table;
    table.names = {"step",      "time",      "stress_xx", "stress_xy", "stress_xz", "stress_yx",
                   "stress_yy", "stress_yz", "stress_zx", "stress_zy", "stress_zz"};
    for (const char* name : orientation_stress_column_names) table.names.push_back(name);
    table.columns.resize(table.names.size());
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t k = 0; k < table.names.size(); ++k)
            table.columns[k].push_back(k == 0 ? 5.0 * static_cast<double>(row) : 0.1 * static_cast<double>(k + row));
    return table;
}

/// The file as a reader sees it, by the C interface.
struct Opened {
    explicit Opened(const std::string& path) : id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
    ~Opened() { H5Fclose(id); }
    hid_t id;

    template <class Value>
    std::vector<Value> read(const char* name, hid_t type, std::vector<hsize_t> expected) const {
        const hid_t dataset = H5Dopen2(id, name, H5P_DEFAULT);
        REQUIRE(dataset >= 0);
        const hid_t space = H5Dget_space(dataset);
        std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
        H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
        CHECK(sizes == expected);
        std::vector<Value> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        CHECK(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
        H5Sclose(space);
        H5Dclose(dataset);
        return values;
    }

    std::string text_attribute(const char* object, const char* name) const {
        const hid_t attribute = H5Aopen_by_name(id, object, name, H5P_DEFAULT, H5P_DEFAULT);
        if (attribute < 0) return "(none)";
        const hid_t type = H5Aget_type(attribute);
        CHECK(H5Tis_variable_str(type) == 0);
        std::string text(H5Aget_storage_size(attribute), '\0');
        H5Aread(attribute, type, text.data());
        H5Tclose(type);
        H5Aclose(attribute);
        return text;
    }

    std::string text(const char* name) const {
        const hid_t dataset = H5Dopen2(id, name, H5P_DEFAULT);
        const hid_t type = H5Dget_type(dataset);
        std::string text(H5Tget_size(type), '\0');
        H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
        H5Tclose(type);
        H5Dclose(dataset);
        return text;
    }

    haddr_t address(const char* name) const {
        H5O_info_t object;
        REQUIRE(H5Oget_info_by_name2(id, name, &object, H5O_INFO_BASIC, H5P_DEFAULT) >= 0);
        return object.addr;
    }
};

}  // namespace

TEST_CASE("the journal's numbers stand in the file") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 3, 4);
    put_content(folder.file("mine"), "keep");
    std::filesystem::create_symlink(folder.file("mine"), path + ".tmp");
    write_h5md(journal, path, attributes);
    CHECK_NOTHROW(verify_h5md(path));
    CHECK_FALSE(file_exists(path + ".tmp"));
    CHECK_FALSE(std::filesystem::is_symlink(path));
    CHECK(read_file(folder.file("mine")) == "keep");

    const Opened file(path);
    CHECK(file.read<std::int64_t>("particles/rods/position/step", H5T_NATIVE_INT64, {3}) ==
          std::vector<std::int64_t>{0, 10, 20});
    CHECK(file.read<double>("particles/rods/position/time", H5T_NATIVE_DOUBLE, {3}) == std::vector<double>{0, 0.5, 1});
    CHECK(file.read<double>("particles/rods/box/edges", H5T_NATIVE_DOUBLE, {3}) == std::vector<double>{4, 5, 6});
    const auto position = file.read<float>("particles/rods/position/value", H5T_NATIVE_FLOAT, {3, 4, 3});
    const auto image = file.read<std::int32_t>("particles/rods/image/value", H5T_NATIVE_INT32, {3, 4, 3});
    const auto axis = file.read<float>("particles/rods/orientation/value", H5T_NATIVE_FLOAT, {3, 4, 3});
    const auto length = file.read<float>("particles/rods/length/value", H5T_NATIVE_FLOAT, {3, 4});
    const auto diameter = file.read<float>("particles/rods/diameter/value", H5T_NATIVE_FLOAT, {3, 4});
    const auto id = file.read<std::int64_t>("particles/rods/id/value", H5T_NATIVE_INT64, {3, 4});
    int wrong = 0;
    for (unsigned frame = 0; frame < 3; ++frame) {
        const Rods rods = some_rods(4, frame);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t row = 4 * frame + i;
            wrong += length[row] != static_cast<float>(rods.length[i]);
            wrong += diameter[row] != static_cast<float>(rods.diameter[i]);
            wrong += id[row] != static_cast<std::int64_t>(rods.id[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                wrong += position[3 * row + k] != static_cast<float>(rods.centre[i][static_cast<int>(k)]);
                wrong += axis[3 * row + k] != static_cast<float>(rods.axis[i][static_cast<int>(k)]);
                wrong += image[3 * row + k] != rods.image[i][k];
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the structure is that of H5MD 1.1") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 2, 3);
    const SeriesTable series = stress_series(5);
    write_h5md(journal, path, attributes, &series);
    verify_h5md(path);
    const Opened file(path);
    CHECK(file.text_attribute("h5md/author", "name") == "A. Student");
    CHECK(file.text_attribute("h5md/creator", "name") == "jostle");
    CHECK(file.text_attribute("h5md/creator", "version") == "1.2.3");
    CHECK(file.text_attribute("h5md/modules/units", "system") == "SI");
    CHECK(file.text_attribute("particles/rods/position/value", "unit") == "um");
    CHECK(file.text_attribute("particles/rods/position/time", "unit") == "s");
    CHECK(file.text_attribute("particles/rods/length/value", "unit") == "um");
    CHECK(file.text_attribute("observables/stress_collision/value", "unit") == "pN um-2");
    CHECK(file.text_attribute("particles/rods/box", "boundary") == std::string("periodicnone\0\0\0\0periodic", 24));
    CHECK(file.text("parameters/scene") == attributes.scene);
    CHECK(file.text("parameters/resolved_scene") == attributes.resolved_scene);
    CHECK(file.text("parameters/command_line") == attributes.command_line);
    CHECK(file.text("parameters/host") == attributes.host);

    // step and time are hard links to one object, and time is the scale of axis 0 of every value
    const haddr_t step = file.address("particles/rods/position/step");
    const haddr_t time = file.address("particles/rods/position/time");
    for (const std::string name : {"image", "orientation", "length", "diameter", "id"}) {
        const std::string group = "particles/rods/" + name;
        CHECK(file.address((group + "/step").c_str()) == step);
        CHECK(file.address((group + "/time").c_str()) == time);
        const hid_t value = H5Dopen2(file.id, (group + "/value").c_str(), H5P_DEFAULT);
        const hid_t scale = H5Dopen2(file.id, (group + "/time").c_str(), H5P_DEFAULT);
        CHECK(H5DSis_attached(value, scale, 0) > 0);
        H5Dclose(scale);
        H5Dclose(value);
    }
    const auto stress = file.read<double>("observables/stress_collision/value", H5T_NATIVE_DOUBLE, {5, 3, 3});
    for (std::size_t row = 0; row < 5; ++row)
        for (std::size_t k = 0; k < 9; ++k) CHECK(stress[9 * row + k] == series.columns[2 + k][row]);
    const auto orientation = file.read<double>("observables/stress_orientation/value", H5T_NATIVE_DOUBLE, {5, 3, 3});
    const std::size_t column[] = {0, 1, 2, 1, 3, 4, 2, 4, 5};  // of the six, symmetric
    for (std::size_t row = 0; row < 5; ++row)
        for (std::size_t k = 0; k < 9; ++k) CHECK(orientation[9 * row + k] == series.columns[11 + column[k]][row]);
    CHECK(file.read<std::int64_t>("observables/stress_collision/step", H5T_NATIVE_INT64, {5})[4] == 20);
}

TEST_CASE("a number of rods that varies: rows without a rod have the fill value as id") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 4, 3, true);  // 3, 2, 1 and 3 rods
    write_h5md(journal, path, attributes);
    verify_h5md(path);
    const Opened file(path);
    const auto id = file.read<std::int64_t>("particles/rods/id/value", H5T_NATIVE_INT64, {4, 3});
    CHECK(id == std::vector<std::int64_t>{0, 100, 200, 1, 101, -1, 2, -1, -1, 3, 103, 203});
    const auto length = file.read<float>("particles/rods/length/value", H5T_NATIVE_FLOAT, {4, 3});
    for (std::size_t k = 0; k < id.size(); ++k) CHECK(std::isnan(length[k]) == (id[k] == -1));
    CHECK(file.read<double>("particles/rods/box/edges/value", H5T_NATIVE_DOUBLE, {4, 3})[11] == 9.0);
    CHECK(file.address("particles/rods/box/edges/step") == file.address("particles/rods/position/step"));
    const hid_t dataset = H5Dopen2(file.id, "particles/rods/id/value", H5P_DEFAULT);
    const hid_t properties = H5Dget_create_plist(dataset);
    std::int64_t fill = 0;
    H5Pget_fill_value(properties, H5T_NATIVE_INT64, &fill);
    CHECK(fill == -1);
    H5Pclose(properties);
    H5Dclose(dataset);
}

TEST_CASE("the stress of every rod, where the journal has it; rows without a rod are not numbers") {
    const TemporaryFolder folder;
    const std::string path = folder.file("trajectory.h5"), journal_path = folder.file("trajectory.journal");
    {
        auto journal = TrajectoryJournal::create(journal_path, TrajectoryJournal::Content::rods_and_stress);
        const Mat3 first = {{1, 2, 3, 4, 5, 6, 7, 8, 0.1}}, second = {{9, 8, 7, 6, 5, 4, 3, 2, 1}};
        journal.append(0, 0.0, Box{}, some_rods(1, 1), {first});
        journal.append(5, 0.5, Box{}, some_rods(2, 2), {second, first});
    }
    H5mdAttributes with_unit = attributes;
    with_unit.energy_unit = "pN um";
    write_h5md(journal_path, path, with_unit);
    verify_h5md(path);
    const Opened file(path);
    const auto stress = file.read<double>("particles/rods/stress_collision/value", H5T_NATIVE_DOUBLE, {2, 2, 3, 3});
    CHECK(stress[8] == 0.1);
    for (std::size_t k = 9; k < 18; ++k) CHECK(std::isnan(stress[k]));
    CHECK(stress[18] == 9.0);
    CHECK(stress[27 + 5] == 6.0);
    CHECK(file.text_attribute("particles/rods/stress_collision/value", "unit") == "pN um");
    CHECK(file.address("particles/rods/stress_collision/step") == file.address("particles/rods/position/step"));
}

TEST_CASE("no frames, no rods, and texts longer than an object header are written too") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 0, 0);
    H5mdAttributes long_scene = attributes;
    long_scene.scene = std::string(100000, 'x') + "end";
    long_scene.host = "";
    write_h5md(journal, path, long_scene);
    verify_h5md(path);
    CHECK(Opened(path).text("parameters/scene") == long_scene.scene);
    write_journal(journal, 2, 0);
    const SeriesTable empty = stress_series(0);
    write_h5md(journal, path, attributes, &empty);
    verify_h5md(path);
    Opened(path).read<float>("particles/rods/position/value", H5T_NATIVE_FLOAT, {2, 0, 3});
}

TEST_CASE("a flip of any bit is detected") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 3, 8);
    const SeriesTable series = stress_series(4);
    write_h5md(journal, path, attributes, &series);
    const std::string good = content_of(path);
    std::set<std::size_t> raw;  // the bytes of all chunks
    {
        const Opened file(path);
        for (const char* name :
             {"particles/rods/position/value", "particles/rods/position/step", "particles/rods/position/time",
              "particles/rods/image/value", "particles/rods/orientation/value", "particles/rods/length/value",
              "particles/rods/diameter/value", "particles/rods/id/value", "observables/stress_collision/value",
              "observables/stress_collision/step", "observables/stress_collision/time"}) {
            const hid_t dataset = H5Dopen2(file.id, name, H5P_DEFAULT);
            const hid_t space = H5Dget_space(dataset);
            hsize_t chunks = 0;
            H5Dget_num_chunks(dataset, space, &chunks);
            for (hsize_t k = 0; k < chunks; ++k) {
                hsize_t offset[3], size = 0;
                unsigned mask = 0;
                haddr_t address = 0;
                H5Dget_chunk_info(dataset, space, k, offset, &mask, &address, &size);
                for (hsize_t byte = 0; byte < size; ++byte) raw.insert(address + byte);
            }
            H5Sclose(space);
            H5Dclose(dataset);
        }
    }
    REQUIRE(raw.size() > 1000);
    const unsigned seed = 99;
    MESSAGE("seed " << seed << ", " << good.size() << " bytes, " << raw.size() << " of them numbers");
    std::mt19937_64 random(seed);
    const auto undetected = [&](const std::vector<std::size_t>& positions) {
        int count = 0;
        for (const std::size_t position : positions) {
            put_byte(path, position, static_cast<char>(good[position] ^ (1 << random() % 8)));
            if (message_of<InputError>([&] { verify_h5md(path); }) == "") ++count;
            put_byte(path, position, good[position]);
        }
        return count;
    };
    std::vector<std::size_t> anywhere;
    for (std::size_t k = random() % 5; k < good.size() - 24; k += 5) anywhere.push_back(k);
    CHECK(undetected(anywhere) == 0);
    put_byte(path, good.size() - 1, static_cast<char>(good.back() ^ 1));
    CHECK(contains(message_of<InputError>([&] { verify_h5md(path); }), "do not match the checksum"));

    // Without the seal HDF5's own checksums speak, which any other reader has too.
    std::filesystem::resize_file(path, good.size() - 24);
    CHECK_NOTHROW(verify_h5md(path));
    std::vector<std::size_t> numbers;
    std::sample(raw.begin(), raw.end(), std::back_inserter(numbers), 150, random);
    CHECK(undetected(numbers) == 0);
    for (const std::size_t size : {good.size() - 25, good.size() / 2, std::size_t{100}, std::size_t{0}}) {
        std::filesystem::resize_file(path, size);
        CHECK_THROWS_AS(verify_h5md(path), InputError);
    }
    put_content(path, good);
    CHECK_NOTHROW(verify_h5md(path));
}

TEST_CASE("missing and foreign files are refused") {
    const TemporaryFolder folder;
    CHECK(contains(message_of<InputError>([&] { verify_h5md(folder.file("none")); }), "no such file"));
    put_content(folder.file("text"), "step,time\n");
    CHECK(contains(message_of<InputError>([&] { verify_h5md(folder.file("text")); }), "no H5MD file"));
    H5Fclose(H5Fcreate(folder.file("other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    CHECK(contains(message_of<InputError>([&] { verify_h5md(folder.file("other.h5")); }), "no H5MD file"));
    CHECK_THROWS_AS(write_h5md(folder.file("none"), folder.file("out.h5"), attributes), InputError);
    CHECK_FALSE(file_exists(folder.file("out.h5")));
}

TEST_CASE("a damaged journal or a full disk leave the old file in place") {
    const TemporaryFolder folder;
    const std::string journal = folder.file("trajectory.journal"), path = folder.file("trajectory.h5");
    write_journal(journal, 2, 3);
    write_h5md(journal, path, attributes);
    const std::string good = content_of(path);
    write_journal(journal, 40, 50);
    for (const rlim_t limit : {500u, 20000u, 60000u, 100000u}) {
        const int code = with_file_size_limit(limit, [&] {
            try {
                write_h5md(journal, path, attributes);
            } catch (const DiskError& error) {
                return error.error_number() == EFBIG ? 0 : 2;
            }
            return 1;
        });
        CAPTURE(limit);
        CHECK(code == 0);
        CHECK(content_of(path) == good);
        CHECK_FALSE(file_exists(path + ".tmp"));
    }
    put_byte(journal, 1000, '~');
    CHECK_THROWS_AS(write_h5md(journal, path, attributes), InputError);
    CHECK(content_of(path) == good);
    CHECK_FALSE(file_exists(path + ".tmp"));
    CHECK_THROWS_AS(write_h5md(folder.file("trajectory.journal"), folder.file("none/x.h5"), attributes),
                    std::exception);
}
