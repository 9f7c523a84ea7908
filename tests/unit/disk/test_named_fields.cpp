#include <doctest/doctest.h>

#include <array>

#include "jostle/disk/named_fields.hpp"

using namespace jostle;

namespace {

struct Item {
    double a = 0.0;
    std::int32_t b = 0;
    bool operator==(const Item&) const = default;
};

std::string written(const FieldWriter& writer) {
    const std::string bytes = writer.text();
    CHECK(bytes.size() == writer.bytes());
    return bytes;
}

/// What is wrong, in words; "" if nothing is.
template <class Read>
std::string problem_of(const std::string& bytes, Read&& read) {
    try {
        FieldReader reader(bytes);
        read(reader);
        reader.require_all_taken();
    } catch (const std::out_of_range& problem) {
        return problem.what();
    }
    return "";
}

}  // namespace

TEST_CASE("named fields come back by name, in any order") {
    const std::vector<Item> items = {{1.5, -1}, {-0.25, 7}};
    const std::vector<double> numbers = {1.0, 1e-310}, none;
    FieldWriter writer;
    writer.put("one", std::uint64_t{1} << 60);
    writer.put_text("text", "a text\n");
    writer.put_array("numbers", numbers);
    writer.put_array("none", none);
    writer.put_column("items.a", items, [](const Item& item) { return item.a; });
    writer.put_column("items.b", items, [](const Item& item) { return item.b; });
    writer.put_pieces("pieces", 3, [](const FieldWriter::Sink& sink) {
        sink(0, "ab");
        sink(2, "c");
    });
    writer.put("last", std::array{1.0, 2.0});
    const std::string bytes = written(writer);
    FieldReader reader(bytes);
    CHECK(reader.names_after("items.") == std::vector<std::string>{"a", "b"});
    CHECK(reader.take<std::array<double, 2>>("last") == std::array{1.0, 2.0});
    std::vector<Item> found(reader.length<double>("items.a"));
    reader.take_column<std::int32_t>("items.b", found, [](Item& item, std::int32_t value) { item.b = value; });
    reader.take_column<double>("items.a", found, [](Item& item, double value) { item.a = value; });
    CHECK(found == items);
    CHECK(reader.take_array<double>("none").empty());
    CHECK(reader.take_array<double>("numbers") == numbers);
    CHECK(reader.take_text("text") == "a text\n");
    CHECK(reader.take_text("pieces") == "abc");
    CHECK(reader.take<std::uint64_t>("one") == std::uint64_t{1} << 60);
    CHECK_NOTHROW(reader.require_all_taken());
}

TEST_CASE("what named fields lack, or have too much, is told by its name") {
    FieldWriter writer;
    writer.put("a", 1.0);
    writer.put_text("b", "12345");
    const std::string bytes = written(writer);
    CHECK(problem_of(bytes, [](FieldReader& reader) { reader.take<double>("c"); }) == "it has no field \"c\"");
    CHECK(problem_of(bytes, [](FieldReader& reader) { reader.take<float>("a"); }) == "\"a\" has another size");
    CHECK(problem_of(bytes, [](FieldReader& reader) { reader.take_array<double>("b"); }) == "\"b\" has another size");
    CHECK(problem_of(bytes, [](FieldReader& reader) { reader.take<double>("a"); }) ==
          "it has a field of another version: \"b\"");
    CHECK(problem_of(bytes, [](FieldReader& reader) {
              std::vector<Item> items(2);
              reader.take_column<double>("a", items, [](Item& item, double value) { item.a = value; });
          }) == "\"a\" has another length");
    CHECK(problem_of(bytes + bytes, [](FieldReader&) {}) == "a field stands in it twice");
    for (std::size_t cut = 1; cut < bytes.size(); ++cut) {
        const std::string problem = problem_of(bytes.substr(0, cut), [](FieldReader& reader) {
            reader.take<double>("a");
            reader.take_text("b");
        });
        CHECK(!problem.empty());
    }
}
