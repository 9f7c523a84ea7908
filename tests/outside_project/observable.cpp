#include <cstdio>
#include <vector>

#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/statistics/time_series.hpp"
#include "mean_square_along_x.hpp"  // from docs/guide/extending.md

// The observable of the guide after each of 50 steps of a scene, and the mean of it.
int main(int, char** arguments) {
    using namespace jostle;
    const Scene scene = read_scene(arguments[1]);
    Simulation simulation = assemble(scene, beginning_of(scene, arguments[1]).state);
    std::vector<double> values;
    for (int step = 0; step < 50; ++step) {
        simulation.step();
        values.push_back(mean_square_along_x(simulation));
        std::printf("%.17g ", values.back());
    }
    std::printf("%.17g\n", average(values).mean);
}
