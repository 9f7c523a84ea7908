#include "jostle/stress/body_moments.hpp"

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/stress/mesh_moments.hpp"
#include "jostle/stress/shape_moments.hpp"

namespace jostle::python {

namespace {

Vec3 vector_in(const Numbers& array, const std::string& name) {
    require_shape(array, {3}, name);
    return {array.at(0), array.at(1), array.at(2)};
}

Mat3 matrix_in(const Numbers& array, const std::string& name) {
    require_shape(array, {3, 3}, name);
    Mat3 matrix;
    std::copy_n(array.data(), 9, matrix.m.begin());
    return matrix;
}

/// (mass, centre, second moment)
py::tuple shown(const BodyMoments& body) {
    return py::make_tuple(body.mass, array_of(body.centre), array_of(body.second_moment));
}

BodyMoments body_in(double mass, const Numbers& centre, const Numbers& second_moment) {
    return {mass, vector_in(centre, "centre"), matrix_in(second_moment, "second_moment")};
}

py::tuple moments_of_mesh(const Numbers& vertices, const Indices& triangles) {
    require_shape(triangles, {-1, 3}, "triangles");
    const auto corners = vectors_in(vertices, "vertices");
    std::vector<Triangle> faces(static_cast<std::size_t>(triangles.shape(0)));
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t vertex = triangles.data()[3 * k + a];
            if (vertex < 0 || vertex >= static_cast<std::int64_t>(corners.size()))
                throw InputError({.key = "triangles (row " + std::to_string(k) + ")",
                                  .value = std::to_string(vertex),
                                  .problem = "is no row of the vertices",
                                  .allowed = "0 to " + std::to_string(corners.size() - 1)});
            faces[k][a] = static_cast<std::uint32_t>(vertex);
        }
    return shown(mesh_moments(corners, faces));
}

py::tuple moments_of_parts(const Numbers& masses, const Numbers& centres, const Numbers& second_moments) {
    const auto mass = numbers_in(masses, "mass");
    require_shape(centres, {masses.shape(0), 3}, "centre");
    require_shape(second_moments, {masses.shape(0), 3, 3}, "second_moment");
    const auto centre = vectors_in(centres, "centre");
    const auto second_moment = matrices_in(second_moments, "second_moment");
    std::vector<BodyMoments> parts;
    for (std::size_t k = 0; k < mass.size(); ++k) parts.push_back({mass[k], centre[k], second_moment[k]});
    return shown(combined(parts));
}

}  // namespace

void bind_body_moments(py::module_& module) {
    module.def("sphere_moments", [](double diameter) { return shown(sphere_moments(diameter)); });
    module.def("spherocylinder_moments", [](const Numbers& axis, double length, double diameter) {
        return shown(spherocylinder_moments(vector_in(axis, "axis"), length, diameter));
    });
    module.def("box_moments", [](const Numbers& edges, const Numbers& orientation) {
        return shown(box_moments(vector_in(edges, "edges"), matrix_in(orientation, "orientation")));
    });
    module.def("ellipsoid_moments", [](const Numbers& semi_axes, const Numbers& orientation) {
        return shown(ellipsoid_moments(vector_in(semi_axes, "semi_axes"), matrix_in(orientation, "orientation")));
    });
    module.def("mesh_moments", &moments_of_mesh);
    module.def("convex_hull_moments",
               [](const Numbers& points) { return shown(convex_hull_moments(vectors_in(points, "points"))); });
    module.def("point_moments", [](const Numbers& points, const Numbers& weights) {
        return shown(point_moments(vectors_in(points, "points"), numbers_in(weights, "weights")));
    });
    module.def("clump_moments", [](const Numbers& centres, const Numbers& diameters) {
        return shown(clump_moments(vectors_in(centres, "centres"), numbers_in(diameters, "diameters")));
    });
    module.def("combined", &moments_of_parts);
    module.def("rotated",
               [](double mass, const Numbers& centre, const Numbers& second_moment, const Numbers& rotation) {
                   return shown(rotated(body_in(mass, centre, second_moment), matrix_in(rotation, "rotation")));
               });
    module.def("with_density", [](double mass, const Numbers& centre, const Numbers& second_moment, double density) {
        return shown(with_density(body_in(mass, centre, second_moment), density));
    });
    module.def("second_moment_of_inertia", [](const Numbers& inertia) {
        return array_of(second_moment_of_inertia(matrix_in(inertia, "inertia")));
    });
}

}  // namespace jostle::python
