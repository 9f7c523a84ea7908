#pragma once

#include <span>
#include <vector>

#include "jostle/math/vec3.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// The box cut into one part a rank, by planes (recursive bisection: M. Berger, S. Bokhari, IEEE Trans. Comput. 36, 570
/// (1987)). Each cut divides the weight of a part as the numbers of ranks on its two sides stand to each other. All
/// ranks know all cuts. Which part a rod is in decides where it is computed, and no bit of the result.
class Partition {
public:
    /// Before `balance`: everything belongs to rank 0.
    Partition() = default;

    /// Moves the cuts so that each rank has as much of the weight as the others, to 1/16 of a percent of a part's
    /// extent. `centre`, `weight`: of the rods that this rank has, the weight >= 0. Directions of cuts stay as they
    /// were chosen first, across the longest extent of a part: where two are nearly equal, half of all rods would
    /// change their rank at every balance. All ranks call it together.
    void balance(const Ranks& ranks, const Box& box, std::span<const Vec3> centre, std::span<const float> weight);

    /// Whose part a centre is in; beyond the box, in an open direction, that of the nearest part.
    int rank_of(const Vec3& centre) const;

private:
    struct Cut {
        int direction = -1;  ///< -1: not chosen yet
        double place = 0.0;
    };
    /// A part that is still to be cut: of so many ranks from `first` on, by the cut of this number.
    struct Part {
        std::size_t cut = 0;
        int first = 0, count = 1;

        int below() const { return count / 2; }
        Part lower() const { return {2 * cut + 1, first, below()}; }
        Part upper() const { return {2 * cut + 2, first + below(), count - below()}; }
    };
    class Level;

    int count_ = 1;
    std::vector<Cut> cuts_;  ///< a tree: those of the halves of part k are 2 k + 1 and 2 k + 2
};

}  // namespace jostle
