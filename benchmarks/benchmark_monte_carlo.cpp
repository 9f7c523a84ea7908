// Metropolis Monte Carlo of hard rods, as a rival of the simulation where only the pressure of equilibrium is asked
// for.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>

#include "jostle/contact/neighbour_list.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene_file/rods_file.hpp"
#include "jostle/setup/monte_carlo.hpp"

using namespace jostle;

namespace {

const char* const usage =
    "usage: benchmark_monte_carlo START.csv EDGE LENGTH SECONDS SEED SERIES END.csv\n"
    "Rods of diameter 1 in a periodic cube, one thread. START.csv is what a scene's rods.file is;\n"
    "END.csv gets places and axes at the end, SERIES one value of Z a line. Prints sweeps, wall and processor "
    "seconds.\n";

constexpr double hard = 1e3;          ///< kT for an overlap
constexpr int sweeps_a_row = 2;       ///< of the series
constexpr double compression = 8e-3;  ///< by this part of an edge, twice and three times as much

void write_rods(const Rods& rods, const std::string& path) {
    std::ofstream file(path);
    file << "x,y,z,nx,ny,nz\n";
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const Vec3 &c = rods.centre[i], &n = rods.axis[i];
        file << fmt::format("{},{},{},{},{},{}\n", c.x, c.y, c.z, n.x, n.y, n.z);
    }
}

/// Z = 1 + lim n(e)/(3 N e): n pairs overlap once each edge, and the places of all centres, are smaller by the part e.
/// From e, 2 e and 3 e by a parabola.
double compressibility(const Rods& rods, const Box& box) {
    const double most = 3.0 * compression * 0.5 * (rods.length[0] + rods.diameter[0]);
    const std::vector<double> ranges(rods.size(), most);
    NeighbourList neighbours(0.0);
    neighbours.update(rods, box, ranges);
    std::array<double, 3> overlapping{};
    for (std::size_t block = 0; block < neighbours.block_count(); ++block)
        neighbours.for_close_pairs(block, [&](std::uint32_t row, std::size_t pair) {
            const auto& [i, j, image] = neighbours.key(row, pair);
            PairGeometry geometry = pair_geometry(rods, i, j, box.displacement(image), rods.centre, rods.axis);
            const Vec3 before = geometry.centre_separation;
            for (int times = 3; times > 0; --times) {
                geometry.centre_separation = (1.0 - times * compression) * before;
                if (!pair_overlaps(geometry)) break;
                ++overlapping[static_cast<std::size_t>(times - 1)];
            }
        });
    const double extrapolated = 3.0 * overlapping[0] - 1.5 * overlapping[1] + overlapping[2] / 3.0;
    return 1.0 + extrapolated / (3.0 * static_cast<double>(rods.size()) * compression);
}

void run(char** words) {
    const double edge = std::stod(words[2]), length = std::stod(words[3]), seconds = std::stod(words[4]);
    Rods rods = read_rods(words[1], length, 1.0);
    const Box box{{edge, edge, edge}};
    parallel::set_thread_count(1);
    MonteCarlo monte_carlo(rods, box, std::stoull(words[5]));
    std::ofstream series(words[6]);
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    const std::clock_t processor_before = std::clock();
    std::uint64_t sweeps = 0;
    while (passed() < seconds) {
        for (int k = 0; k < sweeps_a_row; ++k, ++sweeps) monte_carlo.sweep(hard, 0);
        series << fmt::format("{}\n", compressibility(rods, box));
    }
    const double processor = static_cast<double>(std::clock() - processor_before) / CLOCKS_PER_SEC;
    fmt::print("{} sweeps, {} s, {} s of the processor, {} rods overlap\n", sweeps, passed(), processor,
               monte_carlo.overlapping_rods());
    write_rods(rods, words[7]);
}

}  // namespace

int main(int count, char** words) {
    if (count != 8) {
        std::fputs(usage, stderr);
        return 2;
    }
    try {
        run(words);
    } catch (const std::exception& error) {
        fmt::print(stderr, "benchmark_monte_carlo: {}\n", error.what());
        return 1;
    }
    return 0;
}
