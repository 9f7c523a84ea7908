#pragma once

#include <optional>
#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/growth/growth.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/simulation/shearing.hpp"
#include "jostle/state/state.hpp"

// What closes gaps at the beginning of a step, so that the contact problem of the same step opens them: it changes the
// state, and is taken back unless the step is kept.

namespace jostle {

/// Cells lengthen (theory 5).
class Lengthening {
public:
    Lengthening(const std::optional<Growth>& growth, Rods& rods, double time_step) : rods_(rods) {
        if (!growth) return;
        before_ = rods.length;
        growth->lengthen(rods, time_step);
    }
    Lengthening(const Lengthening&) = delete;
    Lengthening& operator=(const Lengthening&) = delete;
    ~Lengthening() {
        if (!before_.empty()) rods_.length.swap(before_);
    }
    void keep() { before_.clear(); }

private:
    Rods& rods_;
    std::vector<double> before_;
};

/// A box goes to its size at the end of the step, and the centres with it along periodic directions.
class Squeezing {
public:
    Squeezing(State& state, const std::optional<Vec3>& edges, CollisionSearch& search)
        : state_(state), search_(search) {
        if (!edges) return;
        box_before_ = state.box;
        centre_before_ = state.rods.centre;
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto direction = static_cast<int>(k);
                box_before_.periodic()[k])  // else a plane moves, and no rod
                stretch_[direction] = (*edges)[direction] / box_before_.edges()[direction];
        state.box = box_before_.with_edges(*edges);
        parallel_for(state.rods.size(), [&](std::size_t i) {
            for (int k = 0; k < 3; ++k) state.rods.centre[i][k] *= stretch_[k];
        });
        search.stretch(stretch_);
    }
    Squeezing(const Squeezing&) = delete;
    Squeezing& operator=(const Squeezing&) = delete;
    ~Squeezing() {
        if (centre_before_.empty()) return;
        state_.box = box_before_;
        state_.rods.centre.swap(centre_before_);
        search_.invalidate();
    }
    const Vec3& stretch() const { return stretch_; }
    void keep() { centre_before_.clear(); }

private:
    State& state_;
    CollisionSearch& search_;
    Box box_before_;
    Vec3 stretch_{1, 1, 1};
    std::vector<Vec3> centre_before_;
};

/// All that a step changes at its beginning. `edges`: of the box at its end, if it changes.
class ProvisionalChanges {
public:
    ProvisionalChanges(State& state, const std::optional<Vec3>& edges, const std::optional<ShearFlow>& flow,
                       const std::optional<Growth>& growth, double time_step, CollisionSearch& search)
        : squeezing_(state, edges, search),
          shearing_(state, flow, time_step, search),
          lengthening_(growth, state.rods, time_step) {}

    /// Of the box, along each direction.
    const Vec3& stretch() const { return squeezing_.stretch(); }
    void keep() {
        squeezing_.keep();
        shearing_.keep();
        lengthening_.keep();
    }

private:
    Squeezing squeezing_;
    Shearing shearing_;
    Lengthening lengthening_;
};

}  // namespace jostle
