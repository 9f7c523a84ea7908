#pragma once

#include <stdexcept>
#include <string>

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
/// with the parts that are empty left out; for a table with several bad rows, such a line for each (RowProblems).
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
    };

    explicit InputError(Parts parts) : std::runtime_error(message(parts)), parts_(std::move(parts)) {}

    const Parts& parts() const { return parts_; }

    /// The same error with the place where its key stands.
    InputError with_place(Place place) const {
        Parts parts = parts_;
        parts.place = std::move(place);
        return InputError(std::move(parts));
    }

private:
    static std::string message(const Parts& parts);
    Parts parts_;
};

}  // namespace jostle
