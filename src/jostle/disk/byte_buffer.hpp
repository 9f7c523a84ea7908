#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace jostle {

// Numbers go to disk as they lie in memory; a big-endian machine would need them turned round here.
static_assert(std::endian::native == std::endian::little);

/// Values as they lie in memory.
template <class Value>
std::string_view bytes_of(std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// Collects plain values, arrays and texts into one run of bytes, little endian, without padding.
class ByteWriter {
public:
    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof(Value));
    }

    /// The elements alone; their number is written by whoever needs it.
    template <class Value>
    void put_elements(const std::vector<Value>& values) {
        put_bytes(bytes_of(std::span(values)));
    }

    void put_text(std::string_view text) {
        put(static_cast<std::uint64_t>(text.size()));
        put_bytes(text);
    }
    void put_bytes(std::string_view bytes) { bytes_.append(bytes); }

    const std::string& bytes() const { return bytes_; }
    void clear() { bytes_.clear(); }

private:
    std::string bytes_;
};

/// Reads back what a ByteWriter collected.
///
/// Errors: std::out_of_range if more is taken than there is, before anything is allocated for it.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class Value>
    Value take() {
        static_assert(std::is_trivially_copyable_v<Value>);
        Value value;
        std::memcpy(&value, take_bytes(sizeof(Value)).data(), sizeof(Value));
        return value;
    }

    template <class Value>
    void take_elements(std::uint64_t count, std::vector<Value>& values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        if (count > rest_.size() / sizeof(Value)) throw std::out_of_range("an array is longer than the bytes left");
        values.resize(count);
        if (count > 0) std::memcpy(values.data(), take_bytes(count * sizeof(Value)).data(), count * sizeof(Value));
    }

    std::string take_text() { return std::string(take_bytes(take<std::uint64_t>())); }

    bool empty() const { return rest_.empty(); }

    /// They stay where they are.
    std::string_view take_bytes(std::uint64_t count) {
        if (count > rest_.size()) throw std::out_of_range("a value is longer than the bytes left");
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return bytes;
    }

private:
    std::string_view rest_;
};

}  // namespace jostle
