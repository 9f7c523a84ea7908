#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "jostle/hydrodynamics/blob_kernel.hpp"
#include "jostle/math/four.hpp"

namespace jostle {

/// Flows between four pairs of blobs.
struct FourFlows {
    Four isotropic, radial;
};

/// The same with their derivatives by r^2.
struct FourFlowSlopes {
    FourFlows flow, slope;
};

/// A FlowTable in floats, for four pairs at once. One of a thousand intervals stays in the nearest cache.
class FourFlowTable {
public:
    explicit FourFlowTable(const FlowTable& table) : per_square_(four(table.per_square())) {
        for (const FlowTable::Piece& piece : table.pieces()) {
            Piece& rounded = pieces_.emplace_back();
            for (std::size_t power = 0; power < 4; ++power) {
                rounded.isotropic[power] = static_cast<float>(piece[power][0]);
                rounded.radial[power] = static_cast<float>(piece[power][1]);
            }
        }
    }

    /// Of squared distances below the range.
    FourFlows at(const Four& squared_distance) const {
        const Pieces p = pieces_at(squared_distance);
        return {value(p.isotropic, p.place), value(p.radial, p.place)};
    }
    FourFlowSlopes with_slope(const Four& squared_distance) const {
        const Pieces p = pieces_at(squared_distance);
        return {{value(p.isotropic, p.place), value(p.radial, p.place)},
                {slope(p.isotropic, p.place), slope(p.radial, p.place)}};
    }

private:
    /// Coefficients of t^0 ... t^3 of one interval.
    struct Piece {
        Four isotropic, radial;
    };
    /// Those of the intervals of four pairs, and the places t in these.
    struct Pieces {
        std::array<Four, 4> isotropic, radial;
        Four place;
    };

    Pieces pieces_at(const Four& squared_distance) const {
        const Four place = squared_distance * per_square_;
        const auto k = __builtin_convertvector(place, FourIntegers);
        Pieces p;
        for (std::size_t lane = 0; lane < 4; ++lane) {
            const Piece& piece = pieces_[static_cast<std::size_t>(k[lane])];
            p.isotropic[lane] = piece.isotropic;
            p.radial[lane] = piece.radial;
        }
        transpose(p.isotropic[0], p.isotropic[1], p.isotropic[2], p.isotropic[3]);
        transpose(p.radial[0], p.radial[1], p.radial[2], p.radial[3]);
        p.place = place - __builtin_convertvector(k, Four);
        return p;
    }
    static Four value(const std::array<Four, 4>& c, const Four& t) { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
    Four slope(const std::array<Four, 4>& c, const Four& t) const {
        return ((3.0F * c[3] * t + 2.0F * c[2]) * t + c[1]) * per_square_;
    }

    Four per_square_;  ///< intervals per length^2
    std::vector<Piece> pieces_;
};

}  // namespace jostle
