#pragma once

#include <doctest/doctest.h>

#include <array>
#include <functional>
#include <string>

#include "jostle/lcp/adaptive_bb.hpp"
#include "jostle/lcp/apgd.hpp"
#include "jostle/lcp/bbpgd.hpp"
#include "jostle/lcp/minimum_map_newton.hpp"

namespace jostle::test {

struct Solver {
    const char* name;
    LcpResult (*solve)(const LcpProblem&, const LcpSettings&, std::span<const double>);
    BarzilaiBorwein step_rule = BarzilaiBorwein::bb1;
};

inline constexpr std::array<Solver, 6> solvers = {{
    {"bbpgd, bb1", solve_bbpgd},
    {"bbpgd, bb2", solve_bbpgd, BarzilaiBorwein::bb2},
    {"bbpgd, alternating", solve_bbpgd, BarzilaiBorwein::alternating},
    {"adaptive_bb", solve_adaptive_bb},
    {"apgd", solve_apgd},
    {"minimum_map_newton", solve_minimum_map_newton},
}};

inline void for_each_solver(const std::function<void(const Solver&)>& test) {
    for (const Solver& solver : solvers) {
        INFO(std::string(solver.name));
        test(solver);
    }
}

inline LcpSettings tight(const Solver& solver) {
    LcpSettings settings;
    settings.tolerance = 1e-12;
    settings.step_rule = solver.step_rule;
    return settings;
}

}  // namespace jostle::test
