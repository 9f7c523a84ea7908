#pragma once

#include <span>
#include <string>
#include <vector>

namespace jostle {

/// How long what a run begins with lasts: how a rod alone lies, by how much a crowd slows that, where rods lie between
/// walls, the volume of the box, and how springs are stretched. Where there is no such
/// thing the time is 0.
struct FreeClocks {
    double rotation = 0.0;   ///< 1/(2 D_R), in the plane 1/D_R: <n(0).n(t)> has fallen to 1/e
    double diffusion = 0.0;  ///< D^2/D_t
    double flow = 0.0;       ///< one unit of strain; of a flow to and fro a period
    double slowdown = 1.0;   ///< by so many times the order of the crowd relaxes more slowly, by estimate
    double spreading = 0.0;  ///< in which a density evens out that a wall, or a start, makes uneven
    double volume = 0.0;     ///< in which a box under pressure finds its volume, at the longest
    double springs = 0.0;    ///< in which the slowest mode of a network of springs relaxes
    double passing = 0.0;    ///< L^2/(4 D_t): until then rods that have met meet again and again
    bool axes_turn = false;  ///< by noise or tumbles, or where rods swim by their neighbours
    double arrest = 1.0;     ///< by so many times the crowd lengthens the diffusion time, next to where rods are caged
};

/// Rotation times that a window has to cover. The order tensor of free rods decays three times as fast as their axes:
/// so many hold twelve of its correlation times.
inline constexpr double least_rotation_times = 4.0;
/// How many correlation times of the order tensor make a rotation time, of free rods: 1/(2 D_R) over 1/(6 D_R), in the
/// plane 1/D_R over 1/(4 D_R).
constexpr double tensor_decays_per_rotation(int dimensions) {
    return 2.0 * dimensions / (dimensions - 1.0);
}
/// Diffusion times that it has to cover.
inline constexpr double least_diffusion_times = 2.0;
/// Passing times.
inline constexpr double least_passing_times = 2.0;

/// Units of strain, or periods, that it has to cover.
inline constexpr double least_flow_times = 2.0;

/// Spreading times, and relaxation times of the volume and of springs.
inline constexpr double least_spreading_times = 2.0, least_volume_times = 2.0, least_spring_times = 2.0;

/// The shortest window that a rod alone allows: all clocks, but for what a series shows.
double shortest_window(const FreeClocks& clocks);

/// A column that may not drift in equilibrium.
struct WatchedColumn {
    std::string name;  ///< in words: "collision pressure"
    std::vector<double> rows;
};

/// The rows of production.
struct ProductionSeries {
    int dimensions = 3;
    double row_time = 0.0;
    std::vector<WatchedColumn> watched;             ///< pressures and the like
    std::vector<double> order;                      ///< S; left empty where axes do not matter, as of spheres
    std::vector<std::vector<double>> order_tensor;  ///< xx xy xz yy yz zz; likewise
};

/// Whether a window of production is one of equilibrium.
struct EquilibriumCheck {
    enum class Verdict { reached, drifting, too_short, not_checked };
    Verdict verdict = Verdict::not_checked;
    std::string reason;                                ///< half a sentence where it was not reached
    double rotation_time = 0.0;                        ///< of a rod in the crowd
    double rotation_times = 0.0;                       ///< in the window; 0 where nothing turns
    double diffusion_times = 0.0;                      ///< likewise
    double passing_times = 0.0;                        ///< likewise
    double flow_times = 0.0;                           ///< likewise, of the flow
    double spreading_times = 0.0, volume_times = 0.0;  ///< likewise
    double spring_times = 0.0;                         ///< likewise
};

/// Judges the window by clocks and by drifts.
///
/// Too short to tell: fewer than 4 rotation times, 2 diffusion or passing times, 2 units of strain, 2 spreading times
/// or 2 relaxation times of the volume or of springs, or fewer than 8 independent values of the order. A rotation time
/// is the longer of that of a free rod, which no series can shorten, and of what the series shows: the order tensor of
/// free rods decays with 1/(6 D_R), so crowding makes it three times the correlation time of the tensor; in the plane
/// with 1/(4 D_R), where the axis has 1/D_R: four times. Of a nematic, mean S above 0.4, the director may turn for
/// ever, and moves nothing else; S is slow, and a window that is too short shows it too quick: there the crowd's
/// rotation time is the estimate. Rods that nothing but their neighbours turns have the clock of the series alone.
/// Drifting: a watched column, or the order, has a significant `drift`.
EquilibriumCheck check_equilibrium(const ProductionSeries& series, const FreeClocks& clocks);

/// "0.13 of a rotation time", "5.2 rotation times".
std::string in_times(double number, const std::string& what);

/// The words of summary.json: "reached", "not reached", "too short to tell", "not checked".
std::string in_words(EquilibriumCheck::Verdict verdict);

/// The verdict with its reason, or with what the window covers: "too short to tell: covers 0.13 of a rotation time;
/// ...".
std::string in_words(const EquilibriumCheck& check);

}  // namespace jostle
