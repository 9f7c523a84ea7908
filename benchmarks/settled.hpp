#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"

/// A state to measure: bodies of diameter 1 in a cubic periodic box.
struct Crowd {
    std::string name;
    double length = 0.0;
    double volume_fraction = 0.0;
    jostle::StartKind start = jostle::StartKind::random;
    double self_propulsion = 0.0;  ///< U_0 D/(kT mobility along the axis): a Peclet number; 0 for passive bodies
    int settling_steps = 1000;
    bool in_fluid = false;  ///< moved through a fluid: mobility.model = "hydrodynamic"
};

inline constexpr std::uint64_t settled_count = 2000;  ///< bodies that are brought to rest; larger crowds are copies
inline constexpr double rms_step = 0.03;              ///< of a diameter

/// rods/0.05 ... spheres/0.63, rods/nematic, rods/active.
const std::vector<Crowd>& all_crowds();

/// fluid/rods/0.10 and others, whose steps take a hundred times as long.
const std::vector<Crowd>& crowds_in_fluid();

/// The crowd of that name, of all these; std::out_of_range if there is none.
const Crowd& crowd_named(const std::string& name);

/// A simulation of at least `count` bodies in that state: a start of 2000, made once, that has made its settling steps,
/// copied side by side as often as needed. The copies, moved by noise of their own, forget each other within some tens
/// of steps. Solved by the default method to the default tolerance.
std::unique_ptr<jostle::Simulation> settled(const Crowd& crowd, std::uint64_t count = settled_count);

/// Contacts that give way a little under their force (theory, section 3), as the time-step correction has them, or the
/// paper's hard ones.
enum class ContactKind { compliant, hard };

/// How the contact problem of a step is posed and solved.
struct SolvedBy {
    jostle::SolverMethod method;
    double tolerance;  ///< in D
    double range;      ///< contacts with a smaller gap (in D) are all in the problem; 0: only those that may collide
    ContactKind contacts;
};

/// A simulation of the crowd that goes on, cold, from where another stands.
std::unique_ptr<jostle::Simulation> continued(const Crowd& crowd, const jostle::Simulation& from, const SolvedBy& how);
