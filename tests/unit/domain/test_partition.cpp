// Cuts: every rank gets as much weight as the others, whoever has the rods before, and directions stay.

#include <doctest/doctest.h>

#include <random>

#include "jostle/domain/partition.hpp"
#include "jostle/parallel/thread_ranks.hpp"

using namespace jostle;

namespace {

std::vector<Vec3> random_points(std::size_t count, const Vec3& edges) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = any(random), y = any(random), z = any(random);
        points.push_back({edges.x * x * x, edges.y * y, edges.z * z});
    }
    return points;
}

/// The weight that each rank gets. `owner(k)`: who has point k before.
template <class Owner>
std::vector<double> weight_by_rank(int count, const Box& box, const std::vector<Vec3>& points,
                                   const std::vector<float>& weight, Owner&& owner) {
    std::vector<std::vector<double>> by_rank(static_cast<std::size_t>(count));
    run_as_ranks(count, [&](const Ranks& ranks) {
        std::vector<Vec3> own;
        std::vector<float> of_own;
        for (std::size_t k = 0; k < points.size(); ++k)
            if (owner(k) == ranks.rank()) {
                own.push_back(points[k]);
                of_own.push_back(weight[k]);
            }
        Partition partition;
        partition.balance(ranks, box, own, of_own);
        auto& found = by_rank[static_cast<std::size_t>(ranks.rank())];
        found.resize(by_rank.size());
        for (std::size_t k = 0; k < points.size(); ++k)
            found[static_cast<std::size_t>(partition.rank_of(points[k]))] += static_cast<double>(weight[k]);
    });
    for (const auto& one : by_rank) CHECK(one == by_rank.front());  // all know the same cuts
    return by_rank.front();
}

}  // namespace

TEST_CASE("without cuts everything belongs to rank 0") {
    CHECK(Partition().rank_of({3, 4, 5}) == 0);
}

TEST_CASE("every rank gets as much weight as the others, whoever has the rods before") {
    const Box box({10, 20, 5});
    const auto points = random_points(4000, box.edges());
    std::vector<float> weight;
    for (std::size_t k = 0; k < points.size(); ++k) weight.push_back(points[k].y < 4.0 ? 5.0F : 1.0F);
    double all = 0.0;
    for (const float one : weight) all += static_cast<double>(one);
    for (const int count : {1, 2, 3, 4, 5, 8, 13}) {
        CAPTURE(count);
        const auto by_turns =
            weight_by_rank(count, box, points, weight, [count](std::size_t k) { return static_cast<int>(k) % count; });
        for (const double one : by_turns) CHECK(one == doctest::Approx(all / count).epsilon(0.02));
        CHECK(weight_by_rank(count, box, points, weight, [](std::size_t) { return 0; }) == by_turns);
    }
}

TEST_CASE("few rods, none, and all in one place can be shared out") {
    const Box box({10, 10, 10});
    const auto first = [](std::size_t) { return 0; };
    CHECK(weight_by_rank(4, box, {}, {}, first) == std::vector<double>(4, 0.0));
    const auto one = weight_by_rank(4, box, {{1, 2, 3}}, {1.0F}, first);
    CHECK(one[0] + one[1] + one[2] + one[3] == 1.0);
    const auto same = weight_by_rank(3, box, std::vector<Vec3>(30, {5, 5, 5}), std::vector<float>(30, 1.0F), first);
    CHECK(same[0] + same[1] + same[2] == 30.0);
}

TEST_CASE("directions of cuts stay where two extents are nearly equal") {
    run_as_ranks(2, [&](const Ranks& ranks) {
        const Box box({10, 10, 10});
        std::vector<Vec3> own = {{0, 0.1, 5}, {9.9, 0.2, 5}, {5, 9.9, 5}, {4, 4, 5}, {1, 7, 5}, {2, 1, 5}};
        const std::vector<float> weight(own.size(), 1.0F);
        Partition partition;
        partition.balance(ranks, box, own, weight);
        std::vector<int> before;
        for (const Vec3& centre : own) before.push_back(partition.rank_of(centre));
        own.push_back({5, 0.0, 5});
        own.push_back({5, 9.95, 5});  // y is longer now
        partition.balance(ranks, box, own, std::vector<float>(own.size(), 1.0F));
        for (std::size_t k = 0; k < before.size(); ++k)
            if (partition.rank_of(own[k]) != before[k]) throw std::logic_error("a rod has changed its rank");
    });
}
