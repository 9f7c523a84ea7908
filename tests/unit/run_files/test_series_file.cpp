#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "jostle/disk/checksum.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/run_files/series_file.hpp"
#include "support/full_disk.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

std::vector<SeriesColumn> three_columns() {
    return {{"step", "1", "k", "Steps done.", ""},
            {"time", "s", "t", "Simulated time.", ""},
            {"pressure", "pN um-2", "p", "A third of the trace of the stress.", "positive in compression"}};
}

void append(SeriesFile& series, double step, double time, double pressure) {
    const std::array<double, 3> row = {step, time, pressure};
    series.append(row);
}

}  // namespace

TEST_CASE("rows look as people would write them") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv");
    SeriesFile series = SeriesFile::create(path, three_columns());
    append(series, 10, 0.1, -1.5e-9);
    append(series, 1099511627776, 1.0 / 3.0, -std::numeric_limits<double>::quiet_NaN());
    CHECK(content_of(path) == "step,time,pressure\n10,0.1,-1.5e-09\n1099511627776,0.3333333333333333,nan\n");
    CHECK(series.bytes() == content_of(path).size());
    CHECK(series.hash() == checksum(content_of(path)));
}

TEST_CASE("every double comes back to the last bit") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv");
    const unsigned seed = 4711;
    MESSAGE("seed " << seed);
    std::mt19937_64 random(seed);
    std::vector<double> values = {0.0, -0.0, 5e-324, 1.7976931348623157e308, INFINITY, -INFINITY};
    while (values.size() < 600) {
        const std::uint64_t bits = random();
        double value;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isnan(value)) values.push_back(value);
    }
    SeriesFile series = SeriesFile::create(path, three_columns());
    for (std::size_t k = 0; k < values.size(); k += 3) append(series, values[k], values[k + 1], values[k + 2]);
    const SeriesTable table = read_series(path);
    REQUIRE(table.rows() == values.size() / 3);
    CHECK(table.names == std::vector<std::string>{"step", "time", "pressure"});
    int wrong = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (std::memcmp(&table.columns[k % 3][k / 3], &values[k], sizeof(double)) != 0) ++wrong;
    CHECK(wrong == 0);
    CHECK(&table.column("time") == &table.columns[1]);
    CHECK(contains(message_of<InputError>([&] { table.column("tine"); }), "no column \"tine\""));
}

TEST_CASE("resumed at a checkpoint the file ends as if it had never been stopped") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv"), straight = folder.file("straight.csv");
    std::uint64_t bytes = 0, hash = 0;
    {
        SeriesFile series = SeriesFile::create(path, three_columns());
        append(series, 1, 0.1, 7);
        bytes = series.bytes();
        hash = series.hash();
        append(series, 2, 0.2, 8);
    }
    put_content(path, content_of(path) + "3,0.");  // a kill within a row
    CHECK(read_series(path).rows() == 2);
    {
        SeriesFile series = SeriesFile::resume(path, three_columns(), bytes, hash);
        CHECK(series.bytes() == bytes);
        append(series, 2, 0.2, 8);
        append(series, 3, 0.3, 9);
        SeriesFile undisturbed = SeriesFile::create(straight, three_columns());
        append(undisturbed, 1, 0.1, 7);
        append(undisturbed, 2, 0.2, 8);
        append(undisturbed, 3, 0.3, 9);
        CHECK(series.hash() == undisturbed.hash());
    }
    CHECK(content_of(path) == content_of(straight));
}

TEST_CASE("a series that was shortened, changed or has other columns is refused and left alone") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv");
    SeriesFile series = SeriesFile::create(path, three_columns());
    append(series, 1, 0.1, 7);
    append(series, 2, 0.2, 8);
    const std::uint64_t bytes = series.bytes(), hash = series.hash();
    append(series, 3, 0.3, 9);
    const std::string good = content_of(path);
    const auto refusal = [&](const std::vector<SeriesColumn>& columns) {
        const std::string before = content_of(path);
        const std::string message = message_of<InputError>([&] { SeriesFile::resume(path, columns, bytes, hash); });
        CHECK(content_of(path) == before);
        CHECK(message == message_of<InputError>([&] { SeriesFile::require_prefix(path, columns, bytes, hash); }));
        return message;
    };
    for (std::size_t k = 0; k < bytes; ++k) {
        put_byte(path, k, static_cast<char>(good[k] ^ 1));
        CHECK(contains(refusal(three_columns()), "was changed"));
        put_byte(path, k, good[k]);
    }
    for (std::size_t size = bytes; size-- > 0;) {
        std::filesystem::resize_file(path, size);
        CHECK(contains(refusal(three_columns()), "truncated"));
    }
    put_content(path, good);
    std::vector<SeriesColumn> other = three_columns();
    other[2].name = "tension";
    CHECK(contains(refusal(other), "other columns"));
    CHECK_NOTHROW(SeriesFile::resume(path, three_columns(), bytes, hash));
    CHECK(content_of(path) == good.substr(0, bytes));
    std::filesystem::remove(path);
    CHECK(contains(message_of<InputError>([&] { SeriesFile::resume(path, three_columns(), bytes, hash); }),
                   "no such file"));
}

TEST_CASE("a full disk leaves whole rows") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv");
    const int code = with_file_size_limit(200, [&] {
        SeriesFile series = SeriesFile::create(path, three_columns());
        for (int step = 1; step < 1000; ++step) {
            const std::uint64_t hash = series.hash();
            try {
                append(series, step, 0.1 * step, 1.0 / step);
            } catch (const DiskError&) {
                return series.hash() == hash ? 0 : 2;
            }
        }
        return 1;
    });
    CHECK(code == 0);
    CHECK(content_of(path).back() == '\n');
    CHECK(read_series(path).rows() > 3);
}

TEST_CASE("what is no number is told with its place") {
    const TemporaryFolder folder;
    const std::string path = folder.file("series.csv");
    put_content(path, "step,time\n1,0.1\n2,O.2\n");
    CHECK(contains(message_of<InputError>([&] { read_series(path); }), path + ":3: \"O.2\" in column time"));
    put_content(path, "step,time\n1,0.1,3\n");
    CHECK(contains(message_of<InputError>([&] { read_series(path); }), path + ":2: the row has 3 numbers"));
    put_content(path, "step,time\n1,\n");
    CHECK(contains(message_of<InputError>([&] { read_series(path); }), "\"\" in column time"));
    put_content(path, "");
    CHECK(contains(message_of<InputError>([&] { read_series(path); }), "empty"));
    put_content(path, "step,time\n");
    CHECK(read_series(path).rows() == 0);
}

TEST_CASE("series.json tells the unit and the sign of every column") {
    const TemporaryFolder folder;
    put_content(folder.file("series.json"), series_description("series", three_columns()));
    const auto description = nlohmann::json::parse(content_of(folder.file("series.json")));
    REQUIRE(description["columns"].size() == 3);
    CHECK(description["columns"][2]["name"] == "pressure");
    CHECK(description["columns"][2]["unit"] == "pN um-2");
    CHECK(description["columns"][2]["sign"] == "positive in compression");
}
