#include "jostle/simulation/shearing.hpp"

#include <cmath>

#include "jostle/math/shear_rotation.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

namespace {

ShearRotation rotation_of(const Rods& rods, std::size_t i, double strain) {
    return {strain, moment_anisotropy(rods.length[i] / rods.diameter[i])};
}

}  // namespace

Shearing::Shearing(State& state, const std::optional<ShearFlow>& flow, double time_step, CollisionSearch& search)
    : state_(state), search_(search) {
    if (!flow) return;
    const double strain = flow->strain_of_step(state.clock, time_step);
    if (strain == 0.0) return;
    is_made_ = true;
    box_before_ = state.box;
    centre_before_ = state.rods.centre;
    axis_before_ = state.rods.axis;
    image_before_ = state.rods.image;
    springs_before_ = state.springs;
    const Vec3 edges = state.box.edges();
    const double offset = state.box.offset() + strain * edges.y;
    const double strain_at_end = flow->strain_at(static_cast<double>(state.clock.step + 1) * time_step);
    state.box = state.box.sheared(strain_at_end * edges.y);
    shear(strain, static_cast<int>(std::lround((offset - state.box.offset()) / edges.x)));
}

/// `copies`: by so many the copies above have other numbers along x than before, for it was the next that came nearer.
void Shearing::shear(double strain, int copies) {
    Rods& rods = state_.rods;
    const bool any = rods.size() > 0;
    const ShearRotation rotation = any ? rotation_of(rods, 0, strain) : ShearRotation(strain, 0.0);  // of most, or all
    parallel_for(rods.size(), [&](std::size_t i) {
        rods.centre[i].x += strain * rods.centre[i].y;
        rods.image[i][0] += copies * rods.image[i][1];
        state_.box.wrap(rods.centre[i], rods.image[i]);
        const bool alike = rods.length[i] == rods.length[0] && rods.diameter[i] == rods.diameter[0];
        rods.axis[i] = (alike ? rotation : rotation_of(rods, i, strain)).of(rods.axis[i]);
    });
    for (Spring& spring : state_.springs) spring.image[0] += copies * spring.image[1];
    search_.shear(strain, copies);
}

Shearing::~Shearing() {
    if (!is_made_) return;
    state_.box = box_before_;
    state_.rods.centre.swap(centre_before_);
    state_.rods.axis.swap(axis_before_);
    state_.rods.image.swap(image_before_);
    state_.springs.swap(springs_before_);
    search_.invalidate();
}

}  // namespace jostle
