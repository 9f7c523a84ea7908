#pragma once

#include <algorithm>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

/// What a search finds for some of the rods.
struct FoundContacts {
    Contacts contacts;
    double overlap = 0.0;  ///< the largest, max(0, -gap)
};

/// Calls search(k, found) for all k in [0, count), and appends the contacts that it finds in the order of k, for any
/// number of threads. Returns the largest overlap. `blocks`: room for what is found, kept from call to call.
template <class Search>
double append_found(std::size_t count, std::vector<FoundContacts>& blocks, Contacts& contacts, Search&& search) {
    constexpr std::size_t block_size = 256;  // looked at together
    blocks.resize((count + block_size - 1) / block_size);
    parallel_for_parts(blocks.size(), [&](std::size_t block) {
        FoundContacts& found = blocks[block];
        found.contacts.clear();
        found.overlap = 0.0;
        const std::size_t end = std::min(count, (block + 1) * block_size);
        for (std::size_t k = block * block_size; k < end; ++k) search(k, found);
    });
    contacts.append(blocks.size(), [&](std::size_t block) -> const Contacts& { return blocks[block].contacts; });
    double overlap = 0.0;
    for (const FoundContacts& found : blocks) overlap = std::max(overlap, found.overlap);
    return overlap;
}

}  // namespace jostle
