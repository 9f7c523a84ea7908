#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "jostle/error/refuse.hpp"
#include "jostle/hydrodynamics/couple_flow.hpp"
#include "jostle/hydrodynamics/far_field.hpp"
#include "jostle/hydrodynamics/near_couples.hpp"
#include "jostle/hydrodynamics/near_field.hpp"
#include "jostle/hydrodynamics/square_root.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

/// What does not depend on where rods are, but on their lengths and the box.
struct FluidFlows {
    std::shared_ptr<const BlobLines> lines;
    Box box;
    EwaldSplit split;  ///< empty in an unbounded fluid
    PairFlow unbounded;
    std::optional<PairFlow> near;                 ///< in a periodic box
    std::optional<WaveFactors> factors;           ///< in a periodic box
    std::optional<CoupleFlow> couples;            ///< in real space, where spheres turn with the fluid
    std::optional<CoupleFactors> couple_factors;  ///< of waves, there

    FluidFlows(const RodBlobs& blobs, const Box& around, const EwaldSplit& ewald, double viscosity, bool with_couples)
        : lines(blobs.kinds), box(around), split(ewald), unbounded(PairFlow::unbounded(blobs.spread(), viscosity)) {
        const double of_couple = couple_spread(blobs.diameter());
        if (split.spread_points == 0) {
            if (with_couples) couples = CoupleFlow::unbounded(blobs.spread(), of_couple, viscosity);
            return;
        }
        near = PairFlow::near(blobs.spread(), split.splitting, viscosity, split.cutoff);
        factors.emplace(box.edges(), split, blobs.spread(), viscosity);
        if (!with_couples) return;
        couples = CoupleFlow::near(blobs.spread(), of_couple, split.splitting, viscosity, split.cutoff);
        couple_factors.emplace(box.edges(), split, blobs.spread(), of_couple);
    }

    bool fit(const RodBlobs& blobs, const Box& around, const EwaldSplit& ewald) const {
        return lines == blobs.kinds && box.edges() == around.edges() && box.periodic() == around.periodic() &&
               split == ewald;
    }
    const PairFlow& in_real_space() const { return near ? *near : unbounded; }
};

namespace {

/// Near and far field of one configuration.
struct Sums {
    NearField near;
    std::optional<NearCouples> couples;
    std::optional<FarField> far;
};

/// Whether couples on spheres are part of an operator.
enum class Couples { none, of_spheres };

class HydrodynamicOperator final : public MobilityOperator {
public:
    HydrodynamicOperator(const Rods& rods, const Box& box, RodBlobs blobs, std::shared_ptr<const FluidFlows> flows,
                         std::shared_ptr<FluidGrids> grids, std::shared_ptr<NearMemory> near, Couples couples,
                         double noise_change)
        : MobilityOperator(rods),
          box_(box),
          blobs_(std::move(blobs)),
          flows_(std::move(flows)),
          grids_(std::move(grids)),
          near_(std::move(near)),
          couples_(couples),
          noise_change_(noise_change) {}

    void apply(const Forces& forces, Velocities& velocities) const override {
        apply(forces, velocities, sums().far ? &*sums().far : nullptr);
    }
    /// Without the far field.
    void apply_near(const Forces& forces, Velocities& velocities) const override { apply(forces, velocities, nullptr); }

    std::unique_ptr<const MobilityAmong> among(std::span<const std::uint32_t> rows) const override;

    /// xi: six numbers a rod for the near field, and six a wave of the grid (Stream::fluid) for the far field.
    void add_square_root(const RandomKey& key, double scale, Velocities& velocities) const override {
        std::vector<LineVector> moved = near_noise(key, scale);
        RandomKey of_waves = key;
        of_waves.stream = Stream::fluid;
        if (sums().far) sums().far->add_square_root(of_waves, scale, moved);
        add(moved, velocities);
    }

    void add_axial_flow(const AxialStresslets& stresslets, Velocities& velocities) const override {
        if (blobs_.max_blobs() < 2 && !stresslets.of_swimmers()) return;  // M does not depend on the axes of spheres
        std::vector<LineVector> moved(rods().size());
        bool is_first = false;
        std::call_once(summed_, [&] {
            find_sums(&stresslets);
            is_first = true;
        });
        if (is_first)
            sums_->near.add_axial_flow(moved);
        else
            sums_->near.add_axial_flow(stresslets, moved);
        if (sums().couples) sums().couples->add_axial_flow(stresslets, moved);
        if (sums().far) sums().far->add_axial_flow(stresslets, moved);
        add(moved, velocities);
    }

    bool couples_rods() const override { return true; }
    RodMobility of_rod(std::size_t i) const override { return blobs_.of(i).own; }

    /// Theory, eq. (7.9): of the two rods alone in an unbounded fluid.
    double relative_mobility(const PairOfPoints& points) const override {
        const double own = MobilityOperator::relative_mobility(points);
        return points.i == points.j ? own : own - 2.0 * coupling(points);
    }

private:
    void apply(const Forces& forces, Velocities& velocities, const FarField* far) const {
        std::vector<LineVector> pushed(rods().size()), moved(rods().size());
        parallel_for(pushed.size(), [&](std::size_t i) {
            pushed[i] = {forces.force[i], cross(forces.torque[i], rods().axis[i])};
        });
        apply_near(pushed, moved);
        if (far) far->add_flow(pushed, moved);
        velocities.resize(rods().size());
        set(moved, velocities);
    }

    void apply_near(std::span<const LineVector> pushed, std::span<LineVector> moved) const {
        sums().near.apply(pushed, moved);
        if (sums().couples) sums().couples->add_flow(pushed, moved);
    }

    const Sums& sums() const {
        std::call_once(summed_, [this] { find_sums(nullptr); });
        return *sums_;
    }

    void find_sums(const AxialStresslets* stresslets) const {
        std::vector<RodMobility> own;
        for (const BlobLine& line : blobs_.lines()) own.push_back(own_near(line));
        sums_.reset(new Sums{
            NearField(rods(), box_, blobs_, flows_->in_real_space(), std::move(own), *near_, stresslets), {}, {}});
        const bool with_couples = couples_ == Couples::of_spheres;
        if (with_couples) sums_->couples.emplace(rods(), box_, blobs_, *flows_->couples, sums_->near.pairs());
        if (flows_->near)
            sums_->far.emplace(rods(), box_, blobs_, flows_->split, *flows_->factors,
                               with_couples ? &*flows_->couple_factors : nullptr, grids_);
    }

    RodMobility own_near(const BlobLine& line) const {
        const double cutoff = flows_->in_real_space().cutoff();
        const RodMobility blobs = mobility_of_blobs(line, [&](double squared) {
            return squared < cutoff * cutoff ? flows_->in_real_space().at(squared) : BlobFlow{};
        });
        const RodMobility& rest = line.remainder;
        if (line.is_sphere() &&
            couples_ == Couples::of_spheres)  // its couple turns as the sphere alone, without a rest
            return {blobs.parallel + rest.parallel, blobs.perpendicular + rest.perpendicular,
                    flows_->couples->turning(0.0).isotropic};
        return {blobs.parallel + rest.parallel, blobs.perpendicular + rest.perpendicular,
                blobs.rotational + rest.rotational};
    }

    /// Square root of the near field times normal numbers. Moments are measured in lengths that make the two own
    /// mobilities of a rod alike, so that the iteration settles soon.
    std::vector<LineVector> near_noise(const RandomKey& key, double scale) const {
        const std::size_t count = rods().size();
        std::vector<double> length(count);
        std::vector<LineVector> xi(count);
        std::vector<Normals> normals(count);
        parallel_for_blocks(count, normals_at_a_time, [&](std::size_t, std::size_t begin, std::size_t end) {
            fill_normals(key, {rods().id.data() + begin, end - begin}, {normals.data() + begin, end - begin});
            for (std::size_t i = begin; i < end; ++i) {
                const Normals& n = normals[i];
                length[i] = std::sqrt(of_rod(i).perpendicular / of_rod(i).rotational);
                xi[i] = {{n[0], n[1], n[2]}, across(rods().axis[i], {n[3], n[4], n[5]})};
            }
        });
        std::vector<LineVector> scaled(count);
        const auto matrix = [&](std::span<const LineVector> x, std::span<LineVector> result) {
            parallel_for(count, [&](std::size_t i) { scaled[i] = {x[i].centre, length[i] * x[i].moment}; });
            apply_near(scaled, result);
            parallel_for(count, [&](std::size_t i) { result[i].moment *= length[i]; });
        };
        std::vector<LineVector> noise = times_square_root(matrix, std::move(xi), noise_change_);
        parallel_for(count, [&](std::size_t i) {
            noise[i].centre *= scale;
            noise[i].moment *= scale / length[i];
        });
        return noise;
    }

    /// How fast the point of j moves along the normal, for a unit force along it at that of i.
    double coupling(const PairOfPoints& points) const {
        const BlobLine &line_i = blobs_.of(points.i), &line_j = blobs_.of(points.j);
        const Vec3 &axis_i = rods().axis[points.i], &axis_j = rods().axis[points.j];
        const Vec3 moment_i = points.arm_i * across(axis_i, points.normal);
        const Vec3 moment_j = points.arm_j * across(axis_j, points.normal);
        const Vec3 apart = points.arm_i * axis_i + points.distance * points.normal - points.arm_j * axis_j;
        double sum = 0.0;
        for (std::size_t b = 0; b < line_i.place.size(); ++b) {
            const Vec3 force = line_i.force_weight[b] * points.normal + line_i.moment_weight[b] * moment_i;
            for (std::size_t c = 0; c < line_j.place.size(); ++c) {
                const Vec3 on_j = line_j.force_weight[c] * points.normal + line_j.moment_weight[c] * moment_j;
                const Vec3 r = apart + line_j.place[c] * axis_j - line_i.place[b] * axis_i;
                sum += dot(on_j, flows_->unbounded.at(squared_norm(r)).of(r, force));
            }
        }
        return sum;
    }

    void set(std::span<const LineVector> moved, Velocities& velocities) const {
        parallel_for(moved.size(), [&](std::size_t i) {
            velocities.linear[i] = moved[i].centre;
            velocities.angular[i] = cross(rods().axis[i], moved[i].moment);
        });
    }
    void add(std::span<const LineVector> moved, Velocities& velocities) const {
        parallel_for(moved.size(), [&](std::size_t i) {
            velocities.linear[i] += moved[i].centre;
            velocities.angular[i] += cross(rods().axis[i], moved[i].moment);
        });
    }

    const Box& box_;
    RodBlobs blobs_;
    std::shared_ptr<const FluidFlows> flows_;
    std::shared_ptr<FluidGrids> grids_;  ///< none in an unbounded fluid
    std::shared_ptr<NearMemory> near_;
    Couples couples_;
    double noise_change_;
    mutable std::once_flag summed_;
    mutable std::unique_ptr<Sums> sums_;
};

/// Some of the rods, in the same box with the same flows: to them the others do not exist. Contacts press on the
/// centres of spheres: they exert no couples, and do not feel how spheres turn, so that couples are left out.
class FluidAmong final : public MobilityAmong {
public:
    FluidAmong(Rods rods, const Box& box, RodBlobs blobs, std::shared_ptr<const FluidFlows> flows,
               std::shared_ptr<FluidGrids> grids)
        : rods_(std::move(rods)),
          fluid_(rods_, box, std::move(blobs), std::move(flows), std::move(grids), std::make_shared<NearMemory>(),
                 Couples::none, 0.0) {}

    void apply(const Forces& forces, Velocities& velocities) const override { fluid_.apply(forces, velocities); }
    void apply_near(const Forces& forces, Velocities& velocities) const override {
        fluid_.apply_near(forces, velocities);
    }

private:
    const Rods rods_;
    const HydrodynamicOperator fluid_;
};

std::unique_ptr<const MobilityAmong> HydrodynamicOperator::among(std::span<const std::uint32_t> rows) const {
    if (!flows_->near) return nullptr;  // in an unbounded fluid all is near
    RodBlobs blobs{blobs_.kinds, {}};
    for (const std::uint32_t row : rows) blobs.line_of.push_back(blobs_.line_of[row]);
    return std::make_unique<FluidAmong>(reordered(rods(), rows), box_, std::move(blobs), flows_, grids_);
}

void require_known_box(const Rods& rods, const Box& box) {
    const auto [x, y, z] = box.periodic();
    if (x != y || y != z)
        refuse("box.periodic", fmt::format("[{}, {}, {}]", x, y, z),
               "flows are known in a box that is periodic along all directions, or along none, for mobility.model = "
               "\"hydrodynamic\"",
               "all true, or all false");
    if (!x && rods.size() > max_rods_in_open_box)
        refuse("rods.count", fmt::format("{}", rods.size()),
               "in an open box every pair of rods is summed for mobility.model = \"hydrodynamic\"",
               fmt::format("at most {}", max_rods_in_open_box), "Make the box periodic");
}

}  // namespace

HydrodynamicMobility::HydrodynamicMobility(double viscosity, double tolerance, std::optional<double> cutoff,
                                           SpheresTurn spheres)
    : viscosity_(viscosity), tolerance_(tolerance), cutoff_(cutoff), spheres_(spheres) {}

std::unique_ptr<const MobilityOperator> HydrodynamicMobility::at(const Rods& rods, const Box& box) const {
    require_known_box(rods, box);
    std::shared_ptr<const FluidFlows> flows;
    std::shared_ptr<FluidGrids> grids;
    std::shared_ptr<NearMemory> near;
    {
        const std::lock_guard guard(lock_);
        flows = last_;
        grids = std::move(spare_grids_);
        near = std::move(spare_near_);
    }
    RodBlobs blobs = blobs_of(rods, viscosity_, flows ? flows->lines : nullptr);
    const bool with_couples = spheres_ == SpheresTurn::with_fluid && blobs.any_sphere();
    EwaldSplit split;
    if (box.is_periodic() && rods.size() > 0)
        split = ewald_split(
            tolerance_, cutoff_, box,
            {.rods = static_cast<double>(rods.size()),
             .blobs_per_rod = static_cast<double>(blobs.max_blobs()),
             .longest_line = 2.0 * blobs.longest_half(),
             .spread = blobs.spread(),
             .couple_spread = with_couples ? std::optional(couple_spread(blobs.diameter())) : std::nullopt});
    if (!flows || !flows->fit(blobs, box, split)) {
        flows = std::make_shared<const FluidFlows>(blobs, box, split, viscosity_, with_couples);
        const std::lock_guard guard(lock_);
        last_ = flows;
    }
    if (!flows->near)
        grids.reset();
    else if (!grids || grids.use_count() > 1 || !grids->fit(split.grid, with_couples))  // another is at work on them
        grids = std::make_shared<FluidGrids>(split.grid, with_couples);
    if (!near || near.use_count() > 1) near = std::make_shared<NearMemory>();
    {
        const std::lock_guard guard(lock_);
        spare_grids_ = grids;
        spare_near_ = near;
    }
    return std::make_unique<HydrodynamicOperator>(rods, box, std::move(blobs), std::move(flows), std::move(grids),
                                                  std::move(near), with_couples ? Couples::of_spheres : Couples::none,
                                                  std::min(tolerance_, 1e-3));
}

}  // namespace jostle
