#include "jostle/scene/mistakes.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace jostle {

namespace {

constexpr std::size_t max_told = 20;

std::pair<int, int> line_and_column(const InputError& error) {
    return {error.parts().place.line, error.parts().place.column};
}

}  // namespace

void Mistakes::add(const InputError& error) {
    InputError::Parts first = error.parts();
    const std::vector<InputError::Parts> others = std::move(first.others);
    first.others.clear();
    const InputError alone(std::move(first));
    const auto same = [&](const InputError& known) { return std::string_view(known.what()) == alone.what(); };
    if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(alone);
    for (const InputError::Parts& other : others) add(InputError(other));
}

void Mistakes::sort_by_place() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const InputError& a, const InputError& b) { return line_and_column(a) < line_and_column(b); });
}

void Mistakes::refuse_any() const {
    if (found_.empty()) return;
    const std::size_t told = std::min(found_.size(), max_told);
    std::vector<InputError> others(found_.begin() + 1, found_.begin() + static_cast<std::ptrdiff_t>(told));
    if (told < found_.size())
        others.push_back(InputError({.problem = std::to_string(found_.size() - told) + " more mistakes"}));
    throw found_.front().with_others(others);
}

}  // namespace jostle
