#pragma once

#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// Mobility of a spherocylinder of any L/D >= 0, with the total length l = L + D and p = l/D (theory, eq. 2.19):
///     parallel      =   (ln p - 0.1137 - 0.5296/(1 + ln p) + 1.8690/p - 0.9193/p^2 + 0.3373/p^3 + a/p^4)/(2 pi mu l)
///     perpendicular =   (ln p + 0.8863 - 0.3699/(1 + ln p) + 0.9555/p - 0.1381/p^2 - 0.1271/p^3 + b/p^4)/(4 pi mu l)
///     rotational    = 3 (ln p - 0.4470 - 0.6291/(1 + ln p) + 2.4920/p - 2.5381/p^2 + 2.0681/p^3 + c/p^4)/(pi mu l^3)
///
/// Fitted to solutions of the Stokes equations for 0 <= L/D <= 200 (studies/reference/capsule_mobility.csv holds
/// those up to 100): within 0.15 %, 0.06 % and 0.17 % of them. Exact at both ends: a = 0.0230, b = 0.1266, c = -0.6125
/// make a rod of length 0 Stokes' sphere, 1/(3 pi mu D) and 1/(pi mu D^3); the constants 2 ln 2 - 3/2, 2 ln 2 - 1/2 and
/// 2 ln 2 - 11/6 are those of slender-body theory (Batchelor, J. Fluid Mech. 44, 419 (1970)) for p -> infinity.
///
/// length L >= 0 of the cylinder part, diameter D > 0 (length), viscosity mu > 0 (pressure x time). Throws InputError
/// for a value out of range.
RodMobility capsule_drag(double length, double diameter, double viscosity);

/// Slender-body mobility of a rod far from others, as in Yan, Zhang & Shelley (2019), from Tornberg & Gustavsson
/// (2006):
///     parallel = 2 b/(8 pi mu L),  perpendicular = (b + 2)/(8 pi mu L),  rotational = 3 (b + 2)/(2 pi mu L^3),
///     b = 2 ln(2 L/D) - 1.
///
/// length L > 0 of the cylinder part, diameter D > 0 (length), viscosity mu > 0 (pressure x time). b and with it the
/// mobility along the axis is negative below L/D = sqrt(e)/2 = 0.824: there throws InputError (key "mobility.model").
/// Also throws InputError for a length, diameter or viscosity out of range.
RodMobility slender_body_drag(double length, double diameter, double viscosity);

/// Mobility of a cylinder with flat ends and the total length l = L + D, p = l/D, joined to Stokes' sphere:
///     parallel      =   (ln p - 0.207 + 0.980/p - 0.133/p^2 + a/p^4)/(2 pi mu l)
///     perpendicular =   (ln p + 0.839 + 0.185/p + 0.233/p^2 + b/p^4)/(4 pi mu l)
///     rotational    = 3 (ln p - 0.662 + 0.917/p - 0.050/p^2 + c/p^4)/(pi mu l^3)
///
/// The end corrections were fitted for 2 <= p <= 30: Tirado & Garcia de la Torre, J. Chem. Phys. 71, 2581 (1979);
/// Loewen, Phys. Rev. E 50, 1232 (1994), who takes them for spherocylinders: these turn faster, by 46 % at L/D = 1 and
/// 15 % at 5, for they have less body at their ends. Departure: the terms in p^-4 are ours. a = 0.0267, b = 0.0763, c =
/// 0.1283 make a rod of length 0 Stokes' sphere, 1/(3 pi mu D) and 1/(pi mu D^3); for p >= 3 they change no bracket by
/// more than 0.3 %.
///
/// length L >= 0 of the cylinder part, diameter D > 0 (length), viscosity mu > 0 (pressure x time). Throws InputError
/// for a value out of range.
RodMobility finite_aspect_ratio_drag(double length, double diameter, double viscosity);

}  // namespace jostle
