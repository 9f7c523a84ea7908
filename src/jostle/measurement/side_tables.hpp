#pragma once

#include "jostle/growth/growth.hpp"
#include "jostle/measurement/table_columns.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/contact_by_id.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

// The tables beside the series: contacts.csv, lineage.csv, field.csv.

using TableRows = std::vector<std::vector<double>>;  ///< (rows)(columns)

/// A contact with a force in the last step.
struct ContactState {
    const Clock& clock;
    ContactById contact;
    double force, gap;
    double offset;  ///< of the copies above, where a flow shears the box
};
TableColumns<ContactState> contact_columns(const Scene& scene);
/// All of the last step. Of several ranks they are for rank 0, and all call it together.
TableRows contact_rows(const TableColumns<ContactState>& columns, const Simulation& simulation);

/// A birth or a death after the last step.
struct LineageState {
    const Clock& clock;
    const LineageEvent& event;
};
TableColumns<LineageState> lineage_columns(const Scene& scene);
/// All after the last step.
TableRows lineage_rows(const TableColumns<LineageState>& columns, const Simulation& simulation);

/// A cell of the stress field, or all that lies outside: its centre is not a number then.
struct FieldState {
    const Clock& clock;
    Vec3 centre;
    StressField::Content content;
};
TableColumns<FieldState> field_columns(const Scene& scene);
/// A row a cell, and one of what lies outside if the box is open; means over the steps in the field.
TableRows field_rows(const TableColumns<FieldState>& columns, const Clock& clock, const StressField& field);

}  // namespace jostle
