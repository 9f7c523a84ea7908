#include "jostle/scene_file/toml_document.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "jostle/error/one_line.hpp"

namespace jostle {

namespace {

constexpr std::size_t longest_line =
    4000;  // far beyond any scene; toml++ 3.3 overflows the stack on a key of 16,000 dots

bool is_continuation(char c) {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

/// Offset of a column, which toml++ counts in code points from 1.
std::size_t offset_of(std::string_view line, std::uint32_t column) {
    std::size_t offset = 0;
    for (std::uint32_t k = 1; k < column && offset < line.size(); ++k) do
            ++offset;
        while (offset < line.size() && is_continuation(line[offset]));
    return offset;
}

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// An entry, which may go over several lines: white space and line ends become one space.
std::string entry_on_one_line(std::string_view text) {
    std::string line;
    for (const char c : trimmed(text)) {
        const bool space = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (!space || line.back() != ' ') line += space ? ' ' : c;
    }
    return on_one_line(line);
}

/// What toml++ says, and what we say instead.
struct Wording {
    std::string_view theirs, ours, suggestion;
};
constexpr Wording wordings[] = {
    {"encountered end-of-file", "the file ends in the middle of an entry", "Complete it: is the file cut short?"},
    {"expected value,", "has no value", "Write one after the \"=\""},
    {"as table", "is a value and cannot be a table as well", "Keep one of the two"},
    {"existing table", "the table is given twice", "Put its keys under one heading"},
    {"redefine existing", "is given twice", "Keep one of the two"},
    {"leading zeroes", "a number cannot begin with 0", "Leave the leading zeros out"},
    {"not representable in 64 bits", "is too large for a whole number", "Whole numbers end at 9223372036854775807"},
    {"could not be interpreted", "is not a number that a computer can hold", "Numbers end near 1e308"},
    {"parsing boolean", "is not a value", "Put text in quotes; true and false are lower-case"},
    {"could not determine value type", "is not a value", "Put text in quotes, and one number or text after \"=\""},
    {"value-terminator", "is not a value", "Put text in quotes, as \"auto\" or \"2 um/s\""},
    {"parsing floating-point", "is not a number", "Write numbers as 0.5, 5.0 or 1e-3"},
    {"expected a comment or whitespace", "something follows the value",
     "One key a line; a value with a unit stands in quotes, as \"2 um/s\""},
    {"expected '='", "there is no \"=\" after the key", "Write key = value"},
    {"unescaped control", "the text has no closing quote", "Close it on the same line"},
    {"control characters", "there is a control character, or no closing quote",
     "Remove it, or close the text on its line"},
    {"expected keys", "there is no key before the \"=\"", "Write key = value"},
    {"expected ']'", "the table's heading has no closing \"]\"", "Write it as [rods]"},
    {"utf-8", "this is not text in UTF-8", "Is it a scene? Save it as UTF-8"},
    {"maximum nested", "is nested too deeply", "A scene has tables with keys, and nothing deeper"},
};

}  // namespace

std::string toml_text(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += std::string("\\") + c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            quoted += c;
    }
    return quoted + "\"";
}

TomlDocument::TomlDocument(std::string_view text, std::string file_name) : text_(text), file_(std::move(file_name)) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);  // byte order mark
    if (const std::size_t zero = text_.find('\0'); zero != std::string::npos)
        throw InputError(
            {"scene",
             "",
             "is not a text file",
             "a TOML file",
             "Give the scene, not an output of a run",
             {file_,
              static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(zero), '\n')) + 1,
              0}});
    for (std::size_t begin = 0, number = 1; begin < text_.size(); ++number) {
        const std::size_t end = std::min(text_.find('\n', begin), text_.size());
        if (end - begin > longest_line)
            throw InputError({"scene",
                              "",
                              "a line of " + std::to_string(end - begin) + " characters",
                              "at most " + std::to_string(longest_line),
                              "Is it a scene?",
                              {file_, static_cast<int>(number), 1}});
        begin = end + 1;
    }
    try {
        root_ = toml::parse(std::string_view(text_));
    } catch (const toml::parse_error& error) {
        refuse(error);
    }
}

void TomlDocument::refuse(const toml::parse_error& error) const {
    const toml::source_position at = error.source().begin;
    const std::string_view theirs = error.description();
    std::string problem = "is not valid TOML: " + std::string(theirs),
                suggestion = "Compare with the scene in the README";
    for (const Wording& wording : wordings)
        if (theirs.find(wording.theirs) != std::string_view::npos) {
            problem = wording.ours;
            suggestion = wording.suggestion;
            break;
        }
    // name the entry that the place lies in, if its line looks like one
    const std::string_view entry = trimmed(line(at.line));
    const std::size_t equals = entry.find('=');
    std::string key, value;
    const bool text = theirs.find("utf-8") == std::string_view::npos;  // else no message may repeat it
    if (text && (entry.starts_with('[') || equals == std::string_view::npos || equals == 0)) {
        value = entry_on_one_line(entry);
    } else if (text) {
        const std::string table = table_above(at.line);
        key = (table.empty() ? "" : table + ".") + entry_on_one_line(entry.substr(0, equals));
        value = entry_on_one_line(entry.substr(equals + 1));
    }
    throw InputError({key, value, problem, "", suggestion, place(error.source())});
}

const toml::node* TomlDocument::find(std::string_view table, std::string_view name) const {
    if (table.empty()) return root_.get(name);
    const toml::table* values = root_.get_as<toml::table>(table);
    return values ? values->get(name) : nullptr;
}

Place TomlDocument::place(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Place TomlDocument::place_of(std::string_view full_key) const {
    const std::size_t dot = full_key.find('.');
    const std::string_view table = dot == std::string_view::npos ? "" : full_key.substr(0, dot);
    const std::string_view name = dot == std::string_view::npos ? full_key : full_key.substr(dot + 1);
    if (const toml::node* value = find(table, name)) return place(value->source());
    if (const toml::node* values = table.empty() ? nullptr : root_.get(table)) return place(values->source());
    return {file_, 1, 1};
}

std::string TomlDocument::written(const toml::source_region& region) const {
    std::string text;
    for (std::uint32_t number = region.begin.line; number <= region.end.line; ++number) {
        const std::string_view whole = line(number);
        const std::size_t begin = number == region.begin.line ? offset_of(whole, region.begin.column) : 0;
        const std::size_t end = number == region.end.line ? offset_of(whole, region.end.column) : whole.size();
        text += whole.substr(begin, end - begin);
        text += ' ';
    }
    return entry_on_one_line(text);
}

/// Beyond the text if it has no such line.
std::size_t TomlDocument::begin_of_line(std::uint32_t number) const {
    std::size_t begin = number == 0 ? std::string::npos : 0;
    for (std::uint32_t k = 1; k < number && begin != std::string::npos; ++k) {
        begin = text_.find('\n', begin);
        if (begin != std::string::npos) ++begin;
    }
    return std::min(begin, text_.size());
}

std::string_view TomlDocument::line(std::uint32_t number) const {
    const std::size_t begin = begin_of_line(number);
    return std::string_view(text_).substr(begin, text_.find('\n', begin) - begin);
}

std::size_t TomlDocument::offset(const toml::source_position& position) const {
    return begin_of_line(position.line) + offset_of(line(position.line), position.column);
}

std::string TomlDocument::text_with(std::string_view table, std::string_view name, std::string_view value) const {
    std::string text = text_;
    const std::string entry = std::string(name) + " = " + std::string(value);
    if (const toml::node* old = find(table, name)) {
        const std::size_t begin = offset(old->source().begin);
        return text.replace(begin, end_of(*old) - begin, value);
    }
    if (table.empty()) return entry + "\n" + text;
    const bool ends = text.empty() || text.back() == '\n';
    const toml::table* keys = root_.get_as<toml::table>(table);
    if (!keys) return text + (ends ? "" : "\n") + "\n[" + std::string(table) + "]\n" + entry + "\n";
    const std::uint32_t number = keys->source().begin.line;
    if (keys->is_inline())
        return text.insert(offset(keys->source().begin) + 1, " " + entry + (keys->empty() ? "" : ","));
    if (!trimmed(line(number)).starts_with('['))  // of dotted keys, as box.volume_fraction = 0.2
        return text.insert(begin_of_line(number), std::string(table) + "." + entry + "\n");
    if (begin_of_line(number + 1) == text.size() && !ends) text += '\n';
    return text.insert(begin_of_line(number + 1), entry + "\n");
}

std::string TomlDocument::text_without(std::string_view table, std::string_view name) const {
    const toml::table* keys = table.empty() ? &root_ : root_.get_as<toml::table>(table);
    const auto entry = keys ? keys->find(name) : toml::table::const_iterator{};
    if (!keys || entry == keys->end() || keys->is_inline()) return text_;
    const std::uint32_t number = entry->first.source().begin.line;
    std::size_t begin = begin_of_line(number), end = end_of(entry->second);
    if (trimmed(std::string_view(text_).substr(end, text_.find('\n', end) - end)).empty())
        end = std::min(text_.find('\n', end), text_.size() - 1) + 1;  // the line with it
    return std::string(text_).erase(begin, end - begin);
}

std::string TomlDocument::table_above(std::uint32_t line_number) const {
    for (std::uint32_t number = line_number - 1; number > 0; --number) {
        const std::string_view heading = trimmed(line(number));
        if (heading.starts_with('[') && !heading.starts_with("[["))
            return entry_on_one_line(heading.substr(1, heading.find(']') - 1));
    }
    return "";
}

}  // namespace jostle
