// Every solver of lcp, with several threads.

#include <doctest/doctest.h>

#include "jostle/parallel/parallel_for.hpp"
#include "lcp_solvers.hpp"
#include "sphere_network.hpp"

using namespace jostle;
using namespace jostle::test;

TEST_CASE("networks of spheres: the same bits for any number of threads") {
    const int threads = parallel::thread_count();
    for (const double jitter : jitters) {
        const SphereNetwork network(6, jitter, 11);
        const LcpProblem problem{network, network.constant()};
        for_each_solver([&](const Solver& solver) {
            LcpSettings settings = tight(solver);
            settings.tolerance = 1e-9;
            const auto result = solver.solve(problem, settings, {});
            parallel::set_thread_count(3);
            const auto threaded = solver.solve(problem, settings, {});
            parallel::set_thread_count(threads);
            CHECK(threaded.iterations == result.iterations);
            CHECK(threaded.solution == result.solution);
        });
    }
}
