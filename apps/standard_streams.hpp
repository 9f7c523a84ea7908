#pragma once

#include <string>

/// Opens /dev/null in the place of standard input, output and error where these are closed, as some job starters leave
/// them: a file of the run would get their number otherwise, and whatever is printed. To be called before any file is
/// opened.
void open_standard_streams();

/// Hands over what was printed on standard output; says why it did not get there, or nothing.
std::string output_failure();
