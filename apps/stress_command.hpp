#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exit_code.hpp"

/// What stands on the command line of `jostle stress`.
struct StressOptions {
    std::string contacts, bodies;  ///< tables (src/jostle/tables/contact_table.hpp, body_table.hpp)
    std::optional<double> volume;
    std::vector<double> box;       ///< edges along x, y, z; empty: not given
    std::string periodic = "xyz";  ///< directions along which the box is periodic; "none"
    std::string convention = "rigid_body";
    std::string length_unit, force_unit;  ///< empty: what the tables say
    std::string per_body;                 ///< file for the stress of each body; empty: none
    bool json = false;
};

/// `jostle stress CONTACTS --bodies BODIES`: the stress of contacts that another program found.
ExitCode stress_command(const StressOptions& options);
