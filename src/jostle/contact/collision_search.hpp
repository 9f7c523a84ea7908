#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/end_configuration.hpp"
#include "jostle/contact/neighbour_list.hpp"
#include "jostle/contact/pair_contacts.hpp"

namespace jostle {

/// How far the search looks: lengths, which change how long it takes, and results within the tolerance.
struct SearchRanges {
    double displacement_limit = 0.0;  ///< rods that forces displace farther have all their neighbours looked at
    double skin = 0.0;  ///< how far rods go, beside the displacements of a step, before the list is built again
    double activation_margin = 0.0;  ///< pairs with a gap wider than touching by this are inactive; at most twice the
                                     ///< displacement limit
    double range = 0.0;              ///< contacts with a smaller gap are always taken (0: those that overlap)
};

/// A step as the search for contacts sees it. Holds references.
struct StepGeometry {
    const Rods& rods;  ///< as the step begins
    const Box& box;
    const Configuration& known;            ///< (N) after the known motion
    std::span<const double> displacement;  ///< (N) by the known motion, of any point of the rod, at most
    SearchRanges ranges;
    double normals_after = 0.0;    ///< normals and arms of contacts are those after this part of the known motion
    bool forces_at_start = false;  ///< forces follow from where rods are before the step: there they meet their images
    /// Of so many first rows contacts with walls and fixed rods are sought; the others are other ranks' rods.
    std::size_t own = std::numeric_limits<std::size_t>::max();
    double mean_displacement = 0.0;  ///< over the rods of all ranks

    /// Of the moment of the normals.
    ArmAxes arm_axes() const { return {rods.axis, known.axis, normals_after}; }
    std::size_t own_rods() const { return std::min(own, rods.size()); }
};

/// Finds the pairs that collide in a step: most neighbours do not, and are kept out of the contact problem.
///
///     pairs of the neighbour list
///       passed over: cannot come close by what they were when the list was built
///       inactive:    a separating plane shows that their gap after the known motion is above touching + margin (in
///                    float, many pairs at once), or the narrow phase does (in double)
///       contacts:    all others, and those with a gap below `range` now
///
/// Once contact forces are known, `violated_pairs` looks at the inactive pairs, and at those neighbours of rods that
/// forces displace beyond the limit which were passed over until then, and returns those that would collide after all;
/// `activate` makes them contacts.
/// The result depends on the rods alone, not on the history of the list.
class CollisionSearch {
public:
    /// The contacts of the step, in place of what `contacts` held. Returns the largest overlap before the known motion,
    /// max(0, -gap).
    double find(const StepGeometry& step, Contacts& contacts);

    /// The pairs that are none of `contacts` but touch at the end of the step, in order.
    std::vector<PairKey> violated_pairs(const StepGeometry& step, const Contacts& contacts,
                                        const EndConfiguration& end);

    /// The contacts of violated pairs, which the caller adds to those of the step.
    Contacts activate(std::span<const PairKey> violated, const StepGeometry& step);

    /// To be told where the box is stretched, and all centres with it.
    void stretch(const Vec3& by) { neighbours_.stretch(by); }
    /// To be told where it is sheared, and all centres with it (`NeighbourList::shear`).
    void shear(double strain, std::int32_t copies) { neighbours_.shear(strain, copies); }

    // Where other ranks have rods, too (NeighbourList):

    /// Whether the list covers the step; if not on any rank, all have to build it anew, of gaps below twice the
    /// largest `range_needed` of them and the skin.
    bool is_covered(const StepGeometry& step);
    double range_needed() const { return std::max(largest_range_, neighbours_.lacking_range()); }
    /// Whether the last search for violated pairs would have had to look farther than the list does.
    bool lacks_pairs() const { return neighbours_.lacking_range() > 0.0; }
    NeighbourList& neighbours() { return neighbours_; }

    /// Forgets the neighbour list (rods were added, removed or renumbered).
    void invalidate() { neighbours_.invalidate(); }

private:
    /// What the bounds of a pair need of a rod, together.
    struct RodBounds {
        Vec3 centre;
        std::array<float, 3> axis, moved, axis_after;
        float half_length, radius;
    };
    struct Slab {                            ///< between the rods of an inactive pair, after the known motion
        std::array<std::int16_t, 3> normal;  ///< from i to j, in units of normal_unit
        std::uint16_t in_block;  ///< number of the pair in a block of the neighbour list, until that is built again
    };
    /// Inactive pairs, of which there are several a rod: what all are asked, side by side, for vector instructions.
    struct InactivePairs {
        std::vector<std::uint32_t> i, j;  ///< rows, i the smaller one: that which the neighbour list names
        std::vector<float> slack;         ///< width of the slab: the gap after the known motion is as wide, at least
        std::vector<float> left;          ///< the gap at the last search for violated pairs is as wide, at least
        std::vector<Slab> slab;

        std::size_t size() const { return slack.size(); }
        void resize(std::size_t count) {
            i.resize(count);
            j.resize(count);
            slack.resize(count);
            left.resize(count);
            slab.resize(count);
        }
        void push_back(std::uint32_t row_i, std::uint32_t row_j, float width, const Slab& new_slab) {
            i.push_back(row_i);
            j.push_back(row_j);
            slack.push_back(width);
            left.push_back(width);
            slab.push_back(new_slab);
        }
    };
    /// A pair that was passed over until forces displaced one of its rods beyond the limit.
    struct LatePair {
        std::uint32_t i, j;
        std::size_t number;  ///< in the neighbour list
        float left;          ///< as that of inactive pairs
    };
    struct LatePairs {
        std::vector<std::uint32_t> i, j;
        std::vector<std::size_t> number;
        std::vector<float> left;

        void clear() {
            i.clear();
            j.clear();
            number.clear();
            left.clear();
        }
        void push_back(const LatePair& pair) {
            i.push_back(pair.i);
            j.push_back(pair.j);
            number.push_back(pair.number);
            left.push_back(pair.left);
        }
    };
    struct Found {  ///< by one thread, block after block of the neighbour list
        Contacts contacts;
        InactivePairs inactive;
        double overlap = 0.0;
    };

    struct InBlock {  ///< the inactive pairs of a block: a stretch of those of a share
        std::size_t share, begin, end;
    };

    static std::size_t pair_number(std::size_t block, std::size_t in_block) {
        return block * NeighbourList::block_size + in_block;
    }
    PairKey key_of(std::size_t block, std::uint32_t i, std::size_t in_block, const Rods& rods) const {
        return in_order_of_ids(neighbours_.key(i, pair_number(block, in_block)), rods.id);
    }
    void take_displacements(const EndConfiguration& end);
    void search_blocks(const StepGeometry& step);
    void search_block(std::size_t block, const StepGeometry& step, Found& found);
    void narrow_phase(std::uint32_t row, const PairKey& key, std::uint16_t in_block, const StepGeometry& step,
                      Found& found) const;
    void append(const PairKey& key, const PairGeometry& before, const NearestPoints& nearest, const PairGeometry& after,
                const StepGeometry& step, Contacts& contacts) const;
    float width_of_slab(const InactivePairs& pairs, std::size_t k) const;
    template <class GapAtEnd>
    void search_inactive(std::size_t block, GapAtEnd&& gap_at_end);
    template <class GapAtEnd>
    void search_late(std::size_t begin, std::size_t end, GapAtEnd&& gap_at_end);
    std::vector<NeighbourList::Widening> widen(const StepGeometry& step, const EndConfiguration& end);
    bool is_contact(const PairKey& key, const Contacts& contacts) const;

    NeighbourList neighbours_{0.0};
    std::vector<double> interaction_range_;   ///< (N) displacement + displacement limit
    double largest_range_ = 0.0;              ///< of these, at the last `is_covered`
    std::vector<RodBounds> bounds_;           ///< (N)
    std::vector<Found> shares_;               ///< (threads), in the order of their blocks
    std::vector<InBlock> in_block_;           ///< (blocks)
    std::vector<Displacement> displacement_;  ///< (N) by forces, at the last search for violated pairs
    std::vector<float> known_beyond_;         ///< (N) so far beyond the displacement limit no neighbour is passed over
    LatePairs late_;                          ///< of this step
    std::vector<float> change_;  ///< (N) how far any point of the rod went since the search before, at most
    std::vector<std::uint32_t> displaced_rows_;  ///< whose displacements are not 0; of a step there are only ever more
    std::size_t first_count_ = 0;                ///< contacts before any were activated
    std::vector<PairKey> activated_;             ///< pairs of this step by rows, ascending
};

}  // namespace jostle
