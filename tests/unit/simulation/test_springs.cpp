// Springs between rods: what they do to them, and their stress.

#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/springs.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/stress/rigid_body_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "jostle/stress/spring_stress.hpp"

using namespace jostle;

namespace {

const double pi = std::acos(-1.0);
const double mobility_of_sphere = 1.0 / (3.0 * pi);  // D = 1, viscosity 1

Scene still_spheres() {
    Scene scene;
    scene.rods.length = 0.0;
    scene.motion.brownian = false;
    scene.time.step = 0.01;
    scene.springs.file = "springs.csv";
    return scene;
}

std::string refusal_of(const Scene& scene, const Rods& rods, std::vector<Spring> springs) {
    try {
        assemble(scene, {{{10, 10, 10}, {true, true, true}}, rods, {}, std::move(springs)});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

// Two spheres, 0.2 from a face of the box and on either side of it, distance 3, rest length 1.5, pulled together along
// a line that is along no edge. As the face is crossed and rows change places the spring holds the same copy.
TEST_CASE("a stretched spring relaxes by the factor 1 - 2 k M dt a step, through a periodic face") {
    const Scene scene = still_spheres();
    const Vec3 direction = normalised({2, 1, -1});
    const Box box{{10, 10, 10}, {true, true, false}};
    Rods rods;
    rods.push_back(0, {9.8, 5, 5}, {1, 0, 0}, 0.0, 1.0);
    Vec3 centre = rods.centre[0] + 3.0 * direction;
    rods.push_back(1, {centre.x - 10.0, centre.y, centre.z}, {0, 1, 0}, 0.0, 1.0);
    std::vector<Spring> springs = {{0, 1, 0.0, 0.0, 1.5, 4.0, {}}};
    hold_nearest_images(springs, rods, box);
    CHECK(springs[0].image == Image{1, 0, 0});
    Simulation simulation = assemble(scene, {box, rods, {}, springs});
    const double factor = 1.0 - 2.0 * 4.0 * mobility_of_sphere * 0.01;
    double stretch = 1.5;
    for (int step = 0; step < 600; ++step) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        // Pulling: r F = -(rest + stretch half way) k stretch.
        const double half_way = 1.5 + 0.5 * (1.0 + factor) * stretch;
        CHECK(trace(report.spring_virial) == doctest::Approx(-half_way * 4.0 * stretch).epsilon(1e-11));
        CHECK(norm(report.spring_virial - trace(report.spring_virial) * outer(direction, direction)) < 1e-11);
        stretch *= factor;
        const SpringPull pull = spring_pulls(springs, simulation.rods(), box)[0];
        const double distance = norm(pull.separation(springs[0], simulation.rods().centre, simulation.rods().axis));
        CHECK(distance - 1.5 == doctest::Approx(stretch).epsilon(1e-11));
    }
    CHECK(stretch < 1e-2);
}

TEST_CASE("spheres that a spring pulls together stop at touching, and push back as it pulls") {
    Rods rods;
    rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 0.0, 1.0);
    rods.push_back(1, {6.1, 5, 5}, {1, 0, 0}, 0.0, 1.0);
    const Box box{{10, 10, 10}, {true, true, true}};
    Simulation simulation = assemble(still_spheres(), {box, rods, {}, {{0, 1, 0.0, 0.0, 0.0, 5.0, {}}}});
    StepReport report;
    for (int step = 0; step < 100; ++step) report = simulation.step();
    CHECK(simulation.rods().centre[1].x - simulation.rods().centre[0].x == doctest::Approx(1.0).epsilon(1e-5));
    CHECK(simulation.contact_solution().gamma[0] == doctest::Approx(5.0).epsilon(1e-4));
    CHECK(report.collision_virial(0, 0) == doctest::Approx(5.0).epsilon(1e-4));
    CHECK(norm(report.collision_virial + report.spring_virial) < 1e-3);
}

// A rod of L = 4 along x, and a sphere 3 above its point s = 1.5 along z; stiffness 2, rest length 1: the force on the
// sphere is (0, 0, -4), on the rod (0, 0, 4), its torque 1.5 x (x) 4 z = -6 y.
TEST_CASE("off the centre a spring turns its rod: velocities and stress by hand") {
    const Scene scene = still_spheres();
    const Box box{{20, 20, 20}, {true, true, true}};
    Rods rods;
    rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(1, {6.5, 5, 8}, {1, 0, 0}, 0.0, 1.0);
    const std::vector<Spring> springs = {{0, 1, 1.5, 0.0, 1.0, 2.0, {}}};
    const auto pulls = spring_pulls(springs, rods, box);
    CHECK(norm(pulls[0].force - Vec3{0, 0, -4}) < 1e-15);
    const Forces forces = spring_forces(springs, pulls, rods);
    CHECK(norm(forces.force[0] - Vec3{0, 0, 4}) < 1e-15);
    CHECK(norm(forces.torque[0] - Vec3{0, -6, 0}) < 1e-15);
    CHECK(norm(forces.torque[1]) == 0.0);

    const auto model = make_mobility(scene);
    const auto mobility = model->at(rods, box);
    Velocities velocities;
    mobility->apply(spring_forces(springs, spring_pulls(springs, rods, box), rods), velocities);
    CHECK(norm(velocities.linear[0] - Vec3{0, 0, 4.0 * mobility->of_rod(0).perpendicular}) < 1e-15);
    CHECK(norm(velocities.angular[0] - Vec3{0, -6.0 * mobility->of_rod(0).rotational, 0}) < 1e-15);
    CHECK(norm(velocities.linear[1] - Vec3{0, 0, -4.0 * mobility_of_sphere}) < 1e-15);

    const Mat3 stress = sum_of_spring_stresses(springs, pulls, rods, rods.centre, rods.axis);
    const RigidBody rod = {rods.centre[0], second_moment(spherocylinder_moments(4.0, 1.0), rods.axis[0])};
    const RigidBody sphere = {rods.centre[1], second_moment(spherocylinder_moments(0.0, 1.0), rods.axis[1])};
    const Mat3 expected = pair_stress(rod, sphere, {1.5, 0, 0}, {0, 0, 0}, {0, 0, -4}).total();
    CHECK(norm(stress - expected) < 1e-13);
    CHECK(norm(stress - transpose(stress)) < 1e-13);
    CHECK(trace(stress) == doctest::Approx(-12.0));
    const double B = moment_anisotropy(4.0);
    CHECK(stress(0, 2) == doctest::Approx(-6.0 + 3.0 + 3.0 * B));  // (r_2 - r_1) F, spin and stretch of the rod
}

TEST_CASE("at other places than those of the force: symmetric, with the trace of all of the separation") {
    const Box box{{20, 20, 20}, {true, true, true}};
    Rods rods;
    rods.push_back(0, {5, 5, 5}, normalised({1, 2, 0}), 4.0, 1.0);
    rods.push_back(1, {7, 6, 9}, normalised({0, 1, 1}), 2.0, 1.0);
    const std::vector<Spring> springs = {{0, 1, 1.5, -1.0, 1.0, 2.0, {}}};
    const auto pulls = spring_pulls(springs, rods, box);
    const std::vector<Vec3> centre = {{5.1, 5, 4.8}, {7, 6.2, 9}},
                            axis = {normalised({1, 2, 0.2}), normalised({0, 1, 1.1})};
    const Mat3 stress = sum_of_spring_stresses(springs, pulls, rods, centre, axis);
    CHECK(norm(stress - transpose(stress)) < 1e-13 * norm(stress));
    CHECK(trace(stress) == doctest::Approx(dot(centre[1] - centre[0], pulls[0].force)).epsilon(1e-13));
}

TEST_CASE("how fast springs relax: exact for two spheres, summed over the springs of a rod, with its turning") {
    const auto mobility_of = [](std::uint64_t id) {
        return id == 0 ? RodMobility{3.0, 2.0, 0.5} : RodMobility{1.0, 1.0, 1.0};
    };
    CHECK(spring_relaxation(std::vector<Spring>{{1, 2, 0.0, 0.0, 0.0, 4.0, {}}}, mobility_of, 0.1) ==
          doctest::Approx(0.8));
    const std::vector<Spring> two = {{0, 1, 0.0, 0.0, 0.0, 4.0, {}}, {2, 0, 0.0, 2.0, 1.0, 5.0, {}}};
    CHECK(spring_relaxation(two, mobility_of, 0.1) == doctest::Approx(0.1 * 2.0 * (4.0 * 3.0 + 5.0 * (2.0 + 4 * 0.5))));
    CHECK(spring_relaxation({}, mobility_of, 0.1) == 0.0);
}

TEST_CASE("springs that no run can hold are refused") {
    Rods rods;
    rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 0.0, 1.0);
    rods.push_back(1, {7, 5, 5}, {1, 0, 0}, 0.0, 1.0);
    const double stiffest = 1.0 / (2.0 * mobility_of_sphere * 0.01);
    CHECK(refusal_of(still_spheres(), rods, {{0, 1, 0.0, 0.0, 0.0, 0.999 * stiffest, {}}}).empty());
    const std::string stiff = refusal_of(still_spheres(), rods, {{0, 1, 0.0, 0.0, 0.0, 2.5 * stiffest, {}}});
    CAPTURE(stiff);
    CHECK(
        stiff.find(
            "too stiff for the time step: in a step of 0.01, the part of their stretch that they may lose (2 dt times "
            "stiffness times mobility) is 2.5") != std::string::npos);
    CHECK(stiff.find("a step of at most 0.004") != std::string::npos);
    CHECK(refusal_of(still_spheres(), rods, {}).find("were not read") != std::string::npos);
    Scene growing = still_spheres();
    growing.growth.rate = 0.1;
    growing.growth.division_length = 3.0;
    CHECK(refusal_of(growing, rods, {{0, 1, 0.0, 0.0, 0.0, 1.0, {}}}).find("cells divide") != std::string::npos);
    Simulation unknown = assemble(still_spheres(), {{}, rods, {}, {{0, 7, 0.0, 0.0, 0.0, 1.0, {}}}});
    CHECK_THROWS_AS(unknown.step(), InputError);
    CHECK(refusal_of(still_spheres(), rods, {{0, 1, 0.0, 0.0, -1.0, 1.0, {}}}).find("rest_length") !=
          std::string::npos);
    CHECK(refusal_of(still_spheres(), rods, {{0, 1, 0.0, 0.0, 0.0, -1.0, {}}}).find("stiffness") != std::string::npos);
}

TEST_CASE("with springs, a simulation made from the state of another goes on bit for bit, also on two threads") {
    Scene scene;
    scene.rods.length = 1.0;
    scene.time.rms_step = 0.03;
    scene.springs.file = "springs.csv";
    const Box box{{12, 12, 12}, {true, true, true}};
    Rods rods;
    std::vector<Spring> springs;
    for (std::size_t k = 0; k < 700; ++k) {
        const auto at = [](std::size_t n) { return 0.6 + 1.2 * static_cast<double>(n); };
        rods.push_back(k, {at(k % 10), at(k / 10 % 10), 1.7 * at(k / 100)}, {0, 0, 1}, k / 100 < 6 ? 1.0 : 0.0, 1.0);
        if (k % 10 != 9) springs.push_back({k, k + 1, 0.0, 0.0, 1.2, 3.0, {}});
    }
    Simulation whole = assemble(scene, {box, rods, {}, springs});
    for (int step = 0; step < 505; ++step) REQUIRE(whole.step().status == LcpStatus::converged);
    parallel::set_thread_count(2);
    Simulation again = assemble(scene, whole.state());
    for (int step = 505; step < 520; ++step) {  // rows change places at 512
        const StepReport a = whole.step(), b = again.step();
        CHECK(a.spring_virial.m == b.spring_virial.m);
        CHECK(a.collision_virial.m == b.collision_virial.m);
    }
    CHECK(whole.rods().centre == again.rods().centre);
    parallel::set_thread_count(1);
}

//    ====o     two rods side by side, tied at their ends by a spring at rest; each swims, hardly, and turns round now
//        |     and then: the same body, so the spring goes on holding the ends that it held
//    ====o
TEST_CASE("a rod that turns round takes along the points that springs hold") {
    Scene scene = still_spheres();
    scene.rods.length = 5.0;
    scene.motion.self_propulsion = 1e-9;
    scene.motion.reversal_rate = 0.2;
    const Box box{{40, 40, 40}, {true, true, true}};
    Rods rods;
    rods.push_back(0, {20, 20, 20}, {1, 0, 0}, 5.0, 1.0);
    rods.push_back(1, {20, 23, 20}, {1, 0, 0}, 5.0, 1.0);
    Simulation whole = assemble(scene, {box, rods, {}, {{0, 1, 2.5, 2.5, 3.0, 5.0, {}}}});
    std::optional<Simulation> again;
    int turns = 0;
    for (int step = 0; step < 5000; ++step) {
        const double before = whole.rods().axis[0].x;
        const StepReport report = whole.step();
        REQUIRE(std::fabs(trace(report.spring_virial)) < 1e-6);  // swimming stretches it by 5e-8 at most
        turns += whole.rods().axis[0].x * before < 0.0 ? 1 : 0;
        if (again) again->step();
        if (turns == 3 && !again) again.emplace(assemble(scene, whole.state()));
    }
    CHECK(turns > 3);
    CHECK(std::fabs(whole.state().springs[0].s_1) == 2.5);
    for (const std::size_t row : {0U, 1U}) {
        CHECK(std::fabs(std::fabs(whole.rods().axis[row].x) - 1.0) < 1e-12);
        CHECK(again->rods().axis[row] == whole.rods().axis[row]);
        CHECK(again->rods().centre[row] == whole.rods().centre[row]);
    }
}
