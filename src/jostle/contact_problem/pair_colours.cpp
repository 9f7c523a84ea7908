#include "jostle/contact_problem/pair_colours.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <tuple>

#include "jostle/contact_problem/block_problem.hpp"
#include "jostle/contact_problem/border_messages.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/mixed_bits.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t max_colours = 64;

std::uint64_t priority_of(std::uint64_t id_i, std::uint64_t id_j, const Image& image) {
    std::uint64_t hash = mixed_bits(mixed_bits(id_i) + id_j);
    if (image == Image{0, 0, 0}) return hash;
    for (const std::int32_t k : image) hash = mixed_bits(hash + static_cast<std::uint32_t>(k));
    return hash;
}

/// By which pairs get their colours: the same on all ranks.
struct PairPriority {
    std::uint64_t priority = 0, i = ~std::uint64_t{0}, j = ~std::uint64_t{0};
    Image image{};
    bool operator==(const PairPriority&) const = default;
};

/// Whether i is a rod beside j: neither a fixed body, nor j itself, which meets its own image.
bool has_other_rod(const ContactPair& pair) {
    return pair.i != no_local_index && pair.i != pair.j;
}

}  // namespace

const std::vector<std::vector<ContactPair>>& PairColours::extend(const ContactMatrix& contact_matrix,
                                                                 const Domain& domain) {
    for (auto& pairs : by_colour_) pairs.clear();
    list_new_pairs(contact_matrix);
    if (domain.is_shared()) list_pairs_between_ranks(contact_matrix, domain);
    list_turns(contact_matrix);
    beyond_.clear();
    colour_ready_pairs();
    if (domain.is_shared()) colour_between_ranks(contact_matrix, domain);
    // In the order of contacts, so that neighbours in a colour are near each other in memory.
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        if (colour_[p] < max_colours) by_colour_[colour_[p]].push_back(pairs_[p]);
    if (!beyond_.empty()) give_colours_beyond_most(contact_matrix);
    return by_colour_;
}

void PairColours::colour_ready_pairs() {
    while (!ready_.empty()) {
        const std::uint32_t pair = ready_.back();
        ready_.pop_back();
        give_colour(pair);
        advance_both(pair);
    }
}

void PairColours::list_pairs_between_ranks(const ContactMatrix& contact_matrix, const Domain& domain) {
    is_between_.resize(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        is_between_[p] = is_between_ranks(pairs_[p], contact_matrix, domain) ? 1 : 0;
}

/// And all that wait for those between ranks.
void PairColours::colour_between_ranks(const ContactMatrix& contact_matrix, const Domain& domain) {
    std::vector<std::uint32_t> waiting;
    std::vector<ContactPair> between;
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
        if (!waits_for_ranks(p)) continue;
        waiting.push_back(p);
        between.push_back(pairs_[p]);
    }
    const auto priority_key = [&](std::uint32_t p) -> PairPriority {
        const std::uint32_t l = pairs_[p].first;
        return {priority_[p], contact_matrix.id_of_i(l), contact_matrix.id_of_j(l), contact_matrix.contacts().image[l]};
    };
    struct Standing {
        PairPriority turn;  ///< whose it is
        std::uint64_t taken;
    };
    BorderMessages messages(domain, contact_matrix, between, sizeof(Standing));
    std::vector<Standing> standing(contact_matrix.rods().size());
    for (;;) {
        for (const ContactPair& pair : between)
            for (const std::uint32_t local : {pair.i, pair.j})
                standing[local] = {
                    next_[local] < begin_[local + 1] ? priority_key(turns_[next_[local]].pair) : PairPriority{},
                    taken_[local]};
        messages.bring(std::span(standing));
        std::vector<std::uint32_t> decided;
        std::erase_if(waiting, [&](std::uint32_t p) {
            const auto [i, j, first, count] = pairs_[p];
            const PairPriority key = priority_key(p);
            const bool is_next =
                standing[i].turn == key && standing[j].turn == key && is_next_of(i, p) && is_next_of(j, p);
            if (is_next) decided.push_back(p);
            return is_next;
        });
        for (const std::uint32_t p : decided) {
            taken_[pairs_[p].i] = standing[pairs_[p].i].taken;
            taken_[pairs_[p].j] = standing[pairs_[p].j].taken;
            give_colour(p);
        }
        for (const std::uint32_t p : decided) advance_both(p);
        colour_ready_pairs();
        std::array<std::int64_t, 2> left_and_decided = {static_cast<std::int64_t>(waiting.size()),
                                                        static_cast<std::int64_t>(decided.size())};
        domain.ranks().add_up(left_and_decided);
        if (left_and_decided[0] == 0) break;
        if (left_and_decided[1] == 0) throw std::logic_error("ranks disagree about the pairs between them");
    }
    if (domain.ranks().any(!beyond_.empty()))
        throw InputError({.key = "rods",
                          .problem = "one of them touches more than 64 others, which is not ready for several ranks",
                          .suggestion = "Run it on one"});
    by_colour_.resize(static_cast<std::size_t>(domain.ranks().largest(static_cast<double>(by_colour_.size()))));
}

void PairColours::list_new_pairs(const ContactMatrix& contact_matrix) {
    const auto rods = contact_matrix.rod_pairs();
    const Contacts& contacts = contact_matrix.contacts();
    pairs_.clear();
    for (auto l = static_cast<std::uint32_t>(coloured_); l < rods.size();) {
        const auto [i, j] = rods[l];
        std::uint32_t next = l + 1;
        const std::uint32_t most = contacts.contact[l].i == plane_ ? 1 : max_points;
        while (next < rods.size() && next < l + most && pair_of(contacts, next) == pair_of(contacts, l)) ++next;
        pairs_.push_back({i, j, l, next - l});
        l = next;
    }
    coloured_ = rods.size();
    colour_.assign(pairs_.size(), max_colours);
    priority_.resize(pairs_.size());
    parallel_for(pairs_.size(), [&](std::size_t p) {
        const ContactPair& pair = pairs_[p];
        priority_[p] = priority_of(contact_matrix.id_of_i(pair.first), contact_matrix.id_of_j(pair.first),
                                   contacts.image[pair.first]);
    });
}

/// Lists the new pairs of each rod in the order of their turns, and those that are first at both.
void PairColours::list_turns(const ContactMatrix& contact_matrix) {
    const std::size_t count = contact_matrix.rods().size();
    taken_.resize(count, 0);
    begin_.assign(count + 1, 0);
    for (const ContactPair& pair : pairs_) {
        if (has_other_rod(pair)) ++begin_[pair.i + 1];
        ++begin_[pair.j + 1];
    }
    for (std::size_t k = 0; k < count; ++k) begin_[k + 1] += begin_[k];
    turns_.resize(begin_.back());
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
        const ContactPair& pair = pairs_[p];
        if (has_other_rod(pair)) turns_[next_[pair.i]++] = {priority_[p], p};
        turns_[next_[pair.j]++] = {priority_[p], p};
    }
    parallel_for(count, [&](std::size_t local) {
        const auto first = turns_.begin() + begin_[local], last = turns_.begin() + begin_[local + 1];
        if (last - first > 1)
            std::sort(first, last, [&](const Turn& a, const Turn& b) { return comes_before(a, b, contact_matrix); });
        next_[local] = begin_[local];
    });
    ready_.clear();
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
        if (!waits_for_ranks(p) && is_next_of(pairs_[p].j, p) &&
            (!has_other_rod(pairs_[p]) || is_next_of(pairs_[p].i, p)))
            ready_.push_back(p);
}

bool PairColours::comes_before(const Turn& a, const Turn& b, const ContactMatrix& contact_matrix) const {
    if (a.priority != b.priority) return a.priority < b.priority;
    // The same rods in several images, or at points that were found one after the other; or, once in 10^19, others.
    const auto key = [&](const Turn& turn) {
        const ContactPair& pair = pairs_[turn.pair];
        return std::tuple(contact_matrix.id_of_i(pair.first), contact_matrix.id_of_j(pair.first),
                          contact_matrix.contacts().image[pair.first], pair.first);
    };
    return key(a) < key(b);
}

void PairColours::give_colour(std::uint32_t number) {
    const ContactPair& pair = pairs_[number];
    const bool two_rods = has_other_rod(pair);
    const std::uint64_t taken = taken_[pair.j] | (two_rods ? taken_[pair.i] : 0);
    const auto colour = static_cast<std::size_t>(std::countr_one(taken));
    if (colour >= max_colours) {  // a rod with very many neighbours
        beyond_.push_back(number);
        return;
    }
    if (two_rods) taken_[pair.i] |= std::uint64_t{1} << colour;
    taken_[pair.j] |= std::uint64_t{1} << colour;
    colour_[number] = static_cast<std::uint8_t>(colour);
    if (by_colour_.size() <= colour) by_colour_.resize(colour + 1);
}

void PairColours::advance_both(std::uint32_t number) {
    const ContactPair& pair = pairs_[number];
    if (has_other_rod(pair)) advance(pair.i);
    advance(pair.j);
}

/// The pair of a rod whose turn it was has its colour: the next may be ready.
void PairColours::advance(std::uint32_t local) {
    if (++next_[local] == begin_[local + 1]) return;
    const std::uint32_t p = turns_[next_[local]].pair;
    if (waits_for_ranks(p)) return;
    const ContactPair& pair = pairs_[p];
    const std::uint32_t other = pair.i == local || !has_other_rod(pair) ? pair.j : pair.i;
    if (next_[other] < begin_[other + 1] && is_next_of(other, p)) ready_.push_back(p);
}

/// Each alone, in order.
void PairColours::give_colours_beyond_most(const ContactMatrix& contact_matrix) {
    std::sort(beyond_.begin(), beyond_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return comes_before({priority_[a], a}, {priority_[b], b}, contact_matrix);
    });
    for (const std::uint32_t p : beyond_) {
        by_colour_.resize(std::max(by_colour_.size(), max_colours));
        by_colour_.push_back({pairs_[p]});
    }
}

}  // namespace jostle
