#pragma once

#include <string>
#include <string_view>

#include "jostle/scene/scene_keys.hpp"

namespace jostle {

/// The number that a text such as "2 um/s" means in the micro system (um, s, pN).
///
///     text = NUMBER unit { [ "*" | "/" ] unit };   unit = NAME [ "^" ] [ POWER ]
/// Units stand side by side or with "*" for products; "/" divides by the one unit after it; "um-2" is "um^-2". Names:
/// nm, um, mm, cm, m; ns, us, ms, s, min, h; fN, pN, nN, uN, mN, N; mPa, Pa, kPa, MPa; cP, P (poise); zJ, aJ, fJ, pJ,
/// nJ, J. Powers of ten are kept apart until the end, so that "300 nm" is 0.3 to the last bit. Throws InputError,
/// without key and place, if the text is no such quantity or `expected` is not its dimension.
double parse_quantity(std::string_view text, Dimension expected);

/// The name of the unit of a dimension, as H5MD writes units: factors parted by spaces, signed powers; "" for pure
/// numbers.
///
/// "micro": products of pN, um and s. "reduced": products of kT, D and mu (the viscosity), the units of energy, length
/// and viscosity, so that time has the unit "kT-1 D3 mu". Where one of the three is not 1 in the scene it is not the
/// unit, which then is called "energy_unit", "length_unit" or "viscosity_unit".
std::string unit_of(const Scene& scene, Dimension dimension);

/// The same in the micro system, whatever the scene.
std::string micro_unit_of(Dimension dimension);

/// A quantity as a user may write it in the micro system, as "300 nm" for a length; for error messages.
std::string example_quantity(Dimension dimension);

}  // namespace jostle
