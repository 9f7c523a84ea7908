#include "jostle/measurement/flow_columns.hpp"

#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/units.hpp"

namespace jostle {

void add_flow_columns(const Scene& scene, TableColumns<RowState>& series) {
    const std::string stress = unit_of(scene, dimension::stress);
    const std::string sign = "positive in compression";
    series.columns.push_back(
        {{"strain", "1", "gamma", "shear strain of the box at this step, whole edges counted",
          "positive: u_x rises with y"},
         [flow = flow_of(scene)](const RowState& row) { return flow.strain_at(row.simulation.clock().time); }});
    series.add_elements(
        geometric_stress_column_names,
        {"", stress, "Sigma_geo",
         "element of the geometric part of the collision stress, sum over rods of (B/2)(n u + u n) over "
         "the volume with u = T x n, mean over the steps since the last row; symmetric",
         sign},
        [](const RowState& row, std::size_t k) {
            const Mat3 part = row.sums.collision_virial - row.sums.centre_of_mass_virial;
            const Mat3 twice = part + transpose(part);
            return upper_element(twice, k) / (2.0 * row.sums.steps * row.volume);
        });
    series.add_elements(
        flow_stress_column_names,
        {"", stress, "",
         "element at this step of what geometric and orientation stress are together in a steady flow, "
         "sum over rods of -B/(2 mu_r) d(n n)/dt by the flow, over the volume",
         sign},
        [](const RowState& row, std::size_t k) { return upper_element(row.flow_virial, k) / row.volume; });
}

}  // namespace jostle
