#include "jostle/tables/body_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/error/nearest_word.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/stress/shape_moments.hpp"
#include "jostle/tables/whole_number.hpp"

namespace jostle {

namespace {

const std::vector<std::string> centre_columns = {"x", "y", "z"};
const std::vector<std::string> quaternion_columns = {"quaternion_w", "quaternion_x", "quaternion_y", "quaternion_z"};
const std::vector<std::string> shapes = {"sphere", "spherocylinder", "box", "ellipsoid"};

KnownColumns body_columns() {
    KnownColumns known{{"id", "length", "diameter"}, {"shape"}};
    for (const auto& columns :
         {centre_columns, tensor_columns("second_moment"), tensor_columns("inertia"), vector_columns("axis"),
          vector_columns("edge"), vector_columns("semi_axis"), quaternion_columns})
        known.numbers.insert(known.numbers.end(), columns.begin(), columns.end());
    return known;
}

/// The numbers of one row, and what it lacks told as InputError.
class Row {
public:
    Row(const Table& table, std::size_t row) : table_(table), row_(row) {}

    bool gives(const std::string& name) const {
        return table_.numbers.contains(name) && !std::isnan(table_.numbers.at(name)[row_]);
    }
    bool gives_any(const std::vector<std::string>& columns) const {
        return std::ranges::any_of(columns, [this](const std::string& name) { return gives(name); });
    }
    double number(const std::string& name) const { return numbers({name})[0]; }
    Vec3 vector(const std::string& name) const {
        const auto values = numbers(vector_columns(name));
        return {values[0], values[1], values[2]};
    }
    std::vector<double> numbers(const std::vector<std::string>& columns) const {
        if (!std::ranges::all_of(columns, [this](const std::string& name) { return gives(name); }))
            throw InputError({.problem = fmt::format("{}{} not given", gives_any(columns) ? "some of " : "",
                                                     fmt::join(columns, ", "))});
        std::vector<double> values;
        for (const std::string& name : columns) values.push_back(table_.numbers.at(name)[row_]);
        return values;
    }
    const std::string& word(const std::string& name) const { return table_.words.at(name)[row_]; }

private:
    const Table& table_;
    std::size_t row_;
};

Mat3 symmetric(const Row& row, const std::string& name) {
    const auto v = row.numbers(tensor_columns(name));
    return {{v[0], v[1], v[2], v[1], v[3], v[4], v[2], v[4], v[5]}};
}

Mat3 orientation_of(const Row& row) {
    if (!row.gives_any(quaternion_columns)) return identity();
    const auto q = row.numbers(quaternion_columns);
    if (!(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-24))
        throw InputError({.problem = "the quaternion has no length"});
    return rotation_of_quaternion(q[0], q[1], q[2], q[3]);
}

Vec3 axis_of(const Row& row) {
    if (!row.gives_any(vector_columns("axis")) && row.gives_any(quaternion_columns))
        return orientation_of(row) * Vec3{0, 0, 1};
    const Vec3 axis = row.vector("axis");
    if (!(norm(axis) > 1e-12)) throw InputError({.problem = "the axis has no direction"});
    return normalised(axis);
}

Mat3 of_shape(const Row& row) {
    const std::string& shape = row.word("shape");
    if (shape == "sphere") return sphere_moments(row.number("diameter")).second_moment;
    if (shape == "spherocylinder")
        return spherocylinder_moments(axis_of(row), row.number("length"), row.number("diameter")).second_moment;
    if (shape == "box") return box_moments(row.vector("edge"), orientation_of(row)).second_moment;
    if (shape == "ellipsoid") return ellipsoid_moments(row.vector("semi_axis"), orientation_of(row)).second_moment;
    throw InputError({.key = "shape",
                      .value = "\"" + on_one_line(shape) + "\"",
                      .problem = "is no shape that is known",
                      .allowed = quoted_list(shapes),
                      .suggestion = did_you_mean(shape, shapes)});
}

enum class BodyForm { second_moment, inertia, shape };

BodyForm body_form_of(const Table& table) {
    const bool second_moment = table.has_all(tensor_columns("second_moment"));
    const bool inertia = table.has_all(tensor_columns("inertia"));
    const int forms = int{second_moment} + int{inertia} + int{table.has("shape")};
    if (forms != 1)
        throw refused_file(
            table.path, forms == 0 ? "nothing says what the bodies are" : "says twice what the bodies are",
            fmt::format("Give one of second_moment_xx ... second_moment_zz, inertia_xx ... inertia_zz, or "
                        "shape with its sizes; the file has {}",
                        quoted_list(table.names)));
    return second_moment ? BodyForm::second_moment : inertia ? BodyForm::inertia : BodyForm::shape;
}

Mat3 second_moment_of(const Row& row, BodyForm form) {
    if (form == BodyForm::shape) return of_shape(row);
    if (form == BodyForm::inertia) return second_moment_of_inertia(symmetric(row, "inertia"));
    const Mat3 moment = symmetric(row, "second_moment");
    geometric_stress(moment, Vec3{});  // throws where it is none
    return moment;
}

/// Adds the body of a row of the table. Throws InputError, without a place, if it cannot be taken.
void add_body(BodyTable& result, const Table& table, std::size_t k, BodyForm form) {
    const Row row(table, k);
    const std::int64_t id = whole_number("id", row.number("id"));
    const auto centre = row.numbers(centre_columns);
    const RigidBody body = {{centre[0], centre[1], centre[2]}, second_moment_of(row, form)};
    if (!result.row_of.try_emplace(id, static_cast<std::uint32_t>(result.id.size())).second) {
        const std::vector<double>& ids = table.numbers.at("id");
        const auto first = std::find(ids.begin(), ids.end(), static_cast<double>(id)) - ids.begin();
        throw InputError({.problem = fmt::format("the id {} stands in {} already", id,
                                                 table.problems.name_of(static_cast<std::size_t>(first)))});
    }
    result.id.push_back(id);
    result.bodies.push_back(body);
}

}  // namespace

BodyTable read_bodies(const std::string& path) {
    const KnownColumns known = body_columns();
    Table table = read_table(path, known);
    table.require({"id", "x", "y", "z"});
    const BodyForm form = body_form_of(table);
    if (table.rows == 0) throw refused_file(path, "the file holds no bodies", "");
    table.require_filled({"id", "x", "y", "z"});
    BodyTable result;
    result.units = table.units;
    result.passed_over = table.passed_over(known);
    for (std::size_t k = 0; k < table.rows; ++k) {
        if (table.problems.has(k)) continue;
        try {
            add_body(result, table, k, form);
        } catch (const InputError& error) {
            table.problems.add(k, error.what());
        }
    }
    table.problems.throw_if_any();
    return result;
}

}  // namespace jostle
