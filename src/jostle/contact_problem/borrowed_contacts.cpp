#include "jostle/contact_problem/borrowed_contacts.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace jostle {

namespace {

/// A rod, to all ranks.
struct RodName {
    std::uint64_t id = 0;
    int rank = 0;  ///< that has it
    /// There; `no_local_index` if a pair between ranks tells of it: then its rank finds it by its id.
    std::uint32_t local = no_local_index;
};

/// Asks for the pairs of a rod of the colours [first, end), or, of messages, for its velocity before colour `first`.
struct Request {
    RodName rod;
    std::uint32_t first = 0, end = 0;
};

/// A contact, or those of a pair, and all that has to be known to solve it. Both rods are j where i is a fixed body.
template <class Item>
struct Loan {
    Item item;
    typename Item::Forces last;
    float solved;
    bool is_active;
    std::uint32_t colour;
    RodName i, j;
    MobileRod of_i, of_j;
};

template <class Real>
struct Loans {
    std::vector<Loan<ScalarBlock<Real>>> singles;
    std::vector<Loan<CoupledBlock>> pairs;

    auto& of(const ScalarBlock<Real>&) { return singles; }
    auto& of(const CoupledBlock&) { return pairs; }
};

/// The number of the first contact.
template <class Real>
std::uint32_t first_contact(const ScalarBlock<Real>& contact) {
    return contact.number;
}
std::uint32_t first_contact(const CoupledBlock& pair) {
    return pair.first;
}

/// Writes the places that rods have here.
template <class Real>
void put_locals(ScalarBlock<Real>& contact, std::uint32_t i, std::uint32_t j) {
    contact.i = i;
    contact.j = j;
}
void put_locals(CoupledBlock& pair, std::uint32_t i, std::uint32_t j) {
    if (pair.i != no_local_index) pair.i = i;
    pair.j = j;
}

/// Tells other ranks of pairs of this rank's own rods.
template <class Real>
class Lender {
public:
    Lender(const Domain& domain, const DelassusOperator& matrix, std::span<ColourContacts<Real>> colours)
        : domain_(domain), matrix_(matrix), colours_(colours) {
        for (const ColourContacts<Real>& colour : colours)
            for (const ContactPair& pair : colour.between)
                for (const std::uint32_t local : {pair.i, pair.j})
                    if (is_own(local)) at_border_[id_of(pair.first, local)] = local;
        list_items();
    }

    bool is_own(std::uint32_t local) const { return domain_.owns(matrix_.contact_matrix().rods()[local]); }

    /// One of the rods of a contact.
    RodName name(std::uint32_t contact, std::uint32_t local) const {
        const std::uint64_t id = id_of(contact, local);
        if (is_own(local)) return {id, domain_.ranks().rank(), local};
        const std::size_t peer = domain_.peer_of(matrix_.contact_matrix().rods()[local]);
        return {id, domain_.rank_of_peer(peer), no_local_index};
    }

    /// The local index of an own rod that another rank has named.
    std::uint32_t local_of(const RodName& rod) const {
        if (rod.local != no_local_index) return rod.local;
        const auto found = at_border_.find(rod.id);
        if (found == at_border_.end()) throw std::logic_error("ranks disagree about the pairs between them");
        return found->second;
    }

    void answer(const Request& request, Loans<Real>& loans) const {
        const std::uint32_t local = local_of(request.rod);
        for (std::uint32_t k = begin_[local]; k < begin_[local + 1]; ++k) {
            const Place& place = places_[k];
            if (place.colour < request.first || place.colour >= request.end) continue;
            ColourContacts<Real>& colour = colours_[place.colour];
            ContactKinds<Real>* const parts[] = {&colour.inner, &colour.border, &colour.elsewhere};
            ContactKinds<Real>& kinds = *parts[place.part];
            if (place.is_single)
                lend(kinds.singles, place, loans);
            else
                lend(kinds.pairs, place, loans);
        }
    }

private:
    /// Where an item is.
    struct Place {
        std::uint8_t colour, part;
        bool is_single;
        std::uint32_t number;
    };

    /// Of one of the rods of a contact.
    std::uint64_t id_of(std::uint32_t contact, std::uint32_t local) const {
        const ContactMatrix& contact_matrix = matrix_.contact_matrix();
        return contact_matrix.rod_pairs()[contact].j == local ? contact_matrix.id_of_j(contact)
                                                              : contact_matrix.id_of_i(contact);
    }

    template <class Item>
    void lend(const ContactGroup<Item>& group, const Place& place, Loans<Real>& loans) const {
        const Item& item = group.items[place.number];
        const Visit& visit = group.visits[place.number];
        const std::uint32_t contact = first_contact(item);
        const auto last = group.last.empty() ? typename Item::Forces{} : group.last[place.number];
        loans.of(item).push_back({item, last, visit.solved, group.is_active(place.number), place.colour,
                                  name(contact, visit.i), name(contact, visit.j), matrix_.rods()[visit.i],
                                  matrix_.rods()[visit.j]});
    }

    /// Calls body(visit, place) for all items.
    template <class Body>
    void for_items(Body&& body) const {
        for (std::size_t c = 0; c < colours_.size(); ++c) {
            std::uint8_t part = 0;
            for (ContactKinds<Real>* kinds : {&colours_[c].inner, &colours_[c].border, &colours_[c].elsewhere}) {
                const auto pass = [&](const std::vector<Visit>& visits, bool is_single) {
                    for (std::uint32_t k = 0; k < visits.size(); ++k)
                        body(visits[k], Place{static_cast<std::uint8_t>(c), part, is_single, k});
                };
                pass(kinds->singles.visits, true);
                pass(kinds->pairs.visits, false);
                ++part;
            }
        }
    }

    void list_items() {
        begin_.assign(matrix_.rods().size() + 1, 0);
        for_items([&](const Visit& visit, const Place&) {
            ++begin_[visit.i + 1];
            if (visit.j != visit.i) ++begin_[visit.j + 1];
        });
        for (std::size_t local = 0; local + 1 < begin_.size(); ++local) begin_[local + 1] += begin_[local];
        places_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for_items([&](const Visit& visit, const Place& place) {
            places_[next[visit.i]++] = place;
            if (visit.j != visit.i) places_[next[visit.j]++] = place;
        });
    }

    const Domain& domain_;
    const DelassusOperator& matrix_;
    std::span<ColourContacts<Real>> colours_;
    std::unordered_map<std::uint64_t, std::uint32_t> at_border_;  ///< local indices of own rods in pairs between ranks
    std::vector<std::uint32_t> begin_;                            ///< (n + 1) into places_
    std::vector<Place> places_;
};

/// Finds out what is needed of other ranks' rods.
template <class Real>
class Borrower {
public:
    Borrower(const Domain& domain, std::size_t local_rods, std::size_t colours_per_phase)
        : domain_(domain),
          colours_per_phase_(colours_per_phase),
          next_local_(static_cast<std::uint32_t>(local_rods)),
          requests_(static_cast<std::size_t>(domain.ranks().count())) {}

    /// Notes that a pair of this colour has the rod, and asks for what its velocity depends on. `local`: where the rod
    /// is here, if it is known already. Returns where it is.
    std::uint32_t need(const RodName& name, std::uint32_t colour, const MobileRod& rod,
                       std::uint32_t local = no_local_index) {
        const auto [found, is_new] = numbers_.try_emplace(name.id, rods_.size());
        if (is_new) {
            if (local == no_local_index) {
                local = next_local_++;
                added_.push_back(rod);
            }
            rods_.push_back({name, local});
        }
        Foreign& foreign = rods_[found->second];
        const std::size_t phase = colour / colours_per_phase_;
        foreign.phases |= std::uint64_t{1} << phase;
        if (foreign.asked.size() <= phase) foreign.asked.resize(phase + 1, 0);
        std::uint32_t& asked = foreign.asked[phase];
        asked = std::max(asked, static_cast<std::uint32_t>(phase * colours_per_phase_));
        if (asked < colour) {
            requests_[static_cast<std::size_t>(name.rank)].push_back({foreign.name, asked, colour});
            asked = colour;
        }
        return foreign.local;
    }

    /// Takes what is new; others' rods that it needs are asked for next.
    template <class Item>
    void take(std::vector<Loan<Item>>& arrived) {
        for (Loan<Item>& loan : arrived) {
            const int here = domain_.ranks().rank();
            if (loan.i.rank == here || loan.j.rank == here) continue;  // a pair between ranks, which is known
            const std::uint32_t j = need(loan.j, loan.colour, loan.of_j), i = need(loan.i, loan.colour, loan.of_i);
            std::uint64_t& known = rods_[numbers_.at(loan.j.id)].colours;
            const std::uint64_t bit = std::uint64_t{1} << loan.colour;
            if ((known & bit) != 0) continue;  // its other rank has told of it
            known |= bit;
            put_locals(loan.item, i, j);
            taken_.of(loan.item).push_back(loan);
        }
    }

    /// Puts what has been taken into the groups of its colours, what is active first.
    void fill(std::span<ColourContacts<Real>> colours) const {
        for (const bool is_active : {true, false}) {
            for (const auto& loan : taken_.singles)
                if (loan.is_active == is_active) append(loan, colours[loan.colour].borrowed.singles);
            for (const auto& loan : taken_.pairs)
                if (loan.is_active == is_active) append(loan, colours[loan.colour].borrowed.pairs);
        }
        for (ColourContacts<Real>& colour : colours)
            colour.borrowed.for_groups([](auto& group) { note_blocks(group); });
    }

    std::vector<std::vector<Request>> take_requests() {
        return std::exchange(requests_, std::vector<std::vector<Request>>(requests_.size()));
    }
    bool has_requests() const {
        return std::any_of(requests_.begin(), requests_.end(), [](const auto& of_rank) { return !of_rank.empty(); });
    }
    std::vector<MobileRod> take_added() { return std::move(added_); }

    /// Messages of the phases, and of all rods.
    void make_messages(const Lender<Real>& lender, std::span<ColourContacts<Real>> colours, BorderMessages& all) const {
        const Ranks& ranks = domain_.ranks();
        const std::size_t colour_count = colours.size(), count = requests_.size();
        std::vector<std::vector<Request>> wanted(count);
        std::vector<BorderLists> received(colour_count + 1, BorderLists(count));
        const auto want = [&](const Foreign& rod, std::size_t list) {
            const auto rank = static_cast<std::size_t>(rod.name.rank);
            wanted[rank].push_back({rod.name, static_cast<std::uint32_t>(list), 0});
            received[list][rank].push_back(rod.local);
        };
        for (const Foreign& rod : rods_) {
            for (std::uint64_t left = rod.phases; left != 0; left &= left - 1)
                want(rod, colours_per_phase_ * static_cast<std::size_t>(std::countr_zero(left)));
            want(rod, colour_count);
        }
        std::vector<BorderLists> sent(colour_count + 1, BorderLists(count));
        const auto asked = ranks.deal(wanted);
        for (std::size_t rank = 0; rank < count; ++rank)
            for (const Request& request : asked[rank])
                sent[request.first][rank].push_back(lender.local_of(request.rod));
        for (std::size_t c = 0; c <= colour_count; ++c)
            (c < colour_count ? colours[c].messages : all) =
                BorderMessages(ranks, sent[c], received[c], sizeof(SpatialVector<Real>));
    }

private:
    template <class Item>
    static void append(const Loan<Item>& loan, ContactGroup<Item>& group) {
        const bool has_other_rod = loan.item.i != no_local_index;
        group.items.push_back(loan.item);
        group.last.push_back(loan.last);
        group.visits.push_back({has_other_rod ? loan.item.i : loan.item.j, loan.item.j, loan.solved});
        group.all_active += loan.is_active ? 1 : 0;
    }
    template <class Item>
    static void note_blocks(ContactGroup<Item>& group) {
        std::size_t left = group.all_active;
        for (std::size_t begin = 0; begin < group.items.size(); begin += group.block_size) {
            const std::size_t here = std::min(left, group.block_size);
            group.active.push_back(static_cast<std::uint8_t>(here));
            left -= here;
        }
    }

    /// Another rank's rod.
    struct Foreign {
        RodName name;
        std::uint32_t local;
        std::uint64_t phases = 0;               ///< a bit for each in which its velocity is needed
        std::uint64_t colours = 0;              ///< a bit for each of which a pair with it as j has been taken
        std::vector<std::uint32_t> asked = {};  ///< (phases) the first colour that has not been asked for
    };

    const Domain& domain_;
    std::size_t colours_per_phase_;
    std::uint32_t next_local_;
    std::vector<std::vector<Request>> requests_;  ///< to each rank
    std::vector<Foreign> rods_;
    std::unordered_map<std::uint64_t, std::size_t> numbers_;  ///< of rods_, by id
    std::vector<MobileRod> added_;
    Loans<Real> taken_;
};

}  // namespace

template <class Real>
Borrowed borrow_contacts(const Domain& domain, const DelassusOperator& matrix, std::span<ColourContacts<Real>> colours,
                         std::size_t colours_per_phase) {
    const Ranks& ranks = domain.ranks();
    for (ColourContacts<Real>& colour : colours) colour.borrowed = {};
    const Lender<Real> lender(domain, matrix, colours);
    Borrower<Real> borrower(domain, matrix.rods().size(), colours_per_phase);
    for (std::size_t c = 0; c < colours.size(); ++c)
        for (const ContactPair& pair : colours[c].between)
            for (const std::uint32_t local : {pair.i, pair.j})
                if (!lender.is_own(local))
                    borrower.need(lender.name(pair.first, local), static_cast<std::uint32_t>(c), {}, local);
    while (ranks.any(borrower.has_requests())) {
        const auto asked = ranks.deal(borrower.take_requests());
        std::vector<std::vector<Loan<ScalarBlock<Real>>>> singles(asked.size());
        std::vector<std::vector<Loan<CoupledBlock>>> pairs(asked.size());
        for (std::size_t rank = 0; rank < asked.size(); ++rank) {
            Loans<Real> loans;
            for (const Request& request : asked[rank]) lender.answer(request, loans);
            singles[rank] = std::move(loans.singles);
            pairs[rank] = std::move(loans.pairs);
        }
        for (auto& of_rank : ranks.deal(singles)) borrower.take(of_rank);
        for (auto& of_rank : ranks.deal(pairs)) borrower.take(of_rank);
    }
    borrower.fill(colours);
    Borrowed borrowed;
    borrower.make_messages(lender, colours, borrowed.all_messages);
    borrowed.rods = borrower.take_added();
    return borrowed;
}

template Borrowed borrow_contacts(const Domain&, const DelassusOperator&, std::span<ColourContacts<float>>,
                                  std::size_t);
template Borrowed borrow_contacts(const Domain&, const DelassusOperator&, std::span<ColourContacts<double>>,
                                  std::size_t);

}  // namespace jostle
