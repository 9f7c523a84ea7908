#include "jostle/run_files/checkpoint_fields.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

namespace jostle {

namespace {

template <class Of>
void put_column(FieldWriter& writer, std::string_view name, const RodsInOrder& rods, bool have_it, const Of& of) {
    using Value = decltype(of(std::declval<const Rods&>(), std::uint32_t{}));
    if (!have_it) return writer.put_text(name, "");
    writer.put_pieces(name, rods.size() * sizeof(Value), [&rods, of](const FieldWriter::Sink& sink) {
        rods.column(of, [&](std::size_t before, std::span<const Value> values) {
            sink(before * sizeof(Value), bytes_of(values));
        });
    });
}

void put_rods(FieldWriter& writer, const RodsInOrder& rods) {
    const auto put = [&](std::string_view name, bool have_it, const auto& of) {
        put_column(writer, name, rods, have_it, of);
    };
    put("rods.centre", true, [](const Rods& of, std::uint32_t row) { return of.centre[row]; });
    put("rods.axis", true, [](const Rods& of, std::uint32_t row) { return of.axis[row]; });
    put("rods.length", true, [](const Rods& of, std::uint32_t row) { return of.length[row]; });
    put("rods.diameter", true, [](const Rods& of, std::uint32_t row) { return of.diameter[row]; });
    put("rods.id", true, [](const Rods& of, std::uint32_t row) { return of.id[row]; });
    put("rods.image", true, [](const Rods& of, std::uint32_t row) { return of.image[row]; });
    put("rods.speed", rods.have_speed(), [](const Rods& of, std::uint32_t row) { return of.speed[row]; });
    const auto put_cycle = [&](std::string_view name, auto CellCycle::*part) {
        put(name, rods.have_cycle(), [part](const Rods& of, std::uint32_t row) { return of.cycle[row].*part; });
    };
    put_cycle("rods.cycle.growth_rate", &CellCycle::growth_rate);
    put_cycle("rods.cycle.division_at", &CellCycle::division_at);
    put_cycle("rods.cycle.birth_step", &CellCycle::birth_step);
    put_cycle("rods.cycle.divisions", &CellCycle::divisions);
    put_cycle("rods.cycle.share", &CellCycle::share);
    writer.put("rods.founder_bits", static_cast<std::int32_t>(rods.founder_bits()));
}

Rods take_rods(FieldReader& reader) {
    Rods rods;
    rods.centre = reader.take_array<Vec3>("rods.centre");
    rods.axis = reader.take_array<Vec3>("rods.axis");
    rods.length = reader.take_array<double>("rods.length");
    rods.diameter = reader.take_array<double>("rods.diameter");
    rods.id = reader.take_array<std::uint64_t>("rods.id");
    rods.image = reader.take_array<Image>("rods.image");
    rods.speed = reader.take_array<double>("rods.speed");
    std::vector<CellCycle>& cycle = rods.cycle;
    cycle.resize(reader.length<double>("rods.cycle.growth_rate"));
    reader.take_column<double>("rods.cycle.growth_rate", cycle,
                               [](CellCycle& of, double value) { of.growth_rate = value; });
    reader.take_column<double>("rods.cycle.division_at", cycle,
                               [](CellCycle& of, double value) { of.division_at = value; });
    reader.take_column<std::uint64_t>("rods.cycle.birth_step", cycle,
                                      [](CellCycle& of, std::uint64_t value) { of.birth_step = value; });
    reader.take_column<std::uint64_t>("rods.cycle.divisions", cycle,
                                      [](CellCycle& of, std::uint64_t value) { of.divisions = value; });
    reader.take_column<double>("rods.cycle.share", cycle, [](CellCycle& of, double value) { of.share = value; });
    rods.founder_bits = reader.take<std::int32_t>("rods.founder_bits");
    const std::size_t count = rods.id.size();
    for (const std::size_t other :
         {rods.centre.size(), rods.axis.size(), rods.length.size(), rods.diameter.size(), rods.image.size()})
        if (other != count) throw std::out_of_range("its arrays of rods differ in length");
    for (const std::size_t other : {rods.speed.size(), cycle.size()})
        if (other != 0 && other != count) throw std::out_of_range("its arrays of rods differ in length");
    if (rods.founder_bits < 0 || rods.founder_bits > 53) throw std::out_of_range("ids of cells out of range");
    return rods;
}

void put_springs(FieldWriter& writer, const std::vector<Spring>& springs) {
    writer.put_column("springs.rod_1", springs, [](const Spring& spring) { return spring.rod_1; });
    writer.put_column("springs.rod_2", springs, [](const Spring& spring) { return spring.rod_2; });
    writer.put_column("springs.s_1", springs, [](const Spring& spring) { return spring.s_1; });
    writer.put_column("springs.s_2", springs, [](const Spring& spring) { return spring.s_2; });
    writer.put_column("springs.rest_length", springs, [](const Spring& spring) { return spring.rest_length; });
    writer.put_column("springs.stiffness", springs, [](const Spring& spring) { return spring.stiffness; });
    writer.put_column("springs.image", springs, [](const Spring& spring) { return spring.image; });
}

std::vector<Spring> take_springs(FieldReader& reader) {
    std::vector<Spring> springs(reader.length<std::uint64_t>("springs.rod_1"));
    reader.take_column<std::uint64_t>("springs.rod_1", springs,
                                      [](Spring& of, std::uint64_t value) { of.rod_1 = value; });
    reader.take_column<std::uint64_t>("springs.rod_2", springs,
                                      [](Spring& of, std::uint64_t value) { of.rod_2 = value; });
    reader.take_column<double>("springs.s_1", springs, [](Spring& of, double value) { of.s_1 = value; });
    reader.take_column<double>("springs.s_2", springs, [](Spring& of, double value) { of.s_2 = value; });
    reader.take_column<double>("springs.rest_length", springs,
                               [](Spring& of, double value) { of.rest_length = value; });
    reader.take_column<double>("springs.stiffness", springs, [](Spring& of, double value) { of.stiffness = value; });
    reader.take_column<Image>("springs.image", springs, [](Spring& of, const Image& value) { of.image = value; });
    return springs;
}

void put_forces(FieldWriter& writer, const std::vector<PreviousForce>& forces) {
    writer.put_column("forces.i", forces, [](const PreviousForce& force) { return force.i; });
    writer.put_column("forces.j", forces, [](const PreviousForce& force) { return force.j; });
    writer.put_column("forces.feature", forces,
                      [](const PreviousForce& force) { return static_cast<std::uint8_t>(force.feature); });
    writer.put_column("forces.upper", forces,
                      [](const PreviousForce& force) { return static_cast<std::uint8_t>(force.upper); });
    writer.put_column("forces.gamma", forces, [](const PreviousForce& force) { return force.gamma; });
}

std::vector<PreviousForce> take_forces(FieldReader& reader) {
    std::vector<PreviousForce> forces(reader.length<std::uint64_t>("forces.i"));
    reader.take_column<std::uint64_t>("forces.i", forces, [](PreviousForce& of, std::uint64_t value) { of.i = value; });
    reader.take_column<std::uint64_t>("forces.j", forces, [](PreviousForce& of, std::uint64_t value) { of.j = value; });
    reader.take_column<std::uint8_t>("forces.feature", forces, [](PreviousForce& of, std::uint8_t value) {
        if (value > static_cast<std::uint8_t>(ContactFeature::end_of_j))
            throw std::out_of_range("a contact force of no such contact");
        of.feature = static_cast<ContactFeature>(value);
    });
    reader.take_column<std::uint8_t>("forces.upper", forces,
                                     [](PreviousForce& of, std::uint8_t value) { of.upper = value != 0; });
    reader.take_column<double>("forces.gamma", forces, [](PreviousForce& of, double value) { of.gamma = value; });
    for (const PreviousForce& force : forces)
        if (force.i > force.j && !is_id_of_fixed(force.i)) throw std::out_of_range("a contact force that is none");
    return forces;
}

void put_walls(FieldWriter& writer, const Walls& walls) {
    if (!walls.any()) return;
    writer.put("walls.faces", std::array<std::uint8_t, 3>{walls.faces[0], walls.faces[1], walls.faces[2]});
    writer.put("walls.container", static_cast<std::uint8_t>(walls.container));
    writer.put("walls.axis", static_cast<std::uint8_t>(walls.axis));
    writer.put("walls.turn_rods", static_cast<std::uint8_t>(walls.turn_rods));
}

Walls take_walls(FieldReader& reader) {
    Walls walls;
    if (reader.names_after("walls.").empty()) return walls;
    const auto faces = reader.take<std::array<std::uint8_t, 3>>("walls.faces");
    for (std::size_t k = 0; k < 3; ++k) walls.faces[k] = faces[k] != 0;
    const auto container = reader.take<std::uint8_t>("walls.container"), axis = reader.take<std::uint8_t>("walls.axis");
    if (container > static_cast<std::uint8_t>(Container::tube) || axis > 2)
        throw std::out_of_range("walls that are none");
    walls.container = static_cast<Container>(container);
    walls.axis = axis;
    walls.turn_rods = reader.take<std::uint8_t>("walls.turn_rods") != 0;
    return walls;
}

void put_fixed_rods(FieldWriter& writer, const Box& box) {
    if (!box.fixed_rods()) return;
    const Rods& fixed = *box.fixed_rods();
    writer.put_array("fixed.centre", fixed.centre);
    writer.put_array("fixed.axis", fixed.axis);
    writer.put_array("fixed.length", fixed.length);
    writer.put_array("fixed.diameter", fixed.diameter);
}

std::shared_ptr<const Rods> take_fixed_rods(FieldReader& reader) {
    if (reader.names_after("fixed.").empty()) return nullptr;
    const auto centre = reader.take_array<Vec3>("fixed.centre"), axis = reader.take_array<Vec3>("fixed.axis");
    const auto length = reader.take_array<double>("fixed.length"),
               diameter = reader.take_array<double>("fixed.diameter");
    if (axis.size() != centre.size() || length.size() != centre.size() || diameter.size() != centre.size())
        throw std::out_of_range("fixed rods of unequal columns");
    Rods fixed;
    for (std::size_t f = 0; f < centre.size(); ++f) fixed.push_back(f, centre[f], axis[f], length[f], diameter[f]);
    return std::make_shared<const Rods>(std::move(fixed));
}

}  // namespace

FieldWriter fields_of(const Checkpoint& checkpoint, const RodsInOrder& rods) {
    FieldWriter writer;
    writer.put_text("scene", checkpoint.scene);
    writer.put("step", checkpoint.state.clock.step);
    writer.put("time", checkpoint.state.clock.time);
    writer.put("box.edges", checkpoint.state.box.edges());
    std::array<std::uint8_t, 3> periodic{};
    std::copy(checkpoint.state.box.periodic().begin(), checkpoint.state.box.periodic().end(), periodic.begin());
    writer.put("box.periodic", periodic);
    if (checkpoint.state.box.offset() != 0.0) writer.put("box.offset", checkpoint.state.box.offset());
    put_walls(writer, checkpoint.state.box.walls());
    put_fixed_rods(writer, checkpoint.state.box);
    if (checkpoint.state.box_force) writer.put("box.force", *checkpoint.state.box_force);
    put_rods(writer, rods);
    put_springs(writer, checkpoint.state.springs);
    put_forces(writer, checkpoint.state.previous_forces);
    for (const auto& [name, values] : checkpoint.sums) writer.put_array("sums." + name, values);
    for (const auto& [name, position] : checkpoint.files)
        writer.put("files." + name, std::array{position.bytes, position.hash});
    return writer;
}

Checkpoint checkpoint_of_fields(std::string_view payload) {
    FieldReader reader(payload);
    Checkpoint checkpoint;
    checkpoint.scene = reader.take_text("scene");
    checkpoint.state.clock.step = reader.take<std::uint64_t>("step");
    checkpoint.state.clock.time = reader.take<double>("time");
    const Vec3 edges = reader.take<Vec3>("box.edges");
    const auto periodic = reader.take<std::array<std::uint8_t, 3>>("box.periodic");
    checkpoint.state.box = Box(edges, {periodic[0] != 0, periodic[1] != 0, periodic[2] != 0}, take_walls(reader))
                               .with_fixed_rods(take_fixed_rods(reader));
    if (!reader.names_after("box.offset").empty())
        checkpoint.state.box = checkpoint.state.box.sheared(reader.take<double>("box.offset"));
    if (const auto names = reader.names_after("box."); std::find(names.begin(), names.end(), "force") != names.end())
        checkpoint.state.box_force = reader.take<Vec3>("box.force");
    checkpoint.state.rods = take_rods(reader);
    checkpoint.state.springs = take_springs(reader);
    checkpoint.state.previous_forces = take_forces(reader);
    for (const std::string& name : reader.names_after("sums."))
        checkpoint.sums[name] = reader.take_array<double>("sums." + name);
    for (const std::string& name : reader.names_after("files.")) {
        if (name.find('/') != std::string::npos) throw std::out_of_range("a file of it lies elsewhere");
        const auto [bytes, hash] = reader.take<std::array<std::uint64_t, 2>>("files." + name);
        checkpoint.files[name] = {bytes, hash};
    }
    reader.require_all_taken();
    return checkpoint;
}

}  // namespace jostle
