#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace jostle {

/// Where in a text file a value stands; line and column count from 1, 0 means unknown.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
};

/// Input that jostle refuses: one problem, told so that the user can mend it without reading the source.
///
/// `what()` is the whole message on one line:
///   FILE:LINE:COLUMN: KEY = VALUE: PROBLEM (allowed: RANGE). SUGGESTION
/// with the parts that are empty left out; for a table with several bad rows (RowProblems), and of a scene with several
/// mistakes, such a line for each.
/// Checks deep in the program know key and value but not the place; the scene reader catches the error, and rethrows
/// `with_place`.
class InputError : public std::runtime_error {
public:
    struct Parts {
        std::string key{};         ///< full key, as "box.volume_fraction", or a command-line option, or a file's role
        std::string value{};       ///< the offending value as the user wrote it
        std::string problem{};     ///< what is wrong, a clause without a full stop
        std::string allowed{};     ///< the allowed range or the allowed words
        std::string suggestion{};  ///< what to do about it, a sentence without a full stop
        Place place{};
        std::vector<Parts> others{};  ///< of the same input, told below it; they have no others
    };

    explicit InputError(Parts parts) : std::runtime_error(message(parts)), parts_(std::move(parts)) {}

    const Parts& parts() const { return parts_; }

    /// The same error with the place where its key stands; the others, too, where they have none.
    InputError with_place(const Place& place) const;

    /// The same error, and others of the same input.
    InputError with_others(const std::vector<InputError>& others) const;

private:
    static std::string message(const Parts& parts);
    Parts parts_;
};

}  // namespace jostle
