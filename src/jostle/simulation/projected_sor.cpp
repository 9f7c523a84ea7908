#include "jostle/simulation/projected_sor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "jostle/math/vectorised.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/pair_problem.hpp"

namespace jostle {

namespace {

constexpr std::size_t most_colours = 64;

/// Over-relaxation: measured best between 1.3 and 1.4 for hard contacts of dilute and isotropic rods, between 1.0
/// and 1.1 for compliant ones, whose matrix is better conditioned; harder problems want more, and so do those that
/// begin warm, with what is left to the slowest modes of a crowd.
double relaxation(std::uint64_t sweep, bool compliant, bool warm) {
    return sweep >= 60 || warm ? 1.6 : compliant ? 1.1 : 1.35;
}

/// Every `full_sweep_every`-th sweep, and the one after a verification, passes over all contacts.
constexpr std::uint64_t full_sweep_every = 5;
/// Sweeps in float are right to about 1e-6 of the deepest overlap, and finer tolerances are left to double.
constexpr double finest_in_float = 1e-5;
/// Double takes over where so many verifications have found more residual than the sweeps in float had left to do.
constexpr int patience_with_float = 3;
/// After this sweep, and three times as many, and so on, missed contacts are looked for before the sweeps have settled.
constexpr std::uint64_t early_search = 6;
/// A contact without force takes part in the other sweeps if its gap would open by less than this many tolerances.
constexpr double drowsy = 100.0;

/// Centre and turning of a rod's velocity, or force and lever on it, side by side: as wide as a vector register.
template <class Real>
struct alignas(8 * sizeof(Real)) Wide {
    std::array<Real, 8> value{};  // 0-2 centre, 3-5 turning, the rest 0

    Wide() = default;
    Wide(const Vec3& a, const Vec3& b)
        : value{static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z),
                static_cast<Real>(b.x), static_cast<Real>(b.y), static_cast<Real>(b.z)} {}
    Vec3 first() const { return {value[0], value[1], value[2]}; }
    Vec3 second() const { return {value[3], value[4], value[5]}; }

    template <class Other>
    void add(Other factor, const Wide<Other>& other) {
        for (std::size_t k = 0; k < 8; ++k) value[k] += static_cast<Real>(factor * other.value[k]);
    }
};

template <class Real, class Other>
Real sum_of_products(const Wide<Real>& a, const Wide<Other>& b, const Wide<Real>& c, const Wide<Other>& d) {
    std::array<Real, 8> t;
    for (std::size_t k = 0; k < 8; ++k)
        t[k] = a.value[k] * static_cast<Real>(b.value[k]) + c.value[k] * static_cast<Real>(d.value[k]);
    return ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
}

/// One contact as a sweep needs it: its column of D, and of M D, for each of its two rods.
template <class Real>
struct Point {
    Wide<Real> column_i, column_j, answer_i, answer_j;
    Real b = 0, gamma = 0;
    Real compliance = 0;         ///< by which a force gives way, a part of A_ll
    Real diagonal = 0;           ///< A_ll
    Real inverse_diagonal = 0;   ///< 0 where no force can open the gap
    std::uint32_t i = 0, j = 0;  ///< places
    std::uint32_t contact = 0;   ///< number of the contact

    template <class Velocity>
    Real gap_velocity(const Wide<Velocity>* velocities) const {
        return b + compliance * gamma + sum_of_products(column_i, velocities[i], column_j, velocities[j]);
    }
    template <class Velocity>
    void push(Real change, Wide<Velocity>* velocities) {
        gamma += change;
        velocities[i].add(change, answer_i);
        velocities[j].add(change, answer_j);
    }
};

/// A pair that touches at two or three points, and their part of A.
struct PairContacts : PairMatrix {
    std::array<Point<double>, most_points> point;
};

/// The largest factor up to omega that keeps all forces of the pair >= 0. Clipping them one by one instead could raise
/// the energy where they are nearly dependent, and the sweeps would not end.
double feasible_relaxation(const PairContacts& pair, const Points& target, double omega) {
    double factor = omega;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        const double force = pair.point[a].gamma;
        if (target[a] < force) factor = std::min(factor, force / (force - target[a]));
    }
    return factor;
}

/// The points of a single contact, of which most pairs have no more, or of a pair.
template <class Real>
std::span<Point<Real>> points_of(Point<Real>& single) {
    return {&single, 1};
}
std::span<Point<double>> points_of(PairContacts& pair) {
    return {pair.point.data(), pair.count};
}

/// Each solves its own contact problem with all other forces as they are, over-relaxed; they return the change of the
/// gap velocities by their own forces.
template <class Real>
double solve(Point<Real>& point, double omega, Wide<Real>* velocities) {
    // Without a jump: which contacts push changes from sweep to sweep, and processors guess it badly.
    const Real relaxed =
        point.gamma - static_cast<Real>(omega) * point.gap_velocity(velocities) * point.inverse_diagonal;
    const Real change = std::max(relaxed, Real{0}) - point.gamma;
    point.push(change, velocities);
    return std::fabs(change) * point.diagonal;
}

template <class Real>
double solve(PairContacts& pair, double omega, Wide<Real>* velocities) {
    Points velocity{}, target{};
    bool idle = true;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        velocity[a] = pair.point[a].gap_velocity(velocities);
        target[a] = pair.point[a].gamma;
        idle = idle && target[a] == 0.0 && velocity[a] >= 0.0;
    }
    if (idle) return 0.0;
    solve_own_problem(pair, velocity, target);
    const double factor = feasible_relaxation(pair, target, omega);
    double largest = 0.0;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        const double gamma = pair.point[a].gamma;
        const double change = std::max(gamma + factor * (target[a] - gamma), 0.0) - gamma;
        if (change == 0.0) continue;
        pair.point[a].push(change, velocities);
        largest = std::max(largest, std::fabs(change) * pair.matrix[a][a]);
    }
    return largest;
}

template <class Item, class Real>
double solve_all(std::span<Item> items, double omega, Wide<Real>* velocities) {
    double largest = 0.0;
    for (Item& item : items) largest = std::max(largest, solve(item, omega, velocities));
    return largest;
}
// One for each, as only plain functions can be compiled for several processors.
JOSTLE_VECTORISED double solve_items(std::span<Point<float>> points, double omega, Wide<float>* velocities) {
    return solve_all(points, omega, velocities);
}
JOSTLE_VECTORISED double solve_items(std::span<Point<double>> points, double omega, Wide<double>* velocities) {
    return solve_all(points, omega, velocities);
}
JOSTLE_VECTORISED double solve_items(std::span<PairContacts> pairs, double omega, Wide<float>* velocities) {
    return solve_all(pairs, omega, velocities);
}
JOSTLE_VECTORISED double solve_items(std::span<PairContacts> pairs, double omega, Wide<double>* velocities) {
    return solve_all(pairs, omega, velocities);
}

/// Contacts of one kind and colour. Their order does not matter to the result, so those awake come first.
template <class Item>
struct Group {
    std::vector<Item> items;
    std::size_t awake = 0;

    std::span<Item> all() { return items; }
    std::span<Item> awake_ones() { return std::span(items).first(awake); }
};

/// Pairs of which no two share a rod: they can be solved in any order, by any threads.
template <class Real>
struct Colour {
    Group<Point<Real>> singles;
    Group<PairContacts> pairs;
};

/// The force and lever of a unit gamma on each of the rods of a contact.
struct Column {
    ContactForce i, j;
};

Column column_of(const ContactMatrix& contact_matrix, std::uint32_t l) {
    const Contact& contact = contact_matrix.contacts().contact[l];
    const auto side = [&](double sign, double arm) {
        return ContactForce{sign * contact.normal, (sign * arm) * contact.normal};
    };
    const ContactForce i = side(-1.0, contact.arm_i), j = side(1.0, contact.arm_j);
    if (contact.i != contact.j) return {i, j};
    return {{i.force + j.force, i.lever + j.lever}, {}};  // own image: one rod feels both
}

/// Keeps the velocities of the rods while contacts are solved one after the other. Real is what velocities and single
/// contacts are stored in; pairs, whose matrices may be nearly singular, are in double.
template <class Real>
class Sweeper {
public:
    /// Starts from `start`, as many numbers as there are contacts; contacts that come later start from what is then
    /// there.
    Sweeper(const ContactProblem& problem, double tolerance, const std::vector<double>& start)
        : matrix_(problem.matrix),
          b_(problem.constant),
          start_(start),
          drowsy_velocity_(drowsy * tolerance / problem.time_step) {
        extend();
    }

    /// Takes in the contacts that the problem has grown by; awake are those whose gap closes without forces.
    void extend() {
        velocities_.resize(matrix_.rods().size());
        colour_pairs();
        fill();
    }

    /// One pass over all pairs, or over those awake; returns the largest change of a gap velocity by a contact's own
    /// force.
    double sweep(double omega, bool all) {
        double largest = 0.0;
        const auto pass = [&](auto& group) {
            const auto items = all ? group.all() : group.awake_ones();
            largest = std::max(largest, parallel_max_of_blocks(items.size(), [&](std::size_t begin, std::size_t end) {
                                   return solve_items(items.subspan(begin, end - begin), omega, velocities_.data());
                               }));
        };
        for (Colour<Real>& colour : colours_) {
            pass(colour.singles);
            pass(colour.pairs);
        }
        if (all) {
            for (Colour<Real>& colour : colours_) {
                find_awake(colour.singles);
                find_awake(colour.pairs);
            }
        }
        return largest;
    }

    /// The velocities of the rods as the sweeps have left them.
    void read_velocities(std::span<ContactVelocity> velocities) const {
        parallel_for(velocities.size(), [&](std::size_t place) {
            velocities[place] = {velocities_[place].first(), velocities_[place].second()};
        });
    }

    /// Fills `solution` from gamma alone, in double, so that no rounding of the sweeps is left in it.
    void refresh(ContactSolution& solution) {
        parallel_for(solution.forces.size(), [&](std::size_t place) { solution.forces[place] = {}; });
        for_all_points([&](const auto& point) {
            solution.gamma[point.contact] = point.gamma;
            if (point.gamma == 0) return;
            const Column column = column_of(matrix_.contact_matrix(), point.contact);
            const double gamma = point.gamma;
            solution.forces[point.i].force += gamma * column.i.force;
            solution.forces[point.i].lever += gamma * column.i.lever;
            solution.forces[point.j].force += gamma * column.j.force;
            solution.forces[point.j].lever += gamma * column.j.lever;
        });
        parallel_for(solution.forces.size(), [&](std::size_t place) {
            const ContactForce& force = solution.forces[place];
            ContactVelocity& velocity = solution.velocities[place];
            velocity = velocity_of(matrix_.rods()[place], force.force, force.lever);
            velocities_[place] = {velocity.centre, velocity.turning};
        });
    }

private:
    /// Greedily, in the order of the contacts: a pair gets the first colour that neither of its rods has yet.
    void colour_pairs() {
        const auto ends = matrix_.contact_matrix().ends();
        const Contacts& contacts = matrix_.contact_matrix().contacts();
        taken_.resize(matrix_.rods().size(), 0);
        for (FirstContacts& new_ones : new_contacts_) new_ones = {};
        for (auto l = static_cast<std::uint32_t>(coloured_); l < ends.size();) {
            const auto [i, j] = ends[l];
            std::uint32_t next = l + 1;
            while (next < ends.size() && next < l + most_points && ends[next].i == i && ends[next].j == j &&
                   contacts.image[next] == contacts.image[l])
                ++next;
            auto colour = static_cast<std::size_t>(std::countr_one(taken_[i] | taken_[j]));
            if (colour < most_colours) {
                taken_[i] |= std::uint64_t{1} << colour;
                taken_[j] |= std::uint64_t{1} << colour;
            } else {  // a rod with very many neighbours: pairs that stand alone
                colour = std::max(new_contacts_.size(), most_colours);
            }
            if (new_contacts_.size() <= colour) new_contacts_.resize(colour + 1);
            auto& [singles, pairs] = new_contacts_[colour];
            if (next == l + 1)
                singles.push_back(l);
            else
                pairs.push_back({l, next - l});
            l = next;
        }
        coloured_ = ends.size();
        colours_.resize(new_contacts_.size());
    }

    void fill() {
        for (std::size_t k = 0; k < colours_.size(); ++k) {
            auto& [first_of_single, first_of_pair] = new_contacts_[k];
            auto& [singles, pairs] = colours_[k];
            append(
                singles, first_of_single, [&](std::uint32_t l) { return b_[l] < 0.0 || start_[l] > 0.0; },
                [&](Point<Real>& point, std::uint32_t l) { point = point_of<Real>(l); });
            append(
                pairs, first_of_pair, [](const auto&) { return true; },
                [&](PairContacts& pair, const auto& first_and_count) {
                    const auto [first, count] = first_and_count;
                    pair.count = count;
                    for (std::uint32_t a = 0; a < count; ++a) pair.point[a] = point_of<double>(first + a);
                    for (std::uint32_t a = 0; a < count; ++a) {
                        for (std::uint32_t c = 0; c < count; ++c)
                            pair.matrix[a][c] = sum_of_products(pair.point[a].column_i, pair.point[c].answer_i,
                                                                pair.point[a].column_j, pair.point[c].answer_j);
                        pair.matrix[a][a] += pair.point[a].compliance;
                    }
                });
        }
    }

    /// Appends items for `sources`, those awake before the others if the group was empty.
    template <class Item, class Source, class IsAwake, class Fill>
    static void append(Group<Item>& group, std::vector<Source>& sources, IsAwake&& is_awake, Fill&& fill_item) {
        const auto asleep = std::partition(sources.begin(), sources.end(), is_awake);
        const std::size_t before = group.items.size();
        const auto awake = static_cast<std::size_t>(asleep - sources.begin());
        group.items.resize(before + sources.size());
        parallel_for(sources.size(), [&](std::size_t n) { fill_item(group.items[before + n], sources[n]); });
        for (std::size_t n = 0; n < awake; ++n, ++group.awake)
            if (group.awake != before + n) std::swap(group.items[group.awake], group.items[before + n]);
    }

    template <class PointReal>
    Point<PointReal> point_of(std::uint32_t l) const {
        const auto [i, j] = matrix_.contact_matrix().ends()[l];
        const Column column = column_of(matrix_.contact_matrix(), l);
        const auto answer = [&](std::uint32_t place, const ContactForce& force) {
            const ContactVelocity velocity = velocity_of(matrix_.rods()[place], force.force, force.lever);
            return Wide<PointReal>{velocity.centre, velocity.turning};
        };
        const double diagonal = matrix_.diagonal()[l];
        Point<PointReal> point;
        point.column_i = {column.i.force, column.i.lever};
        point.column_j = {column.j.force, column.j.lever};
        point.answer_i = answer(i, column.i);
        point.answer_j = answer(j, column.j);
        point.b = static_cast<PointReal>(b_[l]);
        point.gamma = static_cast<PointReal>(start_[l]);
        point.compliance = static_cast<PointReal>(matrix_.compliance(l));
        point.diagonal = static_cast<PointReal>(diagonal);
        point.inverse_diagonal = static_cast<PointReal>(diagonal > 0.0 ? 1.0 / diagonal : 0.0);
        point.i = i;
        point.j = j;
        point.contact = l;
        return point;
    }

    /// Brings the items that push, or may soon, to the front.
    template <class Item>
    void find_awake(Group<Item>& group) {
        std::vector<std::uint8_t> awake(group.items.size());
        parallel_for(awake.size(), [&](std::size_t k) {
            for (const auto& point : points_of(group.items[k]))
                if (point.gamma > 0 || point.gap_velocity(velocities_.data()) < drowsy_velocity_) awake[k] = 1;
        });
        std::size_t front = 0;
        for (std::size_t back = awake.size();;) {
            while (front < back && awake[front] == 1) ++front;
            while (front < back && awake[back - 1] == 0) --back;
            if (front == back) break;
            std::swap(group.items[front++], group.items[--back]);
        }
        group.awake = front;
    }

    /// Calls body(point) for all points; those of a colour in parallel.
    template <class Body>
    void for_all_points(Body&& body) {
        const auto pass = [&](auto items) {
            parallel_for(items.size(), [&](std::size_t k) {
                for (const auto& point : points_of(items[k])) body(point);
            });
        };
        for (Colour<Real>& colour : colours_) {
            pass(colour.singles.all());
            pass(colour.pairs.all());
        }
    }

    struct FirstContacts {
        std::vector<std::uint32_t> singles;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< first, count
    };

    const DelassusOperator& matrix_;
    const std::vector<double>& b_;
    const std::vector<double>& start_;
    double drowsy_velocity_;
    std::vector<Wide<Real>> velocities_;       ///< (places) V = M D gamma, kept up to date
    std::vector<std::uint64_t> taken_;         ///< (places) a bit for each colour that a rod has
    std::size_t coloured_ = 0;                 ///< contacts taken in
    std::vector<FirstContacts> new_contacts_;  ///< of the pairs of each colour, while they are taken in
    std::vector<Colour<Real>> colours_;
};

/// The sweeps of a solution, with what is stored in Real. Ends when solved, at the limit of sweeps, or, if
/// `most_verifications` is above 0, when so many have found the residual too large although the sweeps stood still.
template <class Real>
class Solver {
public:
    Solver(const ContactProblem& problem, const LcpSettings& settings, ContactSolution& solution)
        : problem_(problem),
          settings_(settings),
          solution_(solution),
          sweeper_(problem, settings.tolerance, solution.gamma) {
        sweeper_.refresh(solution_);
    }

    /// Whether nothing is left to be done: solved, and no contact missed; or lost.
    bool solve(SolverOutcome& outcome, int most_verifications) {
        bool look_at_all = false;
        std::uint64_t next_verification = 0;
        for (int verifications = 0; outcome.iterations < settings_.max_iterations;) {
            const bool all = look_at_all || outcome.iterations % full_sweep_every == full_sweep_every - 1;
            const double omega = relaxation(outcome.iterations, problem_.matrix.compliant(), !problem_.start.empty());
            const double change = problem_.time_step * sweeper_.sweep(omega, all);
            ++outcome.iterations;
            look_at_all = false;
            if (outcome.iterations >= next_search_) {
                next_search_ = 3 * outcome.iterations;
                sweeper_.read_velocities(solution_.velocities);
                if (add_missed(false)) continue;
            }
            // The residual is near the last change; it is computed where that is small, and now and then for the
            // paper's norm.
            const bool small = settings_.residual == LcpResidual::length ? !(change > settings_.tolerance)
                                                                         : outcome.iterations >= next_verification;
            if (!small && outcome.iterations < settings_.max_iterations) continue;
            if (verified(outcome)) return true;
            if (++verifications == most_verifications) return false;
            look_at_all = true;
            next_verification = outcome.iterations + 5;
        }
        return false;
    }

    /// The same for the solution as it is, without a sweep.
    bool verified(SolverOutcome& outcome) {
        verify(outcome);
        if (outcome.status == LcpStatus::not_finite) return true;
        if (outcome.status != LcpStatus::converged) return false;
        ++outcome.solves;
        return !add_missed(true);
    }

    /// Residual and status, over all contacts, from gamma alone.
    void verify(SolverOutcome& outcome) {
        sweeper_.refresh(solution_);
        LcpResult result;
        result.velocity.resize(problem_.matrix.size());
        problem_.matrix.rates(solution_.velocities, solution_.gamma, result.velocity);
        parallel_for(result.velocity.size(), [&](std::size_t l) { result.velocity[l] += problem_.constant[l]; });
        result.solution.swap(solution_.gamma);
        result.residual = lcp_residual(problem_.lcp(), settings_.residual, result.solution, result.velocity);
        outcome.status = lcp_status(problem_.lcp(), settings_, result);
        outcome.residual = result.residual;
        result.solution.swap(solution_.gamma);
    }

private:
    bool add_missed(bool final) {
        if (!problem_.add_missed || !problem_.add_missed(solution_, final)) return false;
        solution_.resize(problem_.matrix.contact_matrix());
        sweeper_.extend();
        return true;
    }

    const ContactProblem& problem_;
    const LcpSettings& settings_;
    ContactSolution& solution_;
    Sweeper<Real> sweeper_;
    std::uint64_t next_search_ = early_search;
};

}  // namespace

SolverOutcome solve_projected_sor(const ContactProblem& problem, const LcpSettings& settings,
                                  ContactSolution& solution) {
    SolverOutcome outcome;
    solution.resize(problem.matrix.contact_matrix());
    const auto& b = problem.constant;
    const double deepest = parallel_max(b.size(), 0.0, [&](std::size_t l) { return -b[l]; });
    const bool in_float = settings.residual == LcpResidual::length && std::isfinite(deepest) &&
                          settings.tolerance > finest_in_float * problem.time_step * deepest;
    if (in_float) {
        Solver<float> solver(problem, settings, solution);
        if (deepest == 0.0 && solver.verified(outcome)) return outcome;
        if (solver.solve(outcome, patience_with_float)) return outcome;
    }
    Solver<double> solver(problem, settings, solution);
    if (!solver.verified(outcome) && !solver.solve(outcome, 0)) solver.verify(outcome);
    return outcome;
}

}  // namespace jostle
