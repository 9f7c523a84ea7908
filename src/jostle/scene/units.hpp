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
/// and viscosity, so that time has the unit "kT-1 D3 mu". Where D or mu is not 1 in the scene it is not the unit, which
/// then is called "length_unit" or "viscosity_unit"; where kT is not 1, the unit of time is called "time_unit", and
/// takes the place of that of energy.
std::string unit_of(const Scene& scene, Dimension dimension);
/// Of stresses and of number densities: in two dimensions force per length, and number per area.
std::string unit_of_stress(const Scene& scene);
std::string unit_of_number_density(const Scene& scene);

/// A unit as people write it: a number in the unit of a file, times the factor, is in this one.
struct ReadableUnit {
    double factor = 1.0;
    std::string name;  ///< "" for pure numbers
};

/// What `unit_of` wrote, as "mu D3/kT" for "kT-1 D3 mu". Of cells that grow without much noise, times are in what they
/// need to lengthen by D, "D/growth rate", in the place of time_unit.
ReadableUnit readable_unit(const Scene& scene, std::string_view unit);

/// The same of a dimension in the scene's own unit, whatever grows.
std::string readable_unit_of(const Scene& scene, Dimension dimension);

/// "um/s" for "um s-1".
std::string readable_unit(std::string_view unit);

/// The same in the micro system, whatever the scene.
std::string micro_unit_of(Dimension dimension);

/// A quantity as a user may write it in the micro system, as "300 nm" for a length; for error messages.
std::string example_quantity(Dimension dimension);

}  // namespace jostle
