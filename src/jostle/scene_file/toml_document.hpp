#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// A TOML text, parsed, that knows where each of its values stands and how the user wrote it.
class TomlDocument {
public:
    /// Throws InputError, in the words of jostle and with place, if the text is not valid TOML. `file_name` is for
    /// messages.
    TomlDocument(std::string_view text, std::string file_name);

    const toml::table& root() const { return root_; }

    /// The value of a key, or null; `table` "" means the top.
    const toml::node* find(std::string_view table, std::string_view name) const;

    /// Where a region of the source begins.
    Place place(const toml::source_region& region) const;

    /// Where the value of "table.name" stands; if absent, where its table stands; else line 1.
    Place place_of(std::string_view full_key) const;

    /// The text with this key set to a value in TOML: in the place of the value that it has, else as a line below the
    /// heading of its table, which is added where it is missing.
    std::string text_with(std::string_view table, std::string_view name, std::string_view value) const;

    /// The text without this key and its value; a comment beside it stays.
    std::string text_without(std::string_view table, std::string_view name) const;

    /// Offset in the text of what follows a value.
    std::size_t end_of(const toml::node& value) const { return offset(value.source().end); }

    /// A region of the source as the user wrote it, on one line and not longer than a message can hold.
    std::string written(const toml::source_region& region) const;

private:
    [[noreturn]] void refuse(const toml::parse_error& error) const;
    std::size_t begin_of_line(std::uint32_t number) const;
    std::string_view line(std::uint32_t number) const;
    std::size_t offset(const toml::source_position& position) const;
    std::string table_above(std::uint32_t line_number) const;

    std::string text_;
    std::string file_;
    toml::table root_;
};

/// A text as a value of TOML, in quotes.
std::string toml_text(std::string_view text);

}  // namespace jostle
