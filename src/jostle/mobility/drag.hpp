#pragma once

#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// Slender-body mobility of a rod far from others, as in Yan, Zhang & Shelley (2019), from Tornberg & Gustavsson
/// (2006):
///     parallel = 2 b/(8 pi mu L),  perpendicular = (b + 2)/(8 pi mu L),  rotational = 3 (b + 2)/(2 pi mu L^3),
///     b = 2 ln(2 L/D) - 1.
///
/// length L > 0 of the cylinder part, diameter D > 0 (length), viscosity mu > 0 (pressure x time). b and with it the
/// mobility along the axis is negative below L/D = sqrt(e)/2 = 0.824: there throws InputError (key "mobility.model").
/// Also throws InputError for a length, diameter or viscosity out of range.
RodMobility slender_body_drag(double length, double diameter, double viscosity);

/// Mobility of a rod of any L/D >= 0, with the total length l = L + D and p = l/D:
///     parallel      =   (ln p - 0.207 + 0.980/p - 0.133/p^2 + a/p^4)/(2 pi mu l)
///     perpendicular =   (ln p + 0.839 + 0.185/p + 0.233/p^2 + b/p^4)/(4 pi mu l)
///     rotational    = 3 (ln p - 0.662 + 0.917/p - 0.050/p^2 + c/p^4)/(pi mu l^3)
///
/// The end corrections were fitted for 2 <= p <= 30: Tirado & Garcia de la Torre, J. Chem. Phys. 71, 2581 (1979);
/// Loewen, Phys. Rev. E 50, 1232 (1994), for spherocylinders. Departure: the terms in p^-4 are ours. a = 0.0267, b =
/// 0.0763, c = 0.1283 make a rod of length 0 Stokes' sphere, 1/(3 pi mu D) and 1/(pi mu D^3); for p >= 3 they change no
/// bracket by more than 0.3 %.
///
/// length L >= 0 of the cylinder part, diameter D > 0 (length), viscosity mu > 0 (pressure x time). Throws InputError
/// for a value out of range.
RodMobility finite_aspect_ratio_drag(double length, double diameter, double viscosity);

}  // namespace jostle
