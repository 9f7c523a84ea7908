#include <fmt/format.h>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/contact/contact_matrix.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/stress/collision_stress.hpp"
#include "jostle/stress/contact_stress.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/rigid_body_stress.hpp"

namespace jostle::python {

namespace {

/// The error of a pair, with the number of its row.
[[noreturn]] void refuse_row(const InputError& error, std::size_t row) {
    InputError::Parts parts = error.parts();
    parts.key += fmt::format(" (row {})", row);
    throw InputError(parts);
}

py::tuple pair_stress_of_rows(const Numbers& centre_1, const Numbers& second_moment_1, const Numbers& centre_2,
                              const Numbers& second_moment_2, const Numbers& point_1, const Numbers& point_2,
                              const Numbers& force) {
    const auto r_1 = vectors_in(centre_1, "centre_1"), r_2 = vectors_in(centre_2, "centre_2");
    const auto n_1 = matrices_in(second_moment_1, "second_moment_1");
    const auto n_2 = matrices_in(second_moment_2, "second_moment_2");
    const auto x_1 = vectors_in(point_1, "point_1"), x_2 = vectors_in(point_2, "point_2");
    const auto f = vectors_in(force, "force");
    for (const Numbers* other : {&second_moment_1, &centre_2, &second_moment_2, &point_1, &point_2, &force})
        if (other->shape(0) != centre_1.shape(0)) require_shape(*other, {centre_1.shape(0), -1}, "a row for each pair");
    std::vector<Mat3> virial(f.size()), geometric_1(f.size()), geometric_2(f.size());
    {
        const py::gil_scoped_release release;
        for (std::size_t k = 0; k < f.size(); ++k) try {
                const PairStress stress = pair_stress({r_1[k], n_1[k]}, {r_2[k], n_2[k]}, x_1[k], x_2[k], f[k]);
                virial[k] = stress.centre_of_mass_virial;
                geometric_1[k] = stress.geometric_1;
                geometric_2[k] = stress.geometric_2;
            } catch (const InputError& error) {
                refuse_row(error, k);
            }
    }
    return py::make_tuple(array_of(std::span<const Mat3>(virial)), array_of(std::span<const Mat3>(geometric_1)),
                          array_of(std::span<const Mat3>(geometric_2)));
}

/// A row of the rods or bodies, as contact l names it.
std::uint32_t row_in(std::int64_t row, std::size_t l, std::size_t count) {
    if (row >= 0 && row < static_cast<std::int64_t>(count)) return static_cast<std::uint32_t>(row);
    throw InputError({.key = fmt::format("contacts (row {})", l),
                      .value = std::to_string(row),
                      .problem = "is no row of the bodies",
                      .allowed = fmt::format("0 to {}", static_cast<std::int64_t>(count) - 1)});
}

/// Contacts from columns.
Contacts contacts_of(const Indices& i, const Indices& j, const Numbers& normal, const Numbers& arm_i,
                     const Numbers& arm_j, const Numbers& gap, std::size_t rods) {
    const auto rows_i = indices_in(i, "i"), rows_j = indices_in(j, "j");
    const auto normals = vectors_in(normal, "normal");
    const auto arms_i = numbers_in(arm_i, "arm_i"), arms_j = numbers_in(arm_j, "arm_j"), gaps = numbers_in(gap, "gap");
    Contacts contacts;
    for (std::size_t l = 0; l < rows_i.size(); ++l)
        contacts.push_back(
            {row_in(rows_i[l], l, rods), row_in(rows_j[l], l, rods), normals[l], arms_i[l], arms_j[l], gaps[l], 0.0},
            {}, ContactFeature::nearest);
    return contacts;
}

/// Rods of given directions and sizes; where they are is left out.
Rods rods_of(const Numbers& axis, const Numbers& length, const Numbers& diameter) {
    const auto axes = vectors_in(axis, "axis");
    const auto lengths = numbers_in(length, "length"), diameters = numbers_in(diameter, "diameter");
    require_shape(length, {axis.shape(0)}, "length");
    require_shape(diameter, {axis.shape(0)}, "diameter");
    Rods rods;
    for (std::size_t k = 0; k < axes.size(); ++k) rods.push_back(k, {}, axes[k], lengths[k], diameters[k]);
    return rods;
}

py::array sum_over_rods(const Numbers& axis, const Numbers& length, const Numbers& diameter, double kT,
                        int dimensions) {
    return array_of(sum_of_orientation_stresses(rods_of(axis, length, diameter), kT, dimensions));
}

/// Sum of the pair stresses of rods, as the step of a simulation takes it.
py::array sum_over_contacts(const Numbers& axis, const Numbers& length, const Numbers& diameter, const Indices& i,
                            const Indices& j, const Numbers& normal, const Numbers& arm_i, const Numbers& arm_j,
                            const Numbers& gap, const Numbers& force, bool touching) {
    for (const py::array* column : std::initializer_list<const py::array*>{&j, &arm_i, &arm_j, &gap, &force})
        require_shape(*column, {i.shape(0)}, "a value for each contact");
    require_shape(normal, {i.shape(0), 3}, "normal");
    const Rods rods = rods_of(axis, length, diameter);
    const Contacts contacts = contacts_of(i, j, normal, arm_i, arm_j, gap, rods.size());
    const py::gil_scoped_release release;
    const ContactMatrix matrix(contacts, rods.id);
    std::vector<ContactForce> forces(matrix.rods().size());
    matrix.apply(numbers_in(force, "force"), forces);
    std::vector<Vec3> torques(forces.size());
    for (std::size_t local = 0; local < forces.size(); ++local)
        torques[local] = cross(rods.axis[matrix.rods()[local]], forces[local].moment);
    const Mat3 sum =
        sum_of_pair_stresses(contacts, numbers_in(force, "force"), rods, rods.axis, {matrix.rods(), torques},
                             touching ? ContactDistance::touching : ContactDistance::at_start);
    const py::gil_scoped_acquire acquire;
    return array_of(sum);
}

StressConvention convention_named(const std::string& word) {
    if (word == "rigid_body") return StressConvention::rigid_body;
    if (word == "centre_line") return StressConvention::centre_line;
    if (word == "centre_of_mass_virial") return StressConvention::centre_of_mass_virial;
    throw InputError({.key = "convention",
                      .value = "\"" + word + "\"",
                      .problem = "is unknown",
                      .allowed = "\"rigid_body\", \"centre_line\", \"centre_of_mass_virial\""});
}

/// (virial, geometric, per body) of a list of contacts.
py::tuple stress_of_contacts(const Numbers& second_moment, const Indices& body_1, const Indices& body_2,
                             const Numbers& separation, const Numbers& point_1, const Numbers& point_2,
                             const Numbers& force, const std::string& convention) {
    const auto second_moments = matrices_in(second_moment, "second_moment");
    const auto first = indices_in(body_1, "body_1"), second = indices_in(body_2, "body_2");
    for (const Numbers* other : {&separation, &point_1, &point_2, &force})
        require_shape(*other, {body_1.shape(0), 3}, "a vector for each contact");
    require_shape(body_2, {body_1.shape(0)}, "body_2");
    const auto separations = vectors_in(separation, "separation"), forces = vectors_in(force, "force");
    const auto points_1 = vectors_in(point_1, "point_1"), points_2 = vectors_in(point_2, "point_2");
    std::vector<BodyContact> contacts;
    for (std::size_t l = 0; l < forces.size(); ++l)
        contacts.push_back({row_in(first[l], l, second_moments.size()), row_in(second[l], l, second_moments.size()),
                            separations[l], points_1[l], points_2[l], forces[l]});
    ContactStress stress;
    {
        const py::gil_scoped_release release;
        stress = contact_stress(second_moments, contacts, convention_named(convention));
    }
    return py::make_tuple(array_of(stress.virial), array_of(stress.geometric),
                          array_of(std::span<const Mat3>(stress.per_body)));
}

}  // namespace

void bind_stress(py::module_& module) {
    module.def("pair_stress", &pair_stress_of_rows);
    module.def("sum_over_contacts", &sum_over_contacts);
    module.def("sum_over_rods", &sum_over_rods);
    module.def("contact_stress", &stress_of_contacts);
}

}  // namespace jostle::python
