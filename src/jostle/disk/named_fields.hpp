#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "jostle/disk/byte_buffer.hpp"

namespace jostle {

/// Collects values under names: each is its name (length and text), how many bytes it has, and these; little endian,
/// arrays without padding.
///
/// Arrays stay where they are, for there may be ten million rods: those that are put must outlive the writer.
class FieldWriter {
public:
    /// Takes pieces of an array, each with its place (bytes) in it.
    using Sink = std::function<void(std::uint64_t, std::string_view)>;
    /// Gives an array to a sink, piece after piece.
    using Pieces = std::function<void(const Sink&)>;

    template <class Value>
    void put(std::string_view name, const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        begin(name, sizeof(Value));
        parts_.back().copied.put(value);
    }
    void put_text(std::string_view name, std::string_view text) {
        begin(name, text.size());
        parts_.back().copied.put_bytes(text);
    }
    template <class Value>
    void put_array(std::string_view name, const std::vector<Value>& values) {
        begin(name, values.size() * sizeof(Value));
        parts_.back().array = bytes_of(std::span(values));
        parts_.emplace_back();
    }
    /// An array of one thing that each of the items has: `part(item)`.
    template <class Item, class Part>
    void put_column(std::string_view name, const std::vector<Item>& items, Part&& part) {
        using Value = std::decay_t<decltype(part(items.front()))>;
        static_assert(std::is_trivially_copyable_v<Value>);
        begin(name, items.size() * sizeof(Value));
        for (const Item& item : items) parts_.back().copied.put(static_cast<Value>(part(item)));
    }

    /// So many bytes, which come in pieces when all is written.
    void put_pieces(std::string_view name, std::uint64_t bytes, Pieces pieces) {
        begin(name, bytes);
        parts_.back().pieces = std::move(pieces);
        parts_.back().bytes = bytes;
        parts_.emplace_back();
    }

    /// How many bytes all are together.
    std::uint64_t bytes() const {
        std::uint64_t sum = 0;
        for (const Part& part : parts_) sum += part.copied.bytes().size() + part.array.size() + part.bytes;
        return sum;
    }
    /// Calls write(bytes), one after the other, and write_pieces(how many bytes, pieces) for what comes in pieces.
    template <class Write, class WritePieces>
    void write(Write&& write, WritePieces&& write_pieces) const {
        for (const Part& part : parts_) {
            write(std::string_view(part.copied.bytes()));
            write(part.array);
            if (part.pieces) write_pieces(part.bytes, part.pieces);
        }
    }
    /// All of it as it lies in a file.
    std::string text() const {
        std::string all;
        all.reserve(bytes());
        const auto append = [&](std::string_view piece) { all += piece; };
        write(append, [&](std::uint64_t, const Pieces& pieces) {
            pieces([&](std::uint64_t, std::string_view piece) { append(piece); });
        });
        return all;
    }

private:
    struct Part {
        ByteWriter copied;
        std::string_view array = {};  ///< after it
        Pieces pieces = {};           ///< or these
        std::uint64_t bytes = 0;      ///< of the pieces
    };

    void begin(std::string_view name, std::uint64_t bytes) {
        parts_.back().copied.put_text(name);
        parts_.back().copied.put(bytes);
    }

    std::vector<Part> parts_{1};
};

/// Reads back what a FieldWriter collected, by name, in any order.
///
/// Errors: std::out_of_range with what is wrong, in words: "it has no field \"time\"". Nothing is allocated for what is
/// not there.
class FieldReader {
public:
    explicit FieldReader(std::string_view bytes) {
        ByteReader reader(bytes);
        while (!reader.empty()) {
            std::string name = reader.take_text();
            const std::string_view content = reader.take_bytes(reader.take<std::uint64_t>());
            if (!fields_.emplace(std::move(name), content).second)
                throw std::out_of_range("a field stands in it twice");
        }
    }

    template <class Value>
    Value take(std::string_view name) {
        static_assert(std::is_trivially_copyable_v<Value>);
        const std::string_view bytes = taken(name);
        if (bytes.size() != sizeof(Value)) throw std::out_of_range(quoted(name) + " has another size");
        Value value;
        std::memcpy(&value, bytes.data(), sizeof(Value));
        return value;
    }
    std::string take_text(std::string_view name) { return std::string(taken(name)); }
    template <class Value>
    std::vector<Value> take_array(std::string_view name) {
        static_assert(std::is_trivially_copyable_v<Value>);
        const std::string_view bytes = taken(name);
        if (bytes.size() % sizeof(Value) != 0) throw std::out_of_range(quoted(name) + " has another size");
        std::vector<Value> values(bytes.size() / sizeof(Value));
        if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    /// How many values an array has that has not been taken.
    template <class Value>
    std::size_t length(std::string_view name) const {
        const auto found = fields_.find(name);
        return found == fields_.end() ? 0 : found->second.size() / sizeof(Value);
    }
    /// The counterpart of `put_column`: calls `set(item, value)` for each of the items, which must be as many.
    template <class Value, class Item, class Set>
    void take_column(std::string_view name, std::vector<Item>& items, Set&& set) {
        const std::vector<Value> values = take_array<Value>(name);
        if (items.size() != values.size()) throw std::out_of_range(quoted(name) + " has another length");
        for (std::size_t k = 0; k < values.size(); ++k) set(items[k], values[k]);
    }

    /// What follows the prefix in the names of the fields that have not been taken.
    std::vector<std::string> names_after(std::string_view prefix) const {
        std::vector<std::string> names;
        for (const auto& [name, content] : fields_)
            if (name.starts_with(prefix)) names.push_back(name.substr(prefix.size()));
        return names;
    }
    void require_all_taken() const {
        if (!fields_.empty())
            throw std::out_of_range("it has a field of another version: " + quoted(fields_.begin()->first));
    }

private:
    static std::string quoted(std::string_view name) { return "\"" + std::string(name) + "\""; }

    std::string_view taken(std::string_view name) {
        const auto found = fields_.find(name);
        if (found == fields_.end()) throw std::out_of_range("it has no field " + quoted(name));
        const std::string_view bytes = found->second;
        fields_.erase(found);
        return bytes;
    }

    std::map<std::string, std::string_view, std::less<>> fields_;
};

}  // namespace jostle
