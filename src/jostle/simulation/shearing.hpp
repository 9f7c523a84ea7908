#pragma once

#include <optional>
#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/motion/shear_flow.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// The flow takes centres, axes and copies along, to where it has them at the end of the step; taken back unless it is
/// kept (as what provisional_change.hpp holds).
class Shearing {
public:
    Shearing(State& state, const std::optional<ShearFlow>& flow, double time_step, CollisionSearch& search);
    Shearing(const Shearing&) = delete;
    Shearing& operator=(const Shearing&) = delete;
    ~Shearing();
    void keep() { is_made_ = false; }

private:
    void shear(double strain, int copies);

    State& state_;
    CollisionSearch& search_;
    bool is_made_ = false;
    Box box_before_;
    std::vector<Vec3> centre_before_, axis_before_;
    std::vector<Image> image_before_;
    std::vector<Spring> springs_before_;
};

}  // namespace jostle
