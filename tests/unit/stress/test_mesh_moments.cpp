// Meshes and hulls against closed forms, and the meshes that are refused.

#include <doctest/doctest.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

BodyMoments moments_of(const Mesh& mesh) {
    return mesh_moments(mesh.vertices, mesh.triangles);
}

void check_equal(const BodyMoments& a, const BodyMoments& b) {
    CHECK(a.mass == doctest::Approx(b.mass).epsilon(1e-12));
    CHECK(norm(a.centre - b.centre) < 1e-12 * (1.0 + norm(b.centre)));
    CHECK(norm(a.second_moment - b.second_moment) < 1e-12 * norm(b.second_moment));
}

std::string refusal_of(const Mesh& mesh) {
    try {
        moments_of(mesh);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

bool says(const std::string& message, const char* words) {
    return message.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("box and tetrahedron: exact, wherever they stand") {
    check_equal(moments_of(cuboid({-0.5, -1, -1.5}, {0.5, 1, 1.5})), box_moments({1, 2, 3}));
    check_equal(moments_of(cuboid({7, 8, 9}, {8, 10, 12})), moved(box_moments({1, 2, 3}), {7.5, 9, 10.5}));
    const Mat3 second_moment = {
        {1.0 / 160, -1.0 / 480, -1.0 / 480, -1.0 / 480, 1.0 / 160, -1.0 / 480, -1.0 / 480, -1.0 / 480, 1.0 / 160}};
    check_equal(moments_of(corner_tetrahedron()), {1.0 / 6, {0.25, 0.25, 0.25}, second_moment});
}

TEST_CASE("turning and moving the mesh turns and moves the body") {
    std::mt19937_64 generator(31);
    MESSAGE("seed 31");
    for (int k = 0; k < 50; ++k) {
        const Mesh mesh = random_octahedron(generator);
        const Mat3 rotation = random_rotation(generator);
        const Vec3 place = random_vector(generator);
        Mesh there = mesh;
        for (Vec3& vertex : there.vertices) vertex = rotation * vertex + place;
        check_equal(moments_of(there), moved(rotated(moments_of(mesh), rotation), place));
    }
}

TEST_CASE("a hollow box: the inner surface, inside out, takes away") {
    Mesh hollow = cuboid({-1, -1, -1}, {1, 1, 1});
    const Mesh hole = cuboid({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    for (const Vec3& vertex : hole.vertices) hollow.vertices.push_back(vertex);
    for (const auto& [a, b, c] : hole.triangles) hollow.triangles.push_back({a + 8, c + 8, b + 8});
    check_equal(moments_of(hollow), {7.0, {}, (16.0 / 6.0 - 1.0 / 12.0) * identity()});
}

// Corners on the ellipsoid: the mesh lacks what is between its triangles and the surface, of order h^2. Cutting every
// triangle into four divides the error by 4; the next order, h^4, shifts that by about h^2.
TEST_CASE("a finely triangulated ellipsoid: error O(h^2)") {
    const Vec3 semi_axes = {1.0, 2.0, 0.5};
    const BodyMoments exact = ellipsoid_moments(semi_axes);
    double mass_error = 0.0, moment_error = 0.0;
    for (int levels = 3; levels <= 6; ++levels) {
        Mesh mesh = sphere_mesh(levels);
        for (Vec3& vertex : mesh.vertices)
            vertex = {semi_axes.x * vertex.x, semi_axes.y * vertex.y, semi_axes.z * vertex.z};
        const BodyMoments body = moments_of(mesh);
        const double mass = exact.mass - body.mass, moment = norm(exact.second_moment - body.second_moment);
        CHECK(mass > 0.0);
        const double h_squared = std::pow(0.25, levels - 1);
        if (mass_error > 0.0) {
            CHECK(mass_error / mass == doctest::Approx(4.0).epsilon(h_squared));
            CHECK(moment_error / moment == doctest::Approx(4.0).epsilon(h_squared));
        }
        mass_error = mass;
        moment_error = moment;
    }
    CHECK(mass_error < 1e-3 * exact.mass);
}

TEST_CASE("convex hulls: points inside and on the faces do not matter") {
    std::mt19937_64 generator(32);
    MESSAGE("seed 32");
    Mesh box = cuboid({-0.5, -1, -1.5}, {0.5, 1, 1.5});
    check_equal(convex_hull_moments(box.vertices), box_moments({1, 2, 3}));
    std::uniform_real_distribution<double> inside(-0.5, 0.5);
    for (int k = 0; k < 100; ++k) {
        const Vec3 point = {inside(generator), 2.0 * inside(generator), 3.0 * inside(generator)};
        box.vertices.push_back(point);
        box.vertices.push_back({0.5, point.y, point.z});
    }
    check_equal(convex_hull_moments(box.vertices), box_moments({1, 2, 3}));
    const Mesh sphere = sphere_mesh(3);
    check_equal(convex_hull_moments(sphere.vertices), moments_of(sphere));
    check_equal(convex_hull_moments(corner_tetrahedron().vertices), moments_of(corner_tetrahedron()));
}

TEST_CASE("meshes that enclose nothing well are refused, and the message says why") {
    const Mesh sound = cuboid({-0.5, -1, -1.5}, {0.5, 1, 1.5});
    Mesh mesh = sound;
    mesh.triangles.pop_back();
    CHECK(says(refusal_of(mesh), "the mesh is open: 3 edges"));
    mesh = sound;
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    CHECK(says(refusal_of(mesh), "inside out: its volume is -6"));
    mesh = sound;
    std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
    CHECK(says(refusal_of(mesh), "turned in opposite ways"));
    mesh = sound;
    mesh.triangles[0][0] = 8;
    CHECK(says(refusal_of(mesh), "there are 8 vertices"));
    mesh = sound;
    mesh.triangles[0][0] = mesh.triangles[0][1];
    CHECK(says(refusal_of(mesh), "names a vertex twice"));
    mesh = sound;
    mesh.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
    CHECK(says(refusal_of(mesh), "vertices[3]"));
    CHECK(says(refusal_of(mesh), "is not finite"));
    mesh = sound;
    for (Vec3& vertex : mesh.vertices) vertex.z = 0.3 * vertex.x + 0.7 * vertex.y;
    CHECK(says(refusal_of(mesh), "encloses nothing"));
    CHECK(says(refusal_of({{}, {}}), "there are none"));
    CHECK(says(refusal_of({sound.vertices, {}}), "encloses nothing"));
    CHECK(moments_of(cuboid({0, 0, 0}, {1, 1, 1e-9})).mass == doctest::Approx(1e-9));  // a thin plate is a body
}

TEST_CASE("points without a convex hull are refused") {
    const std::vector<Vec3> flat = {{0, 0, 0}, {1, 0, 0.3}, {0, 1, 0.7}, {1, 1, 1.0}, {0.3, 0.2, 0.23}};
    CHECK_THROWS_AS(convex_hull_moments(flat), InputError);
    CHECK_THROWS_AS(convex_hull_moments(std::span(flat).first(3)), InputError);
    CHECK_THROWS_AS(convex_hull_moments({}), InputError);
    const std::vector<Vec3> one_place(8, Vec3{1, 2, 3});
    CHECK_THROWS_AS(convex_hull_moments(one_place), InputError);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(convex_hull_moments(std::array{Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, nan}}), InputError);
}
