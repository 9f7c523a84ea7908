#pragma once

#include <utility>
#include <vector>

#include "jostle/error/input_error.hpp"

namespace jostle {

/// What is wrong with an input, found by several checks and told at once.
class Mistakes {
public:
    /// Makes a check; what it throws is kept.
    template <class Check>
    void look(Check&& check) {
        try {
            std::forward<Check>(check)();
        } catch (const InputError& error) {
            add(error);
        }
    }
    /// Each of those that the error tells; none that is there already.
    void add(const InputError& error);

    bool empty() const { return found_.empty(); }
    const std::vector<InputError>& found() const { return found_; }

    /// In the order of their lines.
    void sort_by_place();

    /// Throws the first as InputError, with the others, if there is any; of more than twenty with their number.
    void refuse_any() const;

private:
    std::vector<InputError> found_;
};

}  // namespace jostle
