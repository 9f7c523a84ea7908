#pragma once

#include <span>
#include <vector>

#include "jostle/math/mat3.hpp"
#include "jostle/math/named_numbers.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// The active stress of swimmers, (1/V) <sum of x F> with x how far a rod has come since some time ago and F the force
/// of its propulsion (theory, eq. 1.9): what Takatori, Yan and Brady (2014) call swim stress, positive in compression.
///
/// Over too short a time x knows too little of the path; over a long one it is mostly noise, which grows with the path.
/// So positions are remembered anew every `lag` looks, and x counts from the last but one time: by looks that are
/// evenly spaced, x is `lag` to 2 `lag` - 1 looks old. Positions are unwrapped: centre + image * edges.
class ActiveStress {
public:
    /// lag >= 1, in looks; else InputError.
    explicit ActiveStress(std::uint64_t lag);

    /// Remembers where the rods are at the beginning.
    void begin(const Rods& rods, const Box& box);

    /// To be told where the box is stretched, and all centres with it: that is no part of a rod's path.
    void stretch(const Vec3& by);

    /// A rod that has divided, and the one that came of it.
    struct Division {
        std::uint64_t mother, daughter;
    };

    /// To be told of every division before the next: both go on with the path that the mother has come, and what moves
    /// their centres apart is no part of it. `rods`: after the divisions.
    void divide(const Rods& rods, const Box& box, std::span<const Division> divisions);

    /// The next look. `force` (N): of the propulsion. The sum over rods of x F, first index that of x; not numbers in
    /// the first `lag` - 1 looks. A rod that came otherwise than by a division counts from the look that saw it first.
    /// Of several ranks each gives other rods, the same at every look, and the sum is over all of them.
    Mat3 virial(const Rods& rods, const Box& box, std::span<const Vec3> force, const Ranks& ranks = {});

    /// How many rods are remembered.
    std::size_t size() const { return id_.size(); }
    /// Forgets the rods whose ids are not in [begin, end).
    void keep(std::uint64_t begin, std::uint64_t end);

    /// For checkpoints.
    NamedNumbers to_named() const;
    /// Errors: InputError if they are not whole.
    static ActiveStress from_named(const NamedNumbers& numbers);

private:
    std::size_t index_of(std::uint64_t id) const;
    void know(const Rods& rods);
    void remember_new(const Rods& rods, const Box& box);

    std::uint64_t lag_, looks_ = 0;
    std::vector<std::uint64_t> id_;    ///< (N) of the rods that were there at the last look, ascending
    std::vector<Vec3> newer_, older_;  ///< (N) remembered positions; not numbers where there is none yet
};

}  // namespace jostle
