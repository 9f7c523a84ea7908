// Cells that lengthen in single file, without noise: each pushes all that are beyond it (Volfson et al. 2008 in one
// dimension).

#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "jostle/mobility/drag.hpp"
#include "jostle/setup/assemble.hpp"

using namespace jostle;

TEST_CASE("in a file of N growing cells contact k bears g k (N - k)/(2 mu)") {
    // o====oo====oo====o ... all lengthen at g: cell i moves at g (i - (N - 1)/2), and drag adds up from the ends
    constexpr int cells = 10;
    Scene scene;
    scene.rods.count = cells;
    scene.rods.length = 2.0;
    scene.fluid.kT = 0.0;
    scene.growth.rate = 1.0;
    scene.growth.rate_deviation = 0.0;
    scene.growth.division_length = 50.0;
    scene.growth.division_deviation = 0.0;
    scene.box.edges = Vec3{100, 10, 10};
    scene.box.periodic = {false, false, false};
    scene.time.step = 1e-3;
    scene.solver.tolerance = 1e-12;
    scene.solver.max_iterations = 1000000;
    State state;
    state.box = Box{{100, 10, 10}, {false, false, false}};
    for (int k = 0; k < cells; ++k)
        state.rods.push_back(static_cast<std::uint64_t>(k), {10.0 + 3.0 * k, 5, 5}, {1, 0, 0}, 2.0, 1.0);
    Simulation file = assemble(scene, std::move(state));
    REQUIRE(file.step().status == LcpStatus::converged);
    const double mu = file.mobility().at(file.rods(), file.box())->of_rod(0).parallel;
    std::map<std::uint64_t, double> force;  // by the id of the first cell
    for (std::size_t l = 0; l < file.contacts().size(); ++l) {
        const auto& ids = file.contact_ids();
        const Contact& contact = file.contacts().contact[l];
        force[std::min(ids[contact.i], ids[contact.j])] += file.contact_solution().gamma[l];
    }
    for (int k = 1; k < cells; ++k)
        CHECK(force[static_cast<std::uint64_t>(k - 1)] ==
              doctest::Approx(scene.growth.rate * k * (cells - k) / (2.0 * mu)).epsilon(1e-6));
}
