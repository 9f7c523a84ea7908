#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/domain/domain.hpp"

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
/// pairs of its rods that come before it have theirs.) So ranks find the same colours, in rounds: each goes as far as
/// it can with the pairs of its own rods; then both ranks of a pair between them decide, by what they have told each
/// other and by nothing newer, whether its turn has come.
class PairColours {
public:
    /// `plane`: a body that contacts push, if any. Each contact with it is a pair of its own, so that the two ends of a
    /// rod at it have two colours.
    explicit PairColours(std::optional<std::uint32_t> plane = std::nullopt) : plane_(plane) {}

    /// Colours the pairs of the contacts that the matrix has been extended by; earlier pairs keep theirs.
    /// Returns these pairs by colours, as many as any rank needs. Errors: InputError if a rod has more neighbours than
    /// there are colours, and ranks share the rods.
    const std::vector<std::vector<ContactPair>>& extend(const ContactMatrix& contact_matrix,
                                                        const Domain& domain = Domain::whole());

private:
    /// A pair in the list of one of its rods.
    struct Turn {
        std::uint64_t priority;
        std::uint32_t pair;
    };

    void list_new_pairs(const ContactMatrix& contact_matrix);
    void list_pairs_between_ranks(const ContactMatrix& contact_matrix, const Domain& domain);
    void colour_ready_pairs();
    void colour_between_ranks(const ContactMatrix& contact_matrix, const Domain& domain);
    void list_turns(const ContactMatrix& contact_matrix);
    bool comes_before(const Turn& a, const Turn& b, const ContactMatrix& contact_matrix) const;
    bool is_next_of(std::uint32_t local, std::uint32_t pair) const { return turns_[next_[local]].pair == pair; }
    bool waits_for_ranks(std::uint32_t pair) const { return !is_between_.empty() && is_between_[pair] == 1; }
    void give_colour(std::uint32_t pair);
    void advance_both(std::uint32_t pair);
    void advance(std::uint32_t local);
    void give_colours_beyond_most(const ContactMatrix& contact_matrix);

    std::optional<std::uint32_t> plane_;
    std::vector<std::uint64_t> taken_;  ///< (n) a bit for each colour that a rod has
    std::size_t coloured_ = 0;          ///< contacts taken in
    std::vector<std::vector<ContactPair>> by_colour_;
    // of the pairs that are taken in
    std::vector<ContactPair> pairs_;
    std::vector<std::uint64_t> priority_;   ///< (pairs)
    std::vector<std::uint8_t> colour_;      ///< (pairs)
    std::vector<std::uint8_t> is_between_;  ///< (pairs) one of its rods is another rank's; empty without ranks
    std::vector<std::uint32_t> begin_;      ///< (n + 1) into turns_
    std::vector<Turn> turns_;               ///< of each local index, the next first
    std::vector<std::uint32_t> next_;       ///< (n) whose turn it is: an index into turns_
    std::vector<std::uint32_t> ready_;      ///< pairs whose turn it is at both rods
    std::vector<std::uint32_t> beyond_;     ///< pairs for which no colour was left
};

}  // namespace jostle
