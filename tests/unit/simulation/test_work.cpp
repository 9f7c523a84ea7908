// Cuts follow the times that ranks need: after few balances no rank has much more to do than the others, where rods are
// dense in one place, all in one place, or a machine is slow. Times are given here, and not measured.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "jostle/domain/domain.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/thread_ranks.hpp"
#include "jostle/simulation/work.hpp"

using namespace jostle;

namespace {

const Box box({40.0, 40.0, 40.0});

void add_rods(Rods& rods, std::size_t count, const std::function<Vec3(const std::array<double, 4>&)>& place) {
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t id = rods.size();
        rods.push_back(id, place(uniform4({.seed = 5, .id = id}, 0)), {1, 0, 0}, 0.0, 1.0);
    }
}

/// In a ball about this point.
auto in_ball(const Vec3& centre, double radius) {
    return [=](const std::array<double, 4>& u) {
        const double z = 2.0 * u[0] - 1.0, angle = 6.283185307179586 * u[1], across = std::sqrt(1.0 - z * z);
        return centre + radius * std::cbrt(u[2]) * Vec3{across * std::cos(angle), across * std::sin(angle), z};
    };
}

/// How often cuts have to be moved by measured times, after they were first moved by numbers of rods, until they stay;
/// most_balances if they do not. `seconds`: that a step of this rank takes for a rod at this place.
constexpr int most_balances = 8;
int balances_until_even(int count, const Rods& all, const std::function<double(int, const Vec3&)>& seconds) {
    int balances = 0;
    run_as_ranks(count, [&](const Ranks& ranks) {
        Rods rods = all;
        Domain domain(ranks);
        domain.share_out(rods);
        domain.migrate(rods, box, true);
        const auto measured = [&] {
            Work work{.seconds = 0.0, .steps = 20};
            for (const Vec3& centre : rods.centre) work.seconds += 20.0 * seconds(ranks.rank(), centre);
            return work;
        };
        int moved = 0;
        for (Work work = measured(); moved < most_balances && work.is_uneven(ranks); work = measured(), ++moved)
            domain.migrate(rods, box, true, work.of_rod(ranks, rods.size()));
        if (ranks.rank() == 0) balances = moved;
    });
    return balances;
}

void check_soon_even(const Rods& rods, const std::function<double(int, const Vec3&)>& seconds, bool even_by_numbers) {
    for (const int count : {2, 3, 4, 8}) {
        CAPTURE(count);
        const int balances = balances_until_even(count, rods, seconds);
        CHECK(balances < most_balances);
        CHECK((balances == 0) == even_by_numbers);
    }
}

}  // namespace

TEST_CASE("a dense droplet in a box that is otherwise empty: the same number of rods a rank") {
    Rods rods;
    add_rods(rods, 2000, in_ball({8.0, 30.0, 12.0}, 5.0));
    check_soon_even(
        rods, [](int, const Vec3&) { return 1e-6; }, true);
}

TEST_CASE("a dense droplet in its vapour, whose rods cost a tenth") {
    Rods rods;
    const Vec3 centre = {8.0, 30.0, 12.0};
    add_rods(rods, 2000, in_ball(centre, 5.0));
    add_rods(rods, 3000, [](const auto& u) { return 40.0 * Vec3{u[0], u[1], u[2]}; });
    check_soon_even(
        rods, [&](int, const Vec3& at) { return norm(at - centre) < 5.0 ? 1e-6 : 1e-7; }, false);
}

TEST_CASE("a colony, whose inner cells cost three times those of its rim") {
    Rods rods;
    const Vec3 centre = {20.0, 20.0, 20.0};
    add_rods(rods, 4000, in_ball(centre, 10.0));
    const auto seconds = [&](int, const Vec3& at) { return norm(at - centre) < 6.0 ? 3e-6 : 1e-6; };
    for (const int count : {3, 5}) CHECK(balances_until_even(count, rods, seconds) < most_balances);
}

TEST_CASE("one machine is twice as slow as the others") {
    Rods rods;
    add_rods(rods, 3000, [](const auto& u) { return 40.0 * Vec3{u[0], u[1], u[2]}; });
    check_soon_even(
        rods, [](int rank, const Vec3&) { return rank == 1 ? 2e-6 : 1e-6; }, false);
}

TEST_CASE("few steps say nothing, and a rank without rods is no reason to wait") {
    run_as_ranks(2, [](const Ranks& ranks) {
        const Work short_work{.seconds = ranks.rank() == 0 ? 5.0 : 1.0, .steps = 19};
        const Work work{.seconds = ranks.rank() == 0 ? 5.0 : 0.0, .steps = 20};
        const bool early = short_work.is_uneven(ranks), later = work.is_uneven(ranks);
        const double weight = work.of_rod(ranks, ranks.rank() == 0 ? 10 : 0);
        if (early || !later) throw std::logic_error("uneven after few steps, or not after many");
        if (weight != (ranks.rank() == 0 ? 0.5 : 1.0)) throw std::logic_error("the weight is not the measured time");
    });
}
