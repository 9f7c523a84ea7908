#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"

namespace jostle {

/// The contacts of one pair of bodies in one image, which follow each other.
struct ContactPair {
    std::uint32_t i, j;          ///< local indices; i of a fixed body: no_local_index
    std::uint32_t first, count;  ///< contacts
};

/// Colours for pairs of bodies in contact, no two of a colour with a rod in common: greedily, every pair takes the
/// first colour that neither of its rods has yet, in the order of a hash of the ids of its bodies. A fixed body takes
/// no colour: what it pushes does not hang together through it.
///
/// The colours depend on who touches whom, and on nothing else: neither on where rods stand in memory nor on the order
/// of contacts. (M. T. Jones, P. E. Plassmann, SIAM J. Sci. Comput. 14, 654 (1993): a pair has its colour once all
/// pairs of its rods that come before it have theirs.)
class PairColours {
public:
    /// Colours the pairs of the contacts that the matrix has been extended by; earlier pairs keep theirs.
    /// Returns these pairs by colours.
    const std::vector<std::vector<ContactPair>>& extend(const ContactMatrix& contact_matrix);

private:
    /// A pair in the list of one of its rods.
    struct Turn {
        std::uint64_t priority;
        std::uint32_t pair;
    };

    void list_new_pairs(const ContactMatrix& contact_matrix);
    void list_turns(const ContactMatrix& contact_matrix);
    bool comes_before(const Turn& a, const Turn& b, const ContactMatrix& contact_matrix) const;
    bool is_next_of(std::uint32_t local, std::uint32_t pair) const { return turns_[next_[local]].pair == pair; }
    void give_colour(std::uint32_t pair);
    void advance(std::uint32_t local);
    void give_colours_beyond_most(const ContactMatrix& contact_matrix);

    std::vector<std::uint64_t> taken_;  ///< (n) a bit for each colour that a rod has
    std::size_t coloured_ = 0;          ///< contacts taken in
    std::vector<std::vector<ContactPair>> by_colour_;
    // of the pairs that are taken in
    std::vector<ContactPair> pairs_;
    std::vector<std::uint64_t> priority_;  ///< (pairs)
    std::vector<std::uint8_t> colour_;     ///< (pairs)
    std::vector<std::uint32_t> begin_;     ///< (n + 1) into turns_
    std::vector<Turn> turns_;              ///< of each local index, the next first
    std::vector<std::uint32_t> next_;      ///< (n) whose turn it is: an index into turns_
    std::vector<std::uint32_t> ready_;     ///< pairs whose turn it is at both rods
    std::vector<std::uint32_t> beyond_;    ///< pairs for which no colour was left
};

}  // namespace jostle
