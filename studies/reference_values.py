"""What results are compared with: Monte Carlo, virial coefficients, published tables, closed forms.

Z = P/(n kT); phi = n v0; beta = L/D; D = kT = 1. Tables and where they come from: reference/README.md.
"""

import dataclasses
import math
import pathlib

import runs

# Volume fraction of L/D = 5 above which rods form layers, in a cube of 1000 (nematic_transition measures them).
LAYERS_ABOVE = 0.465
FOLDER = pathlib.Path(__file__).resolve().parent / "reference"


@dataclasses.dataclass
class State:
    """Monte Carlo at one density: Z and nematic order S, each with its standard error (nan: not measured)."""

    phi: float
    Z: float
    Z_error: float
    S: float
    S_error: float


def monte_carlo(beta, start="isotropic"):
    """The states of one shape and start ("isotropic", "aligned"), by rising density."""
    def number(text):
        return float(text) if text else math.nan

    return [State(float(row["phi"]), float(row["Z"]), float(row["Z_err"]), number(row["S"]), number(row["S_err"]))
            for row in runs.read_csv(FOLDER / "monte_carlo.csv")
            if float(row["L_over_D"]) == beta and row["start"] == start]


def monte_carlo_at(beta, phi, start="isotropic"):
    """The state at this density, or None."""
    return next((state for state in monte_carlo(beta, start) if math.isclose(state.phi, phi)), None)


def mcgrother():
    """(phi, Z, S) for L/D = 5 by McGrother, Williamson and Jackson, J. Chem. Phys. 104, 6755 (1996), table V."""
    return [(float(row["phi"]), float(row["P_star"]) / float(row["phi"]), float(row["S"]))
            for row in runs.read_csv(FOLDER / "mcgrother.csv")]


def rod_volume(beta):
    return math.pi * (beta / 4 + 1 / 6)


def second_virial(beta):
    """B2 of isotropic spherocylinders, exact (Onsager 1949)."""
    return math.pi * (2 / 3 + beta + beta**2 / 4)


def virial(beta, phi):
    """(Z, its uncertainty) of the series up to B4; the uncertainty is a generous size of the fifth term, and the errors of
    B3 and B4. None where there are no coefficients, or the fifth term could exceed 0.3 % of Z."""
    for row in runs.read_csv(FOLDER / "virial.csv"):
        if float(row["L_over_D"]) != beta:
            continue
        x = second_virial(beta) * phi / rod_volume(beta)
        third, fourth = float(row["B3_over_B2sq"]), float(row["B4_over_B2cu"])
        # B5/B2^4 is 0.110 for spheres and 0.011 for L/D = 5.
        fifth = 0.11 if beta < 2 else 0.05 if beta < 5 else 0.011
        Z = 1 + x + third * x**2 + fourth * x**3
        error = math.hypot(fifth * x**4, float(row["err3"]) * x**2, float(row["err4"]) * x**3)
        return (Z, error) if fifth * x**4 < 0.003 * Z else None
    return None


def virial_ratios(beta):
    """(B3/B2^2, B4/B2^3) of isotropic spherocylinders; KeyError without a row."""
    rows = {float(row["L_over_D"]): row for row in runs.read_csv(FOLDER / "virial.csv")}
    row = rows[float(beta)]
    return float(row["B3_over_B2sq"]), float(row["B4_over_B2cu"])


def carnahan_starling(phi):
    return (1 + phi + phi**2 - phi**3) / (1 - phi)**3


def hard_spheres(phi):
    """A more accurate equation of state of the hard-sphere fluid; Carnahan-Starling is 0.1 to 0.3 % below it for 0.2 <= phi <= 0.45."""
    x = phi / (1 - phi)
    terms = {0: 1, 1: 4, 2: 6, 3: 2.3647684, 4: -0.8698551, 5: 1.1062803, 6: -1.1014221, 7: 0.66605866,
             8: -0.03633431, 10: -0.20965164, 14: 0.10555569, 22: -0.00872380}
    return sum(factor * x**power for power, factor in terms.items())


def parsons_lee(beta, phi):
    """Isotropic phase (Parsons 1979, Lee 1987): the excess of spheres, scaled to the exact B2."""
    return 1 + second_virial(beta) / (4 * rod_volume(beta)) * (carnahan_starling(phi) - 1)


def nezbeda(beta, phi):
    """Nezbeda, Chem. Phys. Lett. 41, 55 (1976), with a = (beta + 1)(beta + 2)/(3 beta + 2)."""
    a = (beta + 1) * (beta + 2) / (3 * beta + 2)
    numerator = 1 + (3 * a - 2) * phi + (a**2 + a - 1) * phi**2 - a * (5 * a - 4) * phi**3
    return numerator / (1 - phi)**3


def best(beta, phi):
    """(Z, standard error, name) of the best reference for an isotropic state, or None."""
    if beta == 0:
        return hard_spheres(phi), 0.001 * hard_spheres(phi), "equation of state"
    state = monte_carlo_at(beta, phi)
    if state:
        return state.Z, state.Z_error, "Monte Carlo"
    series = virial(beta, phi)
    return (*series, "virial series") if series else None


def moment_anisotropy(beta):
    """B = (N_par - N_perp)/(N_par + N_perp) (theory, eq. 1.6)."""
    return 5 * beta * (2 * beta + 1) * (2 * beta + 3) / (20 * beta**3 + 40 * beta**2 + 45 * beta + 16)


def predicted_anisotropy(beta, Z, S):
    """Largest over smallest principal collision stress in equilibrium (theory, eq. 1.8)."""
    B = moment_anisotropy(beta)
    return (Z - 1 + 2 * B * S) / (Z - 1 - B * S)
