#include "jostle/contact_problem/block_gauss_seidel.hpp"

#include <algorithm>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// A contact without force takes part in the sweeps over those active if its gap would open by less than this many
/// tolerances.
constexpr double activation_tolerances = 100.0;
/// A gap velocity that changes by less than this part of the tolerance is the same to the contacts around.
constexpr double still_part = 0.1;

/// Whether a new contact takes part from the first sweep on: pairs that touch at several points always do.
template <class Real>
bool active_at_first(const ScalarBlock<Real>& contact) {
    return contact.b < 0 || contact.gamma > 0;
}
bool active_at_first(const CoupledBlock&) {
    return true;
}

}  // namespace

template <class Real>
BlockGaussSeidel<Real>::BlockGaussSeidel(const ContactProblem& problem, double tolerance,
                                         const std::vector<double>& start, std::size_t colours_per_exchange)
    : problem_(problem),
      matrix_(problem.matrix()),
      b_(problem.constant()),
      start_(start),
      colours_per_exchange_(colours_per_exchange),
      pair_colours_(problem.matrix().box().plane) {
    set_tolerance(tolerance);
    extend();
}

template <class Real>
void BlockGaussSeidel<Real>::set_tolerance(double tolerance) {
    activation_threshold_ = activation_tolerances * tolerance / problem_.time_step();
    still_ = still_part * tolerance / problem_.time_step();
}

template <class Real>
void BlockGaussSeidel<Real>::extend() {
    for (auto* velocities : {&velocities_, &former_velocities_})
        velocities->resize(local_count_);  // without those of other ranks' rods, whose contacts are borrowed
    local_count_ = matrix_.rods().size();
    velocities_.resize(local_count_);
    const Domain& domain = problem_.domain();
    const auto& new_pairs = pair_colours_.extend(matrix_.contact_matrix(), domain);
    colours_.resize(new_pairs.size());
    for (std::size_t k = 0; k < colours_.size(); ++k) {
        std::span<const ContactPair> others = new_pairs[k];
        std::vector<ContactPair> beside_plane;
        if (matrix_.box().plane) others = beside_plane = append_at_plane(colours_[k], others);
        if (domain.is_shared())
            append_between_ranks(colours_[k], others);
        else
            append(colours_[k].inner, others);
    }
    plan_messages();
}

/// Ranks exchange velocities as often as is wanted, and once a colour where contacts push a plane: these are never
/// borrowed.
template <class Real>
void BlockGaussSeidel<Real>::plan_messages() {
    const Domain& domain = problem_.domain();
    if (!domain.is_shared()) return;
    if (borrows_contacts()) {
        Borrowed borrowed = borrow_contacts(domain, matrix_, std::span(colours_), colours_per_exchange_);
        all_messages_ = std::move(borrowed.all_messages);
        borrowed_rods_.assign(matrix_.rods().begin(), matrix_.rods().end());
        borrowed_rods_.insert(borrowed_rods_.end(), borrowed.rods.begin(), borrowed.rods.end());
        velocities_.resize(borrowed_rods_.size());
        return;
    }
    std::vector<ContactPair> between;
    for (Colour& colour : colours_) {
        colour.messages = BorderMessages(domain, matrix_.contact_matrix(), colour.between, sizeof velocities_.front());
        between.insert(between.end(), colour.between.begin(), colour.between.end());
    }
    all_messages_ = BorderMessages(domain, matrix_.contact_matrix(), between, sizeof velocities_.front());
}

/// The local rods, and those behind them whose contacts are borrowed.
template <class Real>
LocalRods<Real> BlockGaussSeidel<Real>::local_rods() {
    return {borrowed_rods_.empty() ? matrix_.rods().data() : borrowed_rods_.data(), velocities_.data()};
}

template <class Real>
void BlockGaussSeidel<Real>::begin_again(double tolerance) {
    set_tolerance(tolerance);
    parallel_for(velocities_.size(), [&](std::size_t local) { velocities_[local] = {}; });
    former_velocities_.clear();
    plane_velocity_ = 0.0;
    const auto begin = [this](auto& group) {
        parallel_for(group.items.size(), [&](std::size_t k) {
            this->begin_again(group.items[k]);
            group.visits[k].solved = 0.0F;
        });
        group.last.clear();
        group.sort_out(0, [](const auto& item) { return active_at_first(item); });
    };
    for (Colour& colour : colours_) {
        colour.for_own(begin);
        colour.at_plane.for_each([this](ScalarBlock<Real>& contact) { begin_again(contact); });
    }
    if (borrows_contacts()) plan_messages();
}

template <class Real>
void BlockGaussSeidel<Real>::begin_again(ScalarBlock<Real>& contact) const {
    contact.b = static_cast<Real>(b_[contact.number]);
    contact.gamma = 0;
}

template <class Real>
void BlockGaussSeidel<Real>::begin_again(CoupledBlock& pair) const {
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        pair.points[a].b = b_[pair.first + a];
        pair.points[a].gamma = 0.0;
    }
}

template <class Real>
void BlockGaussSeidel<Real>::append(ContactKinds<Real>& contacts, std::span<const ContactPair> new_pairs) {
    std::vector<ContactPair> singles, others;
    for (const ContactPair& pair : new_pairs) (pair.count == 1 ? singles : others).push_back(pair);
    append(contacts.singles, singles, [this](const ContactPair& pair) { return contact_of(pair); });
    append(contacts.pairs, others, [this](const ContactPair& pair) { return pair_of(pair); });
}

/// Takes those with the plane that contacts push, and returns the others.
template <class Real>
std::vector<ContactPair> BlockGaussSeidel<Real>::append_at_plane(Colour& colour,
                                                                 std::span<const ContactPair> new_pairs) {
    std::vector<ContactPair> others;
    for (const ContactPair& pair : new_pairs)
        if (matrix_.contact_matrix().contacts().contact[pair.first].i == matrix_.box().plane)
            colour.at_plane.push_back(contact_of(pair));
        else
            others.push_back(pair);
    colour.at_plane.tell_ranks(problem_.domain().ranks());
    return others;
}

template <class Real>
void BlockGaussSeidel<Real>::append_between_ranks(Colour& colour, std::span<const ContactPair> new_pairs) {
    std::vector<ContactPair> inner, border, elsewhere;
    for (const ContactPair& pair : new_pairs) {
        if (!is_between_ranks(pair, matrix_.contact_matrix(), problem_.domain())) {
            inner.push_back(pair);
            continue;
        }
        (problem_.is_elsewhere()[pair.first] == 0 ? border : elsewhere).push_back(pair);
        colour.between.push_back(pair);
    }
    append(colour.inner, inner);
    append(colour.border, border);
    append(colour.elsewhere, elsewhere);
}

/// Calls body(group) for the contacts of a colour; for this rank's own rods while velocities of other ranks' rods
/// travel.
template <class Real>
template <class Body>
void BlockGaussSeidel<Real>::for_contacts(Colour& colour, Body&& body) {
    colour.messages.begin(std::span<const SpatialVector<Real>>(velocities_));
    colour.inner.for_groups(body);
    colour.messages.end(std::span(velocities_));
    colour.border.for_groups(body);
    colour.elsewhere.for_groups(body);
    colour.borrowed.for_groups(body);
}

template <class Real>
double BlockGaussSeidel<Real>::sweep(double omega, SweepOver over) {
    const bool all = over == SweepOver::all;
    if (std::exchange(all_are_stirred_, false)) note_stirred_rods();
    const Relaxation by{omega, static_cast<float>(++sweeps_), still_};
    double largest = 0.0;
    const auto pass = [&](auto& group) {
        const std::size_t items = all ? group.items.size() : group.all_active;
        largest =
            std::max(largest, parallel_max_of_blocks(group.active.size(), items, [&](std::size_t number) {
                         const auto block = group.block(number);
                         const std::size_t count = all ? block.size() : group.active[number];
                         return sweep_over(block.first(count), group.block_of(group.visits, number), by, local_rods());
                     }));
    };
    for (Colour& colour : colours_) {
        for_contacts(colour, pass);
        largest = std::max(largest, sweep_at_plane(colour, by));
    }
    if (all) {
        all_messages_.bring(std::span(velocities_));
        for (Colour& colour : colours_) colour.for_all([this](auto& group) { this->find_active(group); });
    }
    return problem_.domain().ranks().largest(largest);
}

/// Not over-relaxed: where one of many forces ends, a common factor would be 1.
template <class Real>
double BlockGaussSeidel<Real>::sweep_at_plane(Colour& colour, const Relaxation& by) {
    return colour.at_plane.sweep(plane_velocity_, matrix_.box().mobility, by, local_rods(), problem_.domain().ranks());
}

template <class Real>
void BlockGaussSeidel<Real>::note_stirred_rods() {
    parallel_for(velocities_.size(), [&](std::size_t local) { velocities_[local].stir(static_cast<Real>(sweeps_)); });
}

template <class Real>
double BlockGaussSeidel<Real>::sweep_on(double beta) {
    carry_on_velocities(beta);
    stir_all();
    double largest = 0.0;
    const auto pass = [&](auto& group) {
        group.last.resize(group.items.size());
        const auto sweep_block = [&](std::size_t number) {
            return jostle::sweep_on(group.block(number), group.block_of(group.last, number), beta, local_rods());
        };
        largest = std::max(largest, parallel_max_of_blocks(group.active.size(), group.items.size(), sweep_block));
    };
    for (Colour& colour : colours_) for_contacts(colour, pass);
    return problem_.domain().ranks().largest(largest);
}

/// V is linear in the forces: what the last change of all of them did to it is done again, `beta` times.
template <class Real>
void BlockGaussSeidel<Real>::carry_on_velocities(double beta) {
    former_velocities_.resize(velocities_.size());
    parallel_for(velocities_.size(), [&](std::size_t local) {
        const auto now = velocities_[local].lanes;
        velocities_[local].lanes += static_cast<Real>(beta) * (now - former_velocities_[local].lanes);
        former_velocities_[local].lanes = now;
    });
}

template <class Real>
double BlockGaussSeidel<Real>::violation() {
    all_messages_.bring(std::span(velocities_));
    double largest = 0.0;
    for (Colour& colour : colours_)
        colour.for_own([&](auto& group) {
            largest = std::max(largest, parallel_max(group.items.size(), 0.0, [&](std::size_t k) {
                                   return jostle::violation(group.items[k], velocities_.data());
                               }));
        });
    return problem_.domain().ranks().largest(largest);
}

template <class Real>
void BlockGaussSeidel<Real>::read_velocities(ContactSolution& solution) const {
    std::vector<ContactVelocity>& velocities = solution.velocities;
    parallel_for(velocities.size(), [&](std::size_t local) { velocities[local] = velocities_[local].velocity(); });
    problem_.fetch_velocities(velocities);
    solution.box_rate = plane_velocity_;
}

template <class Real>
void BlockGaussSeidel<Real>::refresh(ContactSolution& solution) {
    parallel_for(solution.forces.size(), [&](std::size_t local) { solution.forces[local] = {}; });
    const ContactMatrix& contact_matrix = matrix_.contact_matrix();
    for_all_forces([&](std::uint32_t l, double gamma) {
        solution.gamma[l] = gamma;
        if (gamma != 0.0) contact_matrix.add_force(l, gamma, solution.forces);
    });
    parallel_for(solution.forces.size(), [&](std::size_t local) {
        const ContactForce& force = solution.forces[local];
        ContactVelocity& velocity = solution.velocities[local];
        velocity = velocity_of(matrix_.rods()[local], force.force, force.moment);
        SpatialVector<Real> exact(velocity);
        exact.stir(velocities_[local].stirred());
        if (local < former_velocities_.size())
            former_velocities_[local].lanes += exact.lanes - velocities_[local].lanes;
        velocities_[local] = exact;
    });
    solution.box_rate = plane_velocity_ = problem_.box_rate(solution.gamma);
    if (!problem_.domain().is_shared()) return;
    problem_.fetch_velocities(solution.velocities);  // the forces on ghosts are not all known here
    parallel_for(local_count_, [&](std::size_t local) {
        if (problem_.domain().owns(matrix_.contact_matrix().rods()[local])) return;
        SpatialVector<Real> exact(solution.velocities[local]);
        exact.stir(velocities_[local].stirred());
        velocities_[local] = exact;
    });
}

template <class Real>
template <class Item, class MakeItem>
void BlockGaussSeidel<Real>::append(ContactGroup<Item>& group, std::span<const ContactPair> pairs, MakeItem&& item_of) {
    const std::size_t before = group.items.size();
    group.items.resize(before + pairs.size());
    group.visits.resize(group.items.size());
    if (!group.last.empty()) group.last.resize(group.items.size());
    parallel_for(pairs.size(), [&](std::size_t n) {
        group.items[before + n] = item_of(pairs[n]);
        group.visits[before + n] = {pairs[n].i == no_local_index ? pairs[n].j : pairs[n].i, pairs[n].j};
    });
    group.sort_out(before, [](const Item& item) { return active_at_first(item); });
}

template <class Real>
ScalarBlock<Real> BlockGaussSeidel<Real>::contact_of(const ContactPair& pair) const {
    const auto [i, j, l, count] = pair;
    ContactForce on_i, on_j;
    add_contact_force(1.0, matrix_.contact_matrix().contacts().contact[l], on_i, on_j);
    const bool against_fixed_body = i == no_local_index;
    if (against_fixed_body) on_i = {};
    const auto answer = [&](std::uint32_t local, const ContactForce& to) {
        return SpatialVector<Real>(velocity_of(matrix_.rods()[local], to.force, to.moment));
    };
    const double diagonal = matrix_.diagonal()[l];
    ScalarBlock<Real> contact;
    contact.jacobian_i = SpatialVector<Real>(on_i);
    contact.jacobian_j = SpatialVector<Real>(on_j);
    contact.response_i = against_fixed_body ? SpatialVector<Real>{} : answer(i, on_i);
    contact.response_j = answer(j, on_j);
    contact.b = static_cast<Real>(b_[l]);
    contact.gamma = static_cast<Real>(start_[l]);
    contact.compliance = static_cast<Real>(matrix_.compliance(l));
    contact.diagonal = static_cast<Real>(diagonal);
    contact.inverse_diagonal = static_cast<Real>(diagonal > 0.0 ? 1.0 / diagonal : 0.0);
    contact.i = against_fixed_body ? j : i;
    contact.j = j;
    contact.number = l;
    return contact;
}

template <class Real>
CoupledBlock BlockGaussSeidel<Real>::pair_of(const ContactPair& touching) const {
    const auto [i, j, first, count] = touching;
    CoupledBlock pair;
    pair.count = count;
    pair.i = i;
    pair.j = j;
    pair.first = first;
    for (std::uint32_t a = 0; a < count; ++a) {
        const std::uint32_t l = first + a;
        const Contact& contact = matrix_.contact_matrix().contacts().contact[l];
        pair.points[a] = {contact.normal, contact.arm_i, contact.arm_j, b_[l], start_[l], matrix_.compliance(l)};
    }
    for (std::uint32_t c = 0; c < count; ++c) {
        ContactForce on_i, on_j;
        add_contact_force(1.0, pair.points[c], on_i, on_j);
        if (i == j)
            on_i = on_j = {on_i.force + on_j.force, on_i.moment + on_j.moment};  // own image: one rod feels both
        const ContactVelocity of_i =
            i == no_local_index ? ContactVelocity{} : velocity_of(matrix_.rods()[i], on_i.force, on_i.moment);
        const ContactVelocity of_j = velocity_of(matrix_.rods()[j], on_j.force, on_j.moment);
        for (std::uint32_t a = 0; a < count; ++a) pair.matrix[a][c] = gap_rate(pair.points[a], of_i, of_j);
        pair.matrix[c][c] += pair.points[c].compliance;
    }
    return pair;
}

template <class Real>
template <class Item>
void BlockGaussSeidel<Real>::find_active(ContactGroup<Item>& group) {
    group.sort_out(0, [&](const Item& item) { return may_push(item, velocities_.data(), activation_threshold_); });
}

/// Calls body(number, force) for all contacts; those of a colour in parallel.
template <class Real>
template <class Body>
void BlockGaussSeidel<Real>::for_all_forces(Body&& body) {
    const auto pass = [&](auto& group) {
        parallel_for(group.items.size(), [&](std::size_t k) { for_forces(group.items[k], body); });
    };
    for (Colour& colour : colours_) {
        colour.for_own(pass);
        colour.at_plane.for_each([&](ScalarBlock<Real>& contact) { for_forces(contact, body); });
    }
}

template class BlockGaussSeidel<float>;
template class BlockGaussSeidel<double>;

}  // namespace jostle
