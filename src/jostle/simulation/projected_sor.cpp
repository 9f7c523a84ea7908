#include "jostle/simulation/projected_sor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "jostle/math/vectorised.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t most_points = 3;  ///< contacts of one pair (append_contacts)
constexpr std::size_t most_colours = 64;

/// Over-relaxation: measured best between 1.3 and 1.4 for dilute and isotropic rods; harder problems want more.
double relaxation(std::uint64_t sweep) {
    return sweep < 60 ? 1.35 : 1.6;
}

/// All contacts pass through the first sweeps and then every `full_sweep_every`-th.
constexpr std::uint64_t full_sweep_every = 5;
/// After this sweep, missed contacts are looked for the first time.
constexpr std::uint64_t early_search = 4;
/// A contact without force takes part in the other sweeps if its gap would open by less than this many tolerances.
constexpr double drowsy = 100.0;

/// Centre and turning of a rod's velocity, or force and lever on it, side by side: as wide as a vector register.
struct alignas(64) Wide {
    std::array<double, 8> value{};  // 0-2 centre, 3-5 turning, the rest 0

    Wide() = default;
    Wide(const Vec3& a, const Vec3& b) : value{a.x, a.y, a.z, b.x, b.y, b.z} {}
    Vec3 first() const { return {value[0], value[1], value[2]}; }
    Vec3 second() const { return {value[3], value[4], value[5]}; }

    void add(double factor, const Wide& other) {
        for (std::size_t k = 0; k < 8; ++k) value[k] += factor * other.value[k];
    }
};

double sum_of_products(const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
    std::array<double, 8> t;
    for (std::size_t k = 0; k < 8; ++k) t[k] = a.value[k] * b.value[k] + c.value[k] * d.value[k];
    return ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
}

/// One contact as a sweep needs it: its column of D, and of M D, for each of its two rods.
struct Point {
    Wide column_i, column_j, answer_i, answer_j;
    double b = 0.0, gamma = 0.0;
    std::uint32_t i = 0, j = 0;     ///< places
    std::uint32_t contact = 0;      ///< number of the contact
    double diagonal = 0.0;          ///< A_ll
    double inverse_diagonal = 0.0;  ///< 0 where no force can open the gap

    double gap_velocity(const Wide* velocities) const {
        return b + sum_of_products(column_i, velocities[i], column_j, velocities[j]);
    }
    void push(double change, Wide* velocities) {
        gamma += change;
        velocities[i].add(change, answer_i);
        velocities[j].add(change, answer_j);
    }
};

using Points = std::array<double, most_points>;  ///< a number per contact of a pair

/// A pair that touches at two or three points, and their part of A.
struct PairContacts {
    std::uint32_t count;  ///< 2 or 3
    std::array<Point, most_points> point;
    std::array<std::array<double, most_points>, most_points> matrix;
};

/// max |min(A_aa gamma_a, velocity_a)| over the points of a pair.
double violation(const PairContacts& pair, const Points& without, const Points& gamma) {
    double largest = 0.0;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        double velocity = without[a];
        for (std::uint32_t c = 0; c < pair.count; ++c) velocity += pair.matrix[a][c] * gamma[c];
        largest = std::max(largest, std::fabs(std::min(pair.matrix[a][a] * gamma[a], velocity)));
    }
    return largest;
}

/// gamma that makes all three gap velocities vanish (Cramer's rule), or -1 where the three are dependent.
Points all_three_active(const PairContacts& pair, const Points& without) {
    const auto& K = pair.matrix;
    const Vec3 rows[3] = {{K[0][0], K[0][1], K[0][2]}, {K[1][0], K[1][1], K[1][2]}, {K[2][0], K[2][1], K[2][2]}};
    const Vec3 crossed[3] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
    const double determinant = dot(rows[0], crossed[0]);
    if (!(determinant > 1e-12 * K[0][0] * K[1][1] * K[2][2])) return {-1.0, -1.0, -1.0};
    const Vec3 solution =
        (-1.0 / determinant) * (without[0] * crossed[0] + without[1] * crossed[1] + without[2] * crossed[2]);
    return {solution.x, solution.y, solution.z};
}

/// The pair's own contact problem with all other forces as they are: `target` holds gamma on entry and gamma* on
/// return.
///
/// Every set of active points is tried, and the one that violates the conditions least is taken. Nearly singular
/// sets are left out: where three points are dependent, two of them do as well.
void solve_own_problem(const PairContacts& pair, const Points& velocity, Points& target) {
    Points without{};  // gap velocities if this pair had no forces
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        without[a] = velocity[a];
        for (std::uint32_t c = 0; c < pair.count; ++c) without[a] -= pair.matrix[a][c] * target[c];
    }
    Points best{};
    double least = violation(pair, without, best);
    const auto consider = [&](const Points& gamma) {
        const double here = violation(pair, without, gamma);
        if (here < least) {
            least = here;
            best = gamma;
        }
    };
    for (std::uint32_t a = 0; a < pair.count && least > 0.0; ++a) {
        if (!(pair.matrix[a][a] > 0.0)) continue;  // no force can open this gap
        Points gamma{};
        gamma[a] = std::max(-without[a] / pair.matrix[a][a], 0.0);
        consider(gamma);
        for (std::uint32_t c = 0; c < a; ++c) {
            const double determinant = pair.matrix[a][a] * pair.matrix[c][c] - pair.matrix[a][c] * pair.matrix[c][a];
            if (!(determinant > 1e-12 * pair.matrix[a][a] * pair.matrix[c][c])) continue;
            gamma = {};
            gamma[a] = (pair.matrix[a][c] * without[c] - pair.matrix[c][c] * without[a]) / determinant;
            gamma[c] = (pair.matrix[c][a] * without[a] - pair.matrix[a][a] * without[c]) / determinant;
            if (gamma[a] >= 0.0 && gamma[c] >= 0.0) consider(gamma);
        }
    }
    if (pair.count == 3 && least > 0.0) {
        const Points gamma = all_three_active(pair, without);
        if (gamma[0] >= 0.0 && gamma[1] >= 0.0 && gamma[2] >= 0.0) consider(gamma);
    }
    target = best;
}

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
std::span<Point> points_of(Point& single) {
    return {&single, 1};
}
std::span<Point> points_of(PairContacts& pair) {
    return {pair.point.data(), pair.count};
}

/// Each solves its own contact problem with all other forces as they are, over-relaxed; they return the change of the
/// gap velocities by their own forces.
inline double solve(Point& point, double omega, Wide* velocities) {
    // Without a jump: which contacts push changes from sweep to sweep, and processors guess it badly.
    const double relaxed = point.gamma - omega * point.gap_velocity(velocities) * point.inverse_diagonal;
    const double change = std::max(relaxed, 0.0) - point.gamma;
    point.push(change, velocities);
    return std::fabs(change) * point.diagonal;
}

inline double solve(PairContacts& pair, double omega, Wide* velocities) {
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

template <class Item>
double solve_all(std::span<Item> items, double omega, Wide* velocities) {
    double largest = 0.0;
    for (Item& item : items) largest = std::max(largest, solve(item, omega, velocities));
    return largest;
}
// One for each, as only plain functions can be compiled for several processors.
JOSTLE_VECTORISED double solve_points(std::span<Point> points, double omega, Wide* velocities) {
    return solve_all(points, omega, velocities);
}
JOSTLE_VECTORISED double solve_pairs(std::span<PairContacts> pairs, double omega, Wide* velocities) {
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
struct Colour {
    Group<Point> singles;
    Group<PairContacts> pairs;
};

class Sweeper {
public:
    Sweeper(const ContactProblem& problem, double tolerance)
        : matrix_(problem.matrix), b_(problem.constant), drowsy_velocity_(drowsy * tolerance / problem.time_step) {
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
        const auto pass = [&](auto& group, auto solve_items) {
            const auto items = all ? group.all() : group.awake_ones();
            largest = std::max(largest, parallel_max_of_blocks(items.size(), [&](std::size_t begin, std::size_t end) {
                                   return solve_items(items.subspan(begin, end - begin), omega, velocities_.data());
                               }));
        };
        for (Colour& colour : colours_) {
            pass(colour.singles, solve_points);
            pass(colour.pairs, solve_pairs);
        }
        if (all) {
            for (Colour& colour : colours_) {
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

    /// Computes the forces on the rods and their velocities anew from gamma, so that no rounding of the sweeps is left.
    void refresh(std::span<ContactForce> forces, std::span<ContactVelocity> velocities) {
        std::vector<Wide> sums(forces.size());
        for_all_points([&](Point& point) {
            if (point.gamma == 0.0) return;
            sums[point.i].add(point.gamma, point.column_i);
            sums[point.j].add(point.gamma, point.column_j);
        });
        parallel_for(forces.size(), [&](std::size_t place) {
            forces[place] = {sums[place].first(), sums[place].second()};
            velocities[place] = velocity_of(matrix_.rods()[place], forces[place].force, forces[place].lever);
            velocities_[place] = {velocities[place].centre, velocities[place].turning};
        });
    }

    /// gamma and A gamma + b, one a contact.
    void read(std::span<double> gamma, std::span<double> gap_velocities) {
        for_all_points([&](Point& point) {
            gamma[point.contact] = point.gamma;
            gap_velocities[point.contact] = point.gap_velocity(velocities_.data());
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
                singles, first_of_single, [&](std::uint32_t l) { return b_[l] < 0.0; },
                [&](Point& point, std::uint32_t l) { point = point_of(l); });
            append(
                pairs, first_of_pair, [](const auto&) { return true; },
                [&](PairContacts& pair, const auto& first_and_count) {
                    const auto [first, count] = first_and_count;
                    pair.count = count;
                    for (std::uint32_t a = 0; a < count; ++a) pair.point[a] = point_of(first + a);
                    for (std::uint32_t a = 0; a < count; ++a)
                        for (std::uint32_t c = 0; c < count; ++c)
                            pair.matrix[a][c] = sum_of_products(pair.point[a].column_i, pair.point[c].answer_i,
                                                                pair.point[a].column_j, pair.point[c].answer_j);
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

    Point point_of(std::uint32_t l) const {
        const Contact& contact = matrix_.contact_matrix().contacts().contact[l];
        const auto [i, j] = matrix_.contact_matrix().ends()[l];
        const auto column = [&](double sign, double arm) {
            return ContactForce{sign * contact.normal, (sign * arm) * contact.normal};
        };
        ContactForce of_i = column(-1.0, contact.arm_i), of_j = column(1.0, contact.arm_j);
        if (i == j) {  // own image: one rod feels both
            of_i = {of_i.force + of_j.force, of_i.lever + of_j.lever};
            of_j = {};
        }
        const auto answer = [&](std::uint32_t place, const ContactForce& force) {
            const ContactVelocity velocity = velocity_of(matrix_.rods()[place], force.force, force.lever);
            return Wide{velocity.centre, velocity.turning};
        };
        Point point;
        point.column_i = {of_i.force, of_i.lever};
        point.column_j = {of_j.force, of_j.lever};
        point.answer_i = answer(i, of_i);
        point.answer_j = answer(j, of_j);
        point.b = b_[l];
        point.i = i;
        point.j = j;
        point.contact = l;
        point.diagonal = matrix_.diagonal()[l];
        point.inverse_diagonal = point.diagonal > 0.0 ? 1.0 / point.diagonal : 0.0;
        return point;
    }

    template <class Item>
    void find_awake(Group<Item>& group) {
        const auto is_awake = [&](Item& item) {
            for (const Point& point : points_of(item))
                if (point.gamma > 0.0 || point.gap_velocity(velocities_.data()) < drowsy_velocity_) return true;
            return false;
        };
        const auto end = std::partition(group.items.begin(), group.items.end(), is_awake);
        group.awake = static_cast<std::size_t>(end - group.items.begin());
    }

    /// Calls body(point) for all points; those of a colour in parallel.
    template <class Body>
    void for_all_points(Body&& body) {
        const auto pass = [&](auto items) {
            parallel_for(items.size(), [&](std::size_t k) {
                for (Point& point : points_of(items[k])) body(point);
            });
        };
        for (Colour& colour : colours_) {
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
    double drowsy_velocity_;
    std::vector<Wide> velocities_;             ///< (places) V = M D gamma, kept up to date
    std::vector<std::uint64_t> taken_;         ///< (places) a bit for each colour that a rod has
    std::size_t coloured_ = 0;                 ///< contacts taken in
    std::vector<FirstContacts> new_contacts_;  ///< of the pairs of each colour, while they are taken in
    std::vector<Colour> colours_;
};

}  // namespace

SolverOutcome solve_projected_sor(const ContactProblem& problem, const LcpSettings& settings,
                                  ContactSolution& solution) {
    LcpResult result;
    SolverOutcome outcome;
    Sweeper sweeper(problem, settings.tolerance);
    const auto resize = [&]() {
        solution.resize(problem.matrix.contact_matrix());
        result.solution.resize(problem.matrix.size(), 0.0);
        result.velocity.resize(problem.matrix.size());
    };
    const auto verify = [&]() {
        sweeper.refresh(solution.forces, solution.velocities);
        sweeper.read(result.solution, result.velocity);
        result.residual = lcp_residual(problem.lcp(), settings.residual, result.solution, result.velocity);
        return !std::isfinite(result.residual) || result.residual <= settings.tolerance;
    };
    const auto add_missed = [&](bool final) {
        if (!problem.add_missed || !problem.add_missed(solution, final)) return false;
        sweeper.extend();
        resize();
        return true;
    };
    // Whether nothing is left to be done: solved, and no contact missed; or lost.
    const auto verified = [&]() {
        if (!verify()) return false;
        if (!std::isfinite(result.residual)) return true;
        ++outcome.solves;
        return !add_missed(true);
    };
    resize();
    const bool closing =
        std::any_of(problem.constant.begin(), problem.constant.end(), [](double b) { return !(b >= 0.0); });
    bool finished = !closing && verified(), look_at_all = false;
    std::uint64_t next_verification = 0;
    while (!finished && result.iterations < settings.max_iterations) {
        const bool all = look_at_all || result.iterations % full_sweep_every == full_sweep_every - 1;
        const double change = problem.time_step * sweeper.sweep(relaxation(result.iterations), all);
        ++result.iterations;
        look_at_all = false;
        if (result.iterations == early_search) {
            sweeper.read_velocities(solution.velocities);
            if (add_missed(false)) continue;
        }
        // The residual is near the last change; it is computed where that is small, and now and then for the paper's
        // norm.
        const bool small = settings.residual == LcpResidual::length ? change <= settings.tolerance
                                                                    : result.iterations >= next_verification;
        if (!small && result.iterations < settings.max_iterations) continue;
        finished = verified();
        look_at_all = true;
        next_verification = result.iterations + 5;
    }
    if (!finished) verify();  // contacts may have been added since
    result.status = lcp_status(problem.lcp(), settings, result);
    solution.gamma = std::move(result.solution);
    outcome.status = result.status;
    outcome.residual = result.residual;
    outcome.iterations = result.iterations;
    return outcome;
}

}  // namespace jostle
