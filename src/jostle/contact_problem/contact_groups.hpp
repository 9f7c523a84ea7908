#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "jostle/contact_problem/border_messages.hpp"
#include "jostle/contact_problem/contact_blocks.hpp"
#include "jostle/contact_problem/pair_colours.hpp"
#include "jostle/contact_problem/plane_contacts.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

/// Contacts of one kind and colour. Their order does not matter to the result: those active come first in each block
/// of as many as stay in a near cache with their rods' velocities.
template <class Item>
struct ContactGroup {
    static constexpr std::size_t block_size = 128;
    std::vector<Item> items;
    std::vector<Visit> visits;                ///< (items)
    std::vector<typename Item::Forces> last;  ///< (items) by what the last `sweep_on` changed their forces; or none
    std::vector<std::uint8_t> active;         ///< (blocks) how many are
    std::size_t all_active = 0;

    template <class T>
    std::span<T> block_of(std::vector<T>& of_items, std::size_t number) {
        const std::size_t begin = number * block_size;
        return std::span(of_items).subspan(begin, std::min(block_size, items.size() - begin));
    }
    std::span<Item> block(std::size_t number) { return block_of(items, number); }
    bool is_active(std::size_t item) const { return item % block_size < active[item / block_size]; }

    /// Brings the items from `first` on that are active to the front of their blocks; of those before, as many are
    /// as `active` tells.
    template <class IsActive>
    void sort_out(std::size_t first, IsActive&& is_active) {
        const std::size_t known_blocks = first / block_size;  // with nothing new
        active.resize((items.size() + block_size - 1) / block_size, 0);
        parallel_for_blocks(items.size() - known_blocks * block_size, block_size,
                            [&](std::size_t new_block, std::size_t, std::size_t) {
                                const std::size_t number = known_blocks + new_block, begin = number * block_size;
                                const auto in_block = block(number);
                                std::size_t k = first > begin ? first - begin : 0;
                                std::size_t front = k > 0 ? active[number] : 0;
                                for (; k < in_block.size(); ++k) {
                                    if (!is_active(in_block[k])) continue;
                                    if (front != k) {
                                        std::swap(in_block[front], in_block[k]);
                                        std::swap(visits[begin + front], visits[begin + k]);
                                        if (!last.empty()) std::swap(last[begin + front], last[begin + k]);
                                    }
                                    ++front;
                                }
                                active[number] = static_cast<std::uint8_t>(front);
                            });
        all_active = std::accumulate(active.begin(), active.end(), std::size_t{0});
    }
};

template <class Real>
struct ContactKinds {
    ContactGroup<ScalarBlock<Real>> singles;
    ContactGroup<CoupledBlock> pairs;

    /// Calls body(group) for those that are not empty.
    template <class Body>
    void for_groups(Body&& body) {
        if (!singles.items.empty()) body(singles);
        if (!pairs.items.empty()) body(pairs);
    }
};

/// The contacts of one colour.
template <class Real>
struct ColourContacts {
    ContactKinds<Real> inner;      ///< of this rank's own rods
    ContactKinds<Real> border;     ///< with a rod of another rank; added up here
    ContactKinds<Real> elsewhere;  ///< with a rod of another rank, which adds them up
    ContactKinds<Real> borrowed;   ///< of other ranks' rods (borrow_contacts)
    PlaneContacts<Real> at_plane;
    std::vector<ContactPair> between;  ///< pairs between ranks
    BorderMessages messages;           ///< velocities of other ranks' rods, as they are before this colour

    /// Calls body(group) for contacts of this rank's own rods.
    template <class Body>
    void for_own(Body&& body) {
        for (ContactKinds<Real>* kinds : {&inner, &border, &elsewhere}) kinds->for_groups(body);
    }
    /// Calls body(group) for all but those at the plane.
    template <class Body>
    void for_all(Body&& body) {
        for_own(body);
        borrowed.for_groups(body);
    }
};

}  // namespace jostle
