#pragma once

#include <cstdint>

#include "jostle/scene/scene.hpp"

namespace jostle {

/// At which steps a run keeps a frame of its trajectory.
///
/// Evenly: every `output.trajectory_every` steps; "auto": some 100 frames of the time that the scene asks for, fewer of
/// more than 200,000 rods: then 2e7 rods in all frames, but two frames at least. Logarithmic: the rounded
/// trajectory_every 10^(k/20), k = 0, 1, 2 ...: twenty a decade, as far as they are different; "auto" is 1 then.
class FrameSteps {
public:
    /// `rods`: how many there are; of cells that grow their number at the start is taken, which the scene says.
    FrameSteps(const Scene& scene, double time_step, double rods);

    bool is_due(std::uint64_t step) const;

    /// Steps from one frame to the next, or to the first one; 0: there is none.
    std::uint64_t every() const { return every_; }

    /// How many frames so many steps have, that of the start included.
    double frames(double steps) const;

private:
    std::uint64_t every_ = 0;
    bool logarithmic_ = false;
};

/// Whether a run of the scene keeps frames.
bool keeps_frames(const Scene& scene);

}  // namespace jostle
