#pragma once

namespace jostle {

/// What Student's t of so many degrees of freedom exceeds once in 40 times, over what a normal variable does: by how
/// much an error bar is to be widened so that twice it covers 95 %. At least 1.
///
/// `degrees_of_freedom`: taken as 1 where below. Abramowitz & Stegun, eq. 26.7.5; right to 1 % from 2 degrees of
/// freedom on.
double widening(double degrees_of_freedom);

}  // namespace jostle
