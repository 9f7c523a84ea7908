#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace jostle {

/// Numbers under names, as checkpoints hold sums: what is read asks for each by its name.
using NamedNumbers = std::map<std::string, std::vector<double>, std::less<>>;

/// Adds all of `from` under "prefix.name".
inline void add_under(std::string_view prefix, NamedNumbers& to, const NamedNumbers& from) {
    for (const auto& [name, values] : from) to.emplace(std::string(prefix) + "." + name, values);
}

/// Takes all whose names begin with "prefix." out, under what follows.
inline NamedNumbers taken_under(std::string_view prefix, NamedNumbers& from) {
    const std::string beginning = std::string(prefix) + ".";
    NamedNumbers taken;
    for (auto at = from.lower_bound(beginning); at != from.end() && at->first.starts_with(beginning);
         at = from.erase(at))
        taken.emplace(at->first.substr(beginning.size()), std::move(at->second));
    return taken;
}

}  // namespace jostle
