#include "jostle/simulation/projected_sor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::size_t most_points = 3;  ///< contacts of one pair (find_contacts)
constexpr std::uint32_t most_colours = 64;

/// Over-relaxation: measured best between 1.3 and 1.4 for dilute and isotropic rods; harder problems want more.
double relaxation(std::uint64_t sweep) {
    return sweep < 60 ? 1.35 : 1.6;
}

/// All contacts pass through the first sweeps and then every `full_sweep_every`-th.
constexpr std::uint64_t full_sweep_every = 5;
/// A contact without force takes part in the other sweeps if its gap would open by less than this many tolerances.
constexpr double drowsy = 100.0;

/// What a sweep needs of a rod: its velocity caused by contact forces, W = Omega x axis, and how it answers to a force.
struct RodState {
    Vec3 velocity, tip_velocity, axis;
    double parallel, perpendicular, rotational;

    double rate(const Vec3& normal, double arm) const { return dot(normal, velocity + arm * tip_velocity); }
    /// Adds the answer to `force` along `normal` at `arm`.
    void push(const Vec3& normal, double arm, double force) {
        const double along = dot(normal, axis);
        const Vec3 across = normal - along * axis;
        velocity += force * (parallel * along * axis + perpendicular * across);
        tip_velocity += (force * arm * rotational) * across;
    }
};

/// The contacts of one pair of rods in one image, and their own part of A.
struct PairBlock {
    std::uint32_t first = 0;  ///< contact
    std::uint32_t count = 0;  ///< of contacts, 1 to 3
    std::array<std::array<double, most_points>, most_points> matrix{};
};

class Sweeper {
public:
    Sweeper(const ContactMatrix& contact_matrix, const Mobility& mobility, const LcpProblem& problem, double tolerance)
        : contacts_(contact_matrix.contacts()), b_(problem.constant), rods_(contact_matrix.rods().size()) {
        const Rods& rods = contact_matrix.rods();
        parallel_for(rods_.size(), [&](std::size_t i) {
            const RodMobility rod = mobility.of_rod(i);
            rods_[i] = {{}, {}, rods.axis[i], rod.parallel, rod.perpendicular, rod.rotational};
        });
        drowsy_velocity_ = drowsy * tolerance / problem.time_step;
        make_blocks();
        colour();
    }

    /// V = M D gamma.
    void set_velocities(std::span<const double> gamma) {
        for (std::size_t l = 0; l < gamma.size(); ++l)
            if (gamma[l] != 0.0) push(l, gamma[l]);
    }

    /// One pass over all pairs, or over those awake; returns the largest change of a gap velocity by a contact's own
    /// force.
    double sweep(std::span<double> gamma, double omega, bool all) {
        if (all) awake_ = coloured_;
        double largest = 0.0;
        for (auto& colour : awake_) {
            largest = std::max(largest, parallel_max(colour.size(), 0.0, [&](std::size_t k) {
                                   return solve_pair(blocks_[colour[k]], gamma, omega);
                               }));
        }
        if (all) {
            for (auto& colour : awake_)
                std::erase_if(colour, [&](std::uint32_t block) { return !is_awake(blocks_[block], gamma); });
        }
        return largest;
    }

private:
    void make_blocks() {
        const auto& contact = contacts_.contact;
        for (std::uint32_t l = 0; l < contact.size();) {
            PairBlock block{l, 0, {}};
            while (l < contact.size() && block.count < most_points && contact[l].i == contact[block.first].i &&
                   contact[l].j == contact[block.first].j && contacts_.image[l] == contacts_.image[block.first]) {
                ++block.count;
                ++l;
            }
            blocks_.push_back(block);
        }
        parallel_for(blocks_.size(), [&](std::size_t k) { fill_matrix(blocks_[k]); });
    }

    /// Element (a, b): the velocity of gap a caused by a unit force at b.
    void fill_matrix(PairBlock& block) {
        for (std::uint32_t b = 0; b < block.count; ++b) {
            const Contact& source = contacts_.contact[block.first + b];
            RodState i = rods_[source.i], other = rods_[source.j];
            RodState& j = source.i == source.j ? i : other;  // own image: one rod feels both
            i.velocity = i.tip_velocity = j.velocity = j.tip_velocity = {};
            i.push(source.normal, source.arm_i, -1.0);
            j.push(source.normal, source.arm_j, 1.0);
            for (std::uint32_t a = 0; a < block.count; ++a) {
                const Contact& seen = contacts_.contact[block.first + a];
                block.matrix[a][b] = j.rate(seen.normal, seen.arm_j) - i.rate(seen.normal, seen.arm_i);
            }
        }
    }

    void colour() {
        std::vector<std::uint64_t> taken(rods_.size(), 0);
        for (std::uint32_t k = 0; k < blocks_.size(); ++k) {
            const Contact& contact = contacts_.contact[blocks_[k].first];
            const auto colour = static_cast<std::uint32_t>(std::countr_one(taken[contact.i] | taken[contact.j]));
            if (colour >= most_colours) {  // a rod with very many neighbours: pairs that stand alone
                coloured_.resize(std::max<std::size_t>(coloured_.size(), most_colours));
                coloured_.push_back({k});
                continue;
            }
            taken[contact.i] |= std::uint64_t{1} << colour;
            taken[contact.j] |= std::uint64_t{1} << colour;
            if (coloured_.size() <= colour) coloured_.resize(colour + 1);
            coloured_[colour].push_back(k);
        }
    }

    double gap_velocity(std::size_t l) const {
        const Contact& contact = contacts_.contact[l];
        return b_[l] + rods_[contact.j].rate(contact.normal, contact.arm_j) -
               rods_[contact.i].rate(contact.normal, contact.arm_i);
    }

    void push(std::size_t l, double force) {
        const Contact& contact = contacts_.contact[l];
        rods_[contact.i].push(contact.normal, contact.arm_i, -force);
        rods_[contact.j].push(contact.normal, contact.arm_j, force);
    }

    bool is_awake(const PairBlock& block, std::span<const double> gamma) const {
        for (std::uint32_t l = block.first; l < block.first + block.count; ++l)
            if (gamma[l] > 0.0 || gap_velocity(l) < drowsy_velocity_) return true;
        return false;
    }

    using Points = std::array<double, most_points>;  ///< a number per contact of a pair

    double solve_pair(const PairBlock& block, std::span<double> gamma, double omega) {
        Points velocity{}, target{};
        bool idle = true;
        for (std::uint32_t a = 0; a < block.count; ++a) {
            velocity[a] = gap_velocity(block.first + a);
            target[a] = gamma[block.first + a];
            idle = idle && target[a] == 0.0 && velocity[a] >= 0.0;
        }
        if (idle) return 0.0;
        solve_own_problem(block, velocity, target);
        const double factor = feasible_relaxation(block, gamma, target, omega);
        double largest = 0.0;
        for (std::uint32_t a = 0; a < block.count; ++a) {
            double& force = gamma[block.first + a];
            const double change = std::max(force + factor * (target[a] - force), 0.0) - force;
            if (change == 0.0) continue;
            force += change;
            push(block.first + a, change);
            largest = std::max(largest, std::fabs(change) * block.matrix[a][a]);
        }
        return largest;
    }

    /// The largest factor up to omega that keeps all forces of the pair >= 0. Clipping them one by one instead could
    /// raise the energy where they are nearly dependent, and the sweeps would not end.
    static double feasible_relaxation(const PairBlock& block, std::span<const double> gamma, const Points& target,
                                      double omega) {
        double factor = omega;
        for (std::uint32_t a = 0; a < block.count; ++a) {
            const double force = gamma[block.first + a];
            if (target[a] < force) factor = std::min(factor, force / (force - target[a]));
        }
        return factor;
    }

    /// The pair's own contact problem with all other forces as they are: `target` holds gamma on entry and gamma* on
    /// return.
    ///
    /// Every set of active points is tried, and the one that violates the conditions least is taken. Nearly singular
    /// sets are left out: where three points are dependent, two of them do as well.
    static void solve_own_problem(const PairBlock& block, const Points& velocity, Points& target) {
        Points without{};  // gap velocities if this pair had no forces
        for (std::uint32_t a = 0; a < block.count; ++a) {
            without[a] = velocity[a];
            for (std::uint32_t c = 0; c < block.count; ++c) without[a] -= block.matrix[a][c] * target[c];
        }
        Points best{};
        double least = violation(block, without, best);
        const auto consider = [&](const Points& gamma) {
            const double here = violation(block, without, gamma);
            if (here < least) {
                least = here;
                best = gamma;
            }
        };
        for (std::uint32_t a = 0; a < block.count && least > 0.0; ++a) {
            if (!(block.matrix[a][a] > 0.0)) continue;  // no force can open this gap
            Points gamma{};
            gamma[a] = std::max(-without[a] / block.matrix[a][a], 0.0);
            consider(gamma);
            for (std::uint32_t c = 0; c < a; ++c) {
                const double determinant =
                    block.matrix[a][a] * block.matrix[c][c] - block.matrix[a][c] * block.matrix[c][a];
                if (!(determinant > 1e-12 * block.matrix[a][a] * block.matrix[c][c])) continue;
                gamma = {};
                gamma[a] = (block.matrix[a][c] * without[c] - block.matrix[c][c] * without[a]) / determinant;
                gamma[c] = (block.matrix[c][a] * without[a] - block.matrix[a][a] * without[c]) / determinant;
                if (gamma[a] >= 0.0 && gamma[c] >= 0.0) consider(gamma);
            }
        }
        if (block.count == 3 && least > 0.0) {
            const Points gamma = all_three_active(block, without);
            if (gamma[0] >= 0.0 && gamma[1] >= 0.0 && gamma[2] >= 0.0) consider(gamma);
        }
        target = best;
    }

    /// gamma that makes all three gap velocities vanish (Cramer's rule), or -1 where the three are dependent.
    static Points all_three_active(const PairBlock& block, const Points& without) {
        const auto& K = block.matrix;
        const Vec3 rows[3] = {{K[0][0], K[0][1], K[0][2]}, {K[1][0], K[1][1], K[1][2]}, {K[2][0], K[2][1], K[2][2]}};
        const Vec3 crossed[3] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
        const double determinant = dot(rows[0], crossed[0]);
        if (!(determinant > 1e-12 * K[0][0] * K[1][1] * K[2][2])) return {-1.0, -1.0, -1.0};
        const Vec3 solution =
            (-1.0 / determinant) * (without[0] * crossed[0] + without[1] * crossed[1] + without[2] * crossed[2]);
        return {solution.x, solution.y, solution.z};
    }

    /// max |min(A_aa gamma_a, velocity_a)| over the points of a pair.
    static double violation(const PairBlock& block, const Points& without, const Points& gamma) {
        double largest = 0.0;
        for (std::uint32_t a = 0; a < block.count; ++a) {
            double velocity = without[a];
            for (std::uint32_t c = 0; c < block.count; ++c) velocity += block.matrix[a][c] * gamma[c];
            largest = std::max(largest, std::fabs(std::min(block.matrix[a][a] * gamma[a], velocity)));
        }
        return largest;
    }

    const Contacts& contacts_;
    std::span<const double> b_;
    std::vector<RodState> rods_;
    double drowsy_velocity_ = 0.0;
    std::vector<PairBlock> blocks_;
    std::vector<std::vector<std::uint32_t>> coloured_, awake_;  ///< blocks of each colour
};

}  // namespace

LcpResult solve_projected_sor(const ContactMatrix& contact_matrix, const Mobility& mobility,
                              const DelassusOperator& matrix, const LcpProblem& problem, const LcpSettings& settings,
                              std::span<const double> start) {
    LcpResult result;
    const std::size_t count = matrix.size();
    result.solution.assign(start.begin(), start.end());
    result.solution.resize(count, 0.0);
    result.velocity.resize(count);
    const auto verify = [&]() {
        matrix.apply(result.solution, result.velocity);
        parallel_for(count, [&](std::size_t l) { result.velocity[l] += problem.constant[l]; });
        result.residual = lcp_residual(problem, settings.residual, result.solution, result.velocity);
        return !std::isfinite(result.residual) || result.residual <= settings.tolerance;
    };
    Sweeper sweeper(contact_matrix, mobility, problem, settings.tolerance);
    sweeper.set_velocities(result.solution);
    bool finished = verify(), look_at_all = true;
    std::uint64_t next_verification = 0;
    while (!finished && result.iterations < settings.max_iterations) {
        const bool all = look_at_all || result.iterations % full_sweep_every == 0;
        const double change = problem.time_step * sweeper.sweep(result.solution, relaxation(result.iterations), all);
        ++result.iterations;
        look_at_all = result.iterations < 2;
        // The residual is near the last change; it is computed where that is small, and now and then for the paper's
        // norm.
        const bool small = settings.residual == LcpResidual::length ? change <= settings.tolerance
                                                                    : result.iterations >= next_verification;
        if (small || result.iterations == settings.max_iterations) {
            finished = verify();
            look_at_all = true;
            next_verification = result.iterations + 5;
        }
    }
    result.status = lcp_status(problem, settings, result);
    return result;
}

}  // namespace jostle
