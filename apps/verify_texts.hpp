#pragma once

#include <string>

#include "jostle/run_files/checkpoint.hpp"

/// Looks at the files of a run that are written anew whenever it goes on: scene.toml and resolved.toml against the
/// checkpoint, descriptions of columns against what this version writes, run.json, summary.json and post_mortem.json
/// against their checksums. Prints a line for each that is sound.
///
/// Errors: InputError for the first that is missing or damaged; DiskError.
void verify_texts(const std::string& folder, const jostle::Checkpoint& checkpoint);
