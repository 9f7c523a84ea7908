#include "jostle/measurement/side_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

template <class Item>
double step_of(const Item& item) {
    return static_cast<double>(item.clock.step);
}

template <class Item>
double time_of(const Item& item) {
    return item.clock.time;
}

/// By which a contact stands among others: the ids of its bodies.
using BodyIds = std::array<std::uint64_t, 2>;

/// Contacts of the same two bodies are of one rank, and stay in the order that they have there.
TableRows at_first_rank(TableRows rows, std::vector<BodyIds> ids, std::size_t columns, const Ranks& ranks) {
    if (ranks.alone()) return rows;
    std::vector<double> numbers;
    for (const std::vector<double>& row : rows) numbers.insert(numbers.end(), row.begin(), row.end());
    numbers = ranks.gather_at_first(numbers);
    ids = ranks.gather_at_first(ids);
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    TableRows all;
    for (const std::size_t k : order) {
        const auto row = numbers.begin() + static_cast<std::ptrdiff_t>(k * columns);
        all.emplace_back(row, row + static_cast<std::ptrdiff_t>(columns));
    }
    return all;
}

constexpr const char* number_of_steps = "number of steps done";
constexpr const char* simulated_time = "simulated time";

}  // namespace

TableColumns<ContactState> contact_columns(const Scene& scene) {
    using Item = ContactState;
    const std::string length = unit_of(scene, dimension::length);
    const SeriesColumn image{"", "1", "", "box edges by which the second rod is displaced", ""};
    const SeriesColumn normal{"", "1", "n", "unit vector from the first to the second rod", ""};
    const auto id = [](std::size_t k) {
        return [k](const Item& item) { return static_cast<double>(item.contact.id[k]); };
    };
    const auto arm = [](std::size_t k) { return [k](const Item& item) { return item.contact.arm[k]; }; };
    TableColumns<Item> table{"contacts", {}};
    table.columns = {{{"step", "1", "k", number_of_steps, ""}, step_of<Item>},
                     {{"id_i", "1", "i", "id of the first rod", ""}, id(0)},
                     {{"id_j", "1", "j", "id of the second rod", ""}, id(1)}};
    table.add_elements(std::array{"image_x", "image_y", "image_z"}, image,
                       [](const Item& item, std::size_t k) { return static_cast<double>(item.contact.image[k]); });
    if (has_flow(scene))
        table.columns.push_back(
            {{"offset", length, "",
              "by which the box's copies above are displaced along x: an image by m box edges along "
              "y is displaced along x by m times it, too",
              ""},
             [](const Item& item) { return item.offset; }});
    table.columns.push_back(
        {{"force", unit_of(scene, dimension::force), "gamma", "contact force", "positive: repulsive"},
         [](const Item& item) { return item.force; }});
    table.columns.push_back({{"gap", length, "Phi", "gap before the step", "negative: overlap"},
                             [](const Item& item) { return item.gap; }});
    table.add_elements(std::array{"normal_x", "normal_y", "normal_z"}, normal,
                       [](const Item& item, std::size_t k) { return item.contact.normal[static_cast<int>(k)]; });
    if (scene_walls(scene).any())
        table.columns.push_back({{"wall", "1", "",
                                  "0, 1: lower, upper face across x; 2, 3: y; 4, 5: z; 6: sphere or tube; then id_i = "
                                  "id_j, and the normal is from the wall to the rod; -1: no wall, two rods",
                                  ""},
                                 [](const Item& item) { return static_cast<double>(item.contact.wall); }});
    if (!scene.rods.fixed.empty())
        table.columns.push_back(
            {{"fixed", "1", "",
              "number of a fixed rod, from 0 in the order of its file; then id_i = id_j, the normal "
              "is from the fixed rod to the rod, and arm_i along the fixed rod; -1: none",
              ""},
             [](const Item& item) { return static_cast<double>(item.contact.fixed); }});
    table.columns.push_back(
        {{"arm_i", length, "s_i", "position of the contact along the first rod's axis, from its centre", ""}, arm(0)});
    table.columns.push_back(
        {{"arm_j", length, "s_j", "position of the contact along the second rod's axis, from its centre", ""}, arm(1)});
    return table;
}

TableRows contact_rows(const TableColumns<ContactState>& columns, const Simulation& simulation) {
    TableRows rows;
    std::vector<BodyIds> bodies;
    const auto& ids = simulation.contact_ids();
    const auto& gamma = simulation.contact_solution().gamma;
    for (const std::size_t l : order_of_ids(simulation.contacts(), ids, gamma)) {
        const Contact& contact = simulation.contacts().contact[l];
        if (!simulation.counts(l)) continue;
        bodies.push_back({id_of_body(contact.i, ids), ids[contact.j]});
        rows.push_back(columns.row(
            {simulation.clock(), contact_by_id(simulation, l), gamma[l], contact.gap, simulation.box().offset()}));
    }
    return at_first_rank(std::move(rows), std::move(bodies), columns.columns.size(), simulation.domain().ranks());
}

TableColumns<LineageState> lineage_columns(const Scene& scene) {
    using Item = LineageState;
    const std::string time = unit_of(scene, dimension::time), length = unit_of(scene, dimension::length);
    return {
        "lineage",
        {{{"step", "1", "k", number_of_steps, ""}, step_of<Item>},
         {{"time", time, "t", simulated_time, ""}, time_of<Item>},
         {{"birth", "1", "", "1: a cell was born; 0: it died", ""},
          [](const Item& item) { return item.event.kind == LineageEvent::Kind::birth ? 1.0 : 0.0; }},
         {{"id", "1", "i", "id of the cell", ""}, [](const Item& item) { return static_cast<double>(item.event.id); }},
         {{"mother", "1", "", "id of the cell that divided, and lives on behind it; of a death: its own id", ""},
          [](const Item& item) { return static_cast<double>(item.event.mother); }},
         {{"length", length, "L", "length of the cell then", ""}, [](const Item& item) { return item.event.length; }}}};
}

TableRows lineage_rows(const TableColumns<LineageState>& columns, const Simulation& simulation) {
    TableRows rows;
    for (const LineageEvent& event : simulation.lineage()) rows.push_back(columns.row({simulation.clock(), event}));
    return rows;
}

TableColumns<FieldState> field_columns(const Scene& scene) {
    using Item = FieldState;
    const std::string length = unit_of(scene, dimension::length), stress = unit_of_stress(scene);
    const char* sign = "positive in compression";
    TableColumns<Item> table{"field", {}};
    table.columns = {
        {{"step", "1", "k", number_of_steps, ""}, step_of<Item>},
        {{"time", unit_of(scene, dimension::time), "t", simulated_time, ""}, time_of<Item>},
        {{"x", length, "", "centre of the cell; not a number: all that lies beyond open edges of the box", ""},
         [](const Item& item) { return item.centre.x; }},
        {{"y", length, "", "centre of the cell", ""}, [](const Item& item) { return item.centre.y; }},
        {{"z", length, "", "centre of the cell", ""}, [](const Item& item) { return item.centre.z; }},
        {{"number_density", unit_of_number_density(scene), "n",
          fmt::format("rods per {} in the cell, mean over the steps since the last field",
                      dimensions_of(scene) == 2 ? "area" : "volume"),
          ""},
         [](const Item& item) { return item.content.number_density; }}};
    table.add_elements(stress_column_names,
                       {"", stress, "Sigma_col",
                        "element of the collision stress in the cell (position, force), mean over the steps since the "
                        "last field",
                        sign},
                       [](const Item& item, std::size_t k) { return item.content.collision.m[k]; });
    table.add_elements(orientation_stress_column_names,
                       {"", stress, "Sigma_ori",
                        "element of the orientation stress in the cell, symmetric, mean over the steps since the last "
                        "field",
                        sign},
                       [](const Item& item, std::size_t k) { return upper_element(item.content.orientation, k); });
    return table;
}

TableRows field_rows(const TableColumns<FieldState>& columns, const Clock& clock, const StressField& field) {
    TableRows rows;
    for (std::size_t cell = 0; cell < field.size(); ++cell)
        rows.push_back(columns.row({clock, field.centre(cell), field.mean(cell)}));
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    if (field.has_outside()) rows.push_back(columns.row({clock, {nowhere, nowhere, nowhere}, field.outside_mean()}));
    return rows;
}

}  // namespace jostle
