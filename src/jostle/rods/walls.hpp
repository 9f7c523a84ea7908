#pragma once

#include <array>
#include <numbers>

namespace jostle {

/// A wall that surrounds the rods on its own: the inside of a sphere or of a tube, which touches the faces of the box.
enum class Container { none, sphere, tube };

/// The part of a box that is inside of its container.
constexpr double share_of_box(Container container) {
    if (container == Container::none) return 1.0;
    return container == Container::tube ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
}

/// The hard walls of a box.
struct Walls {
    std::array<bool, 3> faces{};  ///< planes at both faces of the box across x, y, z
    Container container = Container::none;
    int axis = 0;           ///< direction of a tube: 0, 1, 2 for x, y, z
    bool turn_rods = true;  ///< false: they touch a rod at its centre, as if it were a sphere

    bool any() const { return faces[0] || faces[1] || faces[2] || container != Container::none; }

    bool operator==(const Walls&) const = default;
};

}  // namespace jostle
