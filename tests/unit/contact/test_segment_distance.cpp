#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "jostle/contact/segment_distance.hpp"

using namespace jostle;

namespace {

struct Segment {
    Vec3 centre;
    Vec3 axis;
    double half_length = 0.0;
};

NearestPoints nearest(const Segment& i, const Segment& j) {
    return nearest_points(j.centre - i.centre, i.axis, i.half_length, j.axis, j.half_length);
}

Segment from_ends(const Vec3& start, const Vec3& end) {
    const Vec3 along = end - start;
    const double length = norm(along);
    return {0.5 * (start + end), length > 0.0 ? along / length : Vec3{0, 0, 1}, 0.5 * length};
}

struct Case {
    std::array<double, 12> ends{};
    double distance = 0.0;
    std::string kind;
};

std::vector<Case> read_cases() {
    std::ifstream file(JOSTLE_TEST_SOURCES "/unit/contact/segment_distance_cases.csv");
    std::vector<Case> cases;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        std::string field;
        Case one;
        for (double& value : one.ends) {
            std::getline(fields, field, ',');
            value = std::stod(field);
        }
        std::getline(fields, field, ',');
        one.distance = std::stod(field);
        std::getline(fields, one.kind);
        cases.push_back(one);
    }
    return cases;
}

// The independent answer: the smallest of five distances of a point of one segment from the other segment. The points
// are the four ends and the point of i where the lines are nearest; one of them is a minimum of a convex function over
// a rectangle. In long double, by another formula.
using Wide = std::array<long double, 3>;

Wide wide(const Vec3& a) {
    return {a.x, a.y, a.z};
}
Wide combined(const Wide& a, long double s, const Wide& b) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
long double product(const Wide& a, const Wide& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Wide crossed(const Wide& a, const Wide& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

long double end_distance(const Wide& point, const Wide& axis, long double half_length) {
    const long double s = std::clamp(product(point, axis) / product(axis, axis), -half_length, half_length);
    const Wide rest = combined(point, -s, axis);
    return std::sqrt(product(rest, rest));
}

long double reference_distance(const Segment& i, const Segment& j) {
    const Wide d = wide(j.centre - i.centre), u = wide(i.axis), v = wide(j.axis);
    const Wide minus_d = {-d[0], -d[1], -d[2]};
    const long double h = i.half_length, k = j.half_length;
    long double smallest = end_distance(combined(d, k, v), u, h);
    smallest = std::min(smallest, end_distance(combined(d, -k, v), u, h));
    smallest = std::min(smallest, end_distance(combined(minus_d, h, u), v, k));
    smallest = std::min(smallest, end_distance(combined(minus_d, -h, u), v, k));
    const Wide w = crossed(u, v);
    const long double w_squared = product(w, w);
    if (w_squared > 0.0L) {
        const long double s = std::clamp(product(crossed(d, v), w) / w_squared, -h, h);
        smallest = std::min(smallest, end_distance(combined(minus_d, s, u), v, k));
    }
    return smallest;
}

struct RandomSegments {
    std::mt19937_64 generator;
    std::normal_distribution<double> normal{};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};

    Vec3 vector() { return {normal(generator), normal(generator), normal(generator)}; }
    Vec3 direction() { return normalised(vector()); }
    double half_length() { return uniform(generator) < 0.1 ? 0.0 : std::pow(10.0, 2.0 * uniform(generator) - 1.0); }

    double signed_fraction() { return 2.0 * uniform(generator) - 1.0; }

    /// A pair of any mutual angle: every third nearly parallel, with sines from 1e-16 to 1.
    std::array<Segment, 2> pair() {
        Segment i{{}, direction(), half_length()};
        Segment j{3.0 * vector(), direction(), half_length()};
        const double choice = uniform(generator);
        if (choice < 0.33) {
            const double sine = std::pow(10.0, -16.0 * uniform(generator));
            j.axis = normalised((choice < 0.16 ? 1.0 : -1.0) * i.axis + sine * j.axis);
        }
        if (uniform(generator) < 0.5) {  // crossing within both, or missing by a hair
            const double s_i = signed_fraction() * i.half_length, s_j = signed_fraction() * j.half_length;
            j.centre = s_i * i.axis - s_j * j.axis + (uniform(generator) < 0.5 ? 0.0 : 1e-9) * vector();
        }
        return {i, j};
    }
};

void check_consistent(const Segment& i, const Segment& j, const NearestPoints& found) {
    CHECK(std::fabs(found.s_i) <= i.half_length);
    CHECK(std::fabs(found.s_j) <= j.half_length);
    const Vec3 expected = j.centre - i.centre + found.s_j * j.axis - found.s_i * i.axis;
    CHECK(norm(found.separation - expected) <= 1e-15 * (norm(j.centre - i.centre) + i.half_length + j.half_length));
}

}  // namespace

TEST_CASE("the 250 reference cases: distance within 1e-12 of the coordinates' scale") {
    const auto cases = read_cases();
    REQUIRE(cases.size() == 250);
    double worst = 0.0;
    for (const Case& one : cases) {
        CAPTURE(one.kind);
        const auto& e = one.ends;
        const Segment i = from_ends({e[0], e[1], e[2]}, {e[3], e[4], e[5]});
        const Segment j = from_ends({e[6], e[7], e[8]}, {e[9], e[10], e[11]});
        double scale = 0.0;
        for (double value : e) scale = std::max(scale, std::fabs(value));
        const NearestPoints found = nearest(i, j);
        check_consistent(i, j, found);
        const double error = std::fabs(norm(found.separation) - one.distance) / scale;
        CHECK(error <= 1e-12);
        worst = std::max(worst, error);
    }
    MESSAGE("largest error in units of the coordinates' scale: " << worst);
}

TEST_CASE("random pairs agree with an exhaustive search in long double, and with themselves mirrored") {
    constexpr std::uint64_t seed = 20190214;
    CAPTURE(seed);
    RandomSegments random{std::mt19937_64(seed)};
    double worst = 0.0;
    for (int k = 0; k < 50000; ++k) {
        const auto [i, j] = random.pair();
        const NearestPoints found = nearest(i, j), mirrored = nearest(j, i);
        const double scale = norm(j.centre) + i.half_length + j.half_length;
        const auto exact = static_cast<double>(reference_distance(i, j));
        const double error = std::fabs(norm(found.separation) - exact);
        if (scale > 0.0) worst = std::max(worst, error / scale);
        if (!(error <= 1e-13 * scale))
            FAIL_CHECK("pair " << k << ": distance " << norm(found.separation) << ", exact " << exact);
        if (std::fabs(found.s_i) > i.half_length || std::fabs(found.s_j) > j.half_length) FAIL_CHECK("beyond an end");
        // Rounding of the axes moves the points by 1/sine^2: that much of the mirrored answer is not determined.
        const double sine = norm(cross(i.axis, j.axis));
        const double tolerance = 1e-14 * scale / (sine * sine);
        if (sine < 1e-6) continue;
        if (std::fabs(found.s_i - mirrored.s_j) > tolerance || std::fabs(found.s_j - mirrored.s_i) > tolerance)
            FAIL_CHECK("pair " << k << " and its mirror image differ; sine " << sine);
    }
    MESSAGE("seed " << seed << ", largest error in units of the scale: " << worst);
}

TEST_CASE("exactly parallel segments meet in the middle of their overlap, mirrored too") {
    //   i  -2 ------------ 2
    //   j          1 ------------ 5      one above the other, overlap from 1 to 2
    const Segment i{{0, 0, 0}, {1, 0, 0}, 2.0};
    for (const double sign : {1.0, -1.0}) {
        const Segment j{{3, 1, 0}, {sign, 0, 0}, 2.0};
        const NearestPoints found = nearest(i, j);
        CHECK(found.s_i == doctest::Approx(1.5).epsilon(1e-14));
        CHECK(found.s_j == doctest::Approx(-1.5 * sign).epsilon(1e-14));
        CHECK(norm(found.separation - Vec3{0, 1, 0}) < 1e-14);
        const NearestPoints mirrored = nearest(j, i);
        CHECK(mirrored.s_i == doctest::Approx(found.s_j).epsilon(1e-14));
        CHECK(mirrored.s_j == doctest::Approx(found.s_i).epsilon(1e-14));
        CHECK(norm(mirrored.separation + found.separation) < 1e-14);
    }
}

TEST_CASE("parallel up to rounding: some point of the overlap, the right distance") {
    const Vec3 axis = normalised(Vec3{0.3, -0.7, 0.45});
    const Vec3 across = any_perpendicular(axis);
    const Vec3 turned = normalised(axis + 1e-15 * cross(axis, across));
    const NearestPoints found = nearest_points(3.0 * axis + across, axis, 2.0, turned, 2.0);
    CHECK(found.s_i >= 1.0 - 1e-14);
    CHECK(found.s_i <= 2.0);
    CHECK(norm(found.separation) == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(nearest_points(3.0 * axis + across, axis, 2.0, axis, 2.0).s_i == doctest::Approx(1.5).epsilon(1e-5));
}

TEST_CASE("collinear segments: nearest ends; overlapping ones touch everywhere") {
    const Vec3 axis = normalised(Vec3{1, 2, 2});
    const NearestPoints apart = nearest_points(3.5 * axis, axis, 1.25, -axis, 1.25);
    CHECK(apart.s_i == 1.25);
    CHECK(apart.s_j == 1.25);
    CHECK(norm(apart.separation - 1.0 * axis) < 1e-14);
    CHECK(norm(nearest_points(1.0 * axis, axis, 1.25, axis, 1.25).separation) < 1e-14);
    CHECK(norm(nearest_points({0, 0, 0}, axis, 1.25, axis, 1.25).separation) == 0.0);
}

TEST_CASE("crossing segments touch at the crossing") {
    // i along x and j along y through (0.5, 0.25, 0)
    const NearestPoints found = nearest_points({0.5, 0.0, 0.0}, {1, 0, 0}, 1.0, {0, 1, 0}, 1.0);
    CHECK(found.s_i == 0.5);
    CHECK(found.s_j == 0.0);
    CHECK(norm(found.separation) == 0.0);
}

TEST_CASE("spheres: only the centres count") {
    const Vec3 separation{0.3, -2.0, 1.0};
    const NearestPoints spheres = nearest_points(separation, {1, 0, 0}, 0.0, {0, 0, 1}, 0.0);
    CHECK(spheres.s_i == 0.0);
    CHECK(spheres.s_j == 0.0);
    CHECK(spheres.separation == separation);
    const NearestPoints sphere_rod = nearest_points({0.3, 1.0, 0.0}, {0, 0, 1}, 0.0, {1, 0, 0}, 2.0);
    CHECK(sphere_rod.s_i == 0.0);
    CHECK(sphere_rod.s_j == doctest::Approx(-0.3));
    CHECK(norm(sphere_rod.separation - Vec3{0, 1, 0}) < 1e-15);
}

TEST_CASE("nearest point of a segment to a point: beside, beyond either end, sphere") {
    const Vec3 axis{0, 0, 1};
    CHECK(nearest_point({2, 0, 0.5}, axis, 1.0).s == 0.5);
    CHECK(nearest_point({2, 0, 0.5}, axis, 1.0).separation == Vec3{2, 0, 0});
    CHECK(nearest_point({0, 3, 5.0}, axis, 1.0).s == 1.0);
    CHECK(nearest_point({0, 3, 5.0}, axis, 1.0).separation == Vec3{0, 3, 4});
    CHECK(nearest_point({0, 3, -5.0}, axis, 1.0).s == -1.0);
    CHECK(nearest_point({1, 2, 3}, axis, 0.0).separation == Vec3{1, 2, 3});
}
