#pragma once

#include <optional>
#include <string>

/// The frames of a run whose trajectory.h5 is not there, or behind its journal: those of the journal so far, else the
/// one of its last checkpoint.
///
/// They are written in the folder `beside`, where the output is to be. Result: a file that is open for reading, as
/// H5MD; it has no name, so that nothing of it stays. None where trajectory.h5 will do, or where the folder holds
/// neither. Errors: InputError for a damaged journal or checkpoint; DiskError.
std::optional<int> frames_so_far(const std::string& folder, const std::string& beside);
