#pragma once

namespace jostle {

/// The methods that solve a contact problem (contact_solver.hpp).
enum class SolverMethod { automatic, projected_sor, bbpgd, adaptive_bb, apgd, minimum_map_newton };

}  // namespace jostle
