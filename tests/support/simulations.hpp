#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "jostle/rods/space_filling_order.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

namespace jostle::test {

/// The scene's box as it is before the first step.
inline Box box_at_start(const Scene& scene) {
    return sheared_at_start(scene, {box_edges(scene), scene.box.periodic});
}

inline Simulation started(const Scene& scene) {
    const Box box = box_at_start(scene);
    return assemble(scene, {box, make_start(scene, box)});
}

inline void make_steps(Simulation& simulation, int steps) {
    for (int step = 0; step < steps; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
}

/// Of each rod, by its id, where its centre is if the box had not wrapped it.
inline std::vector<Vec3> places(const Simulation& simulation) {
    const Rods& rods = simulation.rods();
    std::vector<Vec3> places(rods.size());
    for (std::size_t i = 0; i < rods.size(); ++i)
        places[rods.id[i]] = rods.centre[i] + simulation.box().displacement(rods.image[i]);
    return places;
}

/// The same bits of clock, box and rods, in whatever rows they stand.
inline void check_same_state(const Simulation& one, const Simulation& other) {
    const Rods a = in_order_of_ids(one.rods()), b = in_order_of_ids(other.rods());
    CHECK(one.clock().step == other.clock().step);
    CHECK(one.clock().time == other.clock().time);
    CHECK(one.box().edges() == other.box().edges());
    CHECK(one.box().offset() == other.box().offset());
    CHECK(a.id == b.id);
    CHECK(a.centre == b.centre);
    CHECK(a.axis == b.axis);
    CHECK(a.length == b.length);
    CHECK(a.image == b.image);
}

}  // namespace jostle::test
