#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/neighbour_list.hpp"
#include "jostle/contact/pair_contacts.hpp"

namespace jostle {

/// The gap below which two rods touch: above 0 with the time-step correction.
struct Touching {
    std::span<const double> part;  ///< (N) of two rods at most sqrt(part_i^2 + part_j^2); 2 part_i of one and its image
    std::function<double(const Contact&)> of;  ///< exactly
};

/// How rods move in a step.
struct RodMotion {
    std::span<const Vec3> centre, axis;    ///< (N) after it; centres are not wrapped
    std::span<const double> displacement;  ///< (N) by the known motion, of any point of the rod, at most
    double push_allowance;                 ///< rods that forces push farther have all their neighbours looked at
    double travel;                         ///< of the neighbour list
    double margin;  ///< pairs with a gap wider than touching by this are bystanders; at most 2 push_allowance
    double range;   ///< contacts with a smaller gap are always taken (0: those that overlap)
    Touching touching;
    bool forces_at_start = false;  ///< forces follow from where rods are before the step: there they meet their images
};

/// How contact forces push a rod in a step: the displacement of its centre, and of its ends to both sides of that; and
/// an upper bound for that of any point.
struct Push {
    std::array<float, 3> centre{}, end{};
    float farthest = 0.0F;
    float inaccuracy = 0.0F;  ///< of centre and end together, at most
};

/// Where a rod lies at the end of a step: its centre (not wrapped) and axis.
using RodAfter = std::function<std::pair<Vec3, Vec3>(std::uint32_t row)>;

/// A pair as `pair_geometry` gives it, there.
PairGeometry pair_geometry_after(const Rods& rods, const Box& box, const PairName& name, const RodAfter& after);

/// Finds the pairs that collide in a step: most neighbours do not, and are kept out of the contact problem.
///
///     pairs of the neighbour list
///       passed over: cannot come close by what they were when the list was built
///       bystanders:  a plane between the two rods shows that their gap after the known motion is above touching +
///                    margin (in float, many pairs at once), or the gap itself does (in double)
///       contacts:    all others, and those with a gap below `range` now
///
/// Once contact forces are known, `missed_pairs` looks at the bystanders, and at all neighbours of rods that forces
/// push beyond the allowance, and names those that would collide after all. The result depends on the rods alone, not
/// on the history of the list.
class CollisionSearch {
public:
    /// The contacts of the step. Returns the largest overlap before the known motion, max(0, -gap).
    double find(const Rods& rods, const Box& box, const RodMotion& motion, Contacts& contacts);

    /// The pairs that are none of `contacts` but touch in the end, in order. `pushed`: rows of the rods with a push;
    /// `pushes`: (N). Unless `thorough`, only of rods that are pushed within the allowance.
    std::vector<PairName> missed_pairs(const Rods& rods, const Box& box, const RodMotion& motion,
                                       const Contacts& contacts, std::span<const std::uint32_t> pushed,
                                       std::span<const Push> pushes, const RodAfter& after, bool thorough);

    /// Appends the contacts of missed pairs.
    void add(std::span<const PairName> missed, const Rods& rods, const Box& box, const RodMotion& motion,
             Contacts& contacts);

    /// Forgets the neighbour list (rods were added, removed or renumbered).
    void invalidate() { neighbours_.invalidate(); }

private:
    /// What the quick look at a pair needs of a rod, together.
    struct RodGlance {
        Vec3 centre;
        std::array<float, 3> axis, moved, axis_after;
        float half_length, radius, squared_touching;
    };
    struct Bystander {    ///< there are several a rod, so they take few bytes
        std::uint32_t i;  ///< the smaller row: that which the neighbour list names
        float slack;      ///< how much wider than touching the gap is after the known motion, at least
        std::array<std::int16_t, 3>
            normal;  ///< of a slab of that width between the rods, from i to the other, in units of normal_unit
        std::uint16_t in_block;  ///< its number in a block of the neighbour list; good until the list is built again
    };
    struct Found {  ///< in one block of the neighbour list
        Contacts contacts;
        std::vector<Bystander> bystanders;
        double overlap = 0.0;
    };

    static std::size_t pair_number(std::size_t block, std::size_t in_block) {
        return block * NeighbourList::block_size + in_block;
    }
    PairName name_of(std::size_t block, std::uint32_t i, std::size_t in_block, const Rods& rods) const {
        return in_order_of_ids(neighbours_.name(i, pair_number(block, in_block)), rods.id);
    }
    void look_closely(std::uint32_t row, const PairName& name, std::uint16_t in_block, const Rods& rods, const Box& box,
                      const RodMotion& motion, Found& found) const;
    double append(const PairName& name, const PairGeometry& before, const NearestPoints& nearest, double distance,
                  const PairGeometry& after, const RodMotion& motion, Contacts& contacts) const;
    void search_block(std::size_t block, const Rods& rods, const Box& box, const RodMotion& motion);
    static bool may_meet(const Bystander& bystander, const Push& i, const Push& j);
    bool is_contact(const PairName& name, const Contacts& contacts) const;

    NeighbourList neighbours_{0.0};
    std::vector<double> reach_;      ///< (N) displacement + touching + push allowance
    std::vector<RodGlance> glance_;  ///< (N)
    std::vector<Found> blocks_;
    std::vector<float> farthest_push_;  ///< (N) by forces, at the last search for missed pairs
    std::size_t first_count_ = 0;       ///< contacts before any were added
    std::vector<PairName> added_;       ///< missed pairs of this step by rows, ascending
};

}  // namespace jostle
