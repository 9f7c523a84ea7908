// At which steps a run keeps a frame.
#include <doctest/doctest.h>

#include <vector>

#include "jostle/measurement/frame_steps.hpp"

using namespace jostle;

namespace {

Scene scene_of(double production) {
    Scene scene;
    scene.rods.count = 10;
    scene.time.production = production;
    return scene;
}

std::vector<std::uint64_t> due(const FrameSteps& frames, std::uint64_t last) {
    std::vector<std::uint64_t> steps;
    for (std::uint64_t step = 0; step <= last; ++step)
        if (frames.is_due(step)) steps.push_back(step);
    return steps;
}

}  // namespace

TEST_CASE("by itself a run keeps a hundred frames, and that of its start") {
    Scene scene = scene_of(8.0);
    const FrameSteps detected(scene, 0.01, 10);  // 2 more for equilibration: 1000 steps
    CHECK(detected.every() == 10);
    CHECK(due(detected, 1000).size() == 101);
    CHECK(detected.frames(1000) == 101);
    scene.time.equilibration = 12.0;
    CHECK(FrameSteps(scene, 0.01, 10).every() == 20);
    CHECK(FrameSteps(scene, 1.0, 10).every() == 1);  // 20 steps
}

TEST_CASE("frames of many rods are fewer, two at least") {
    Scene scene = scene_of(80.0);  // 10,000 steps
    CHECK(FrameSteps(scene, 0.01, 200000).every() == 100);
    CHECK(FrameSteps(scene, 0.01, 1e6).every() == 500);
    CHECK(FrameSteps(scene, 0.01, 1e9).every() == 5000);
    scene.growth.rate = 1.0;  // cells: by their number at the start, whenever it is asked
    CHECK(FrameSteps(scene, 0.01, 1e6).every() == FrameSteps(scene, 0.01, 10).every());
}

TEST_CASE("what the scene says goes first") {
    Scene scene = scene_of(8.0);
    scene.output.trajectory_every = 300;
    CHECK(due(FrameSteps(scene, 0.01, 10), 1000) == std::vector<std::uint64_t>{0, 300, 600, 900});
    CHECK(keeps_frames(scene));
    scene.output.trajectory_every = 0;
    CHECK(due(FrameSteps(scene, 0.01, 10), 1000).empty());
    CHECK(FrameSteps(scene, 0.01, 10).frames(1000) == 0);
    CHECK_FALSE(keeps_frames(scene));
}

TEST_CASE("logarithmic times: twenty a decade") {
    Scene scene = scene_of(8.0);
    scene.output.trajectory_times = FrameTimes::logarithmic;
    const FrameSteps frames(scene, 0.01, 10);
    CHECK(frames.every() == 1);
    const std::vector<std::uint64_t> first = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 13, 14, 16, 18,
                                              20, 22, 25, 28, 32, 35, 40, 45, 50, 56, 63, 71, 79, 89, 100};
    CHECK(due(frames, 100) == first);
    CHECK(due(frames, 10000).size() == first.size() + 40);
    CHECK(frames.frames(10000) == static_cast<double>(first.size() + 40));
    scene.output.trajectory_every = 7;
    CHECK(due(FrameSteps(scene, 0.01, 10), 79) ==
          std::vector<std::uint64_t>{0, 7, 14, 21, 28, 35, 42, 49, 56, 63, 70, 77});
}
