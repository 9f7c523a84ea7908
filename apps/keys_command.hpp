#pragma once

#include "exit_code.hpp"

/// `jostle keys`: every key that a scene may hold, one line a key: name, kind of value, allowed values and dimension.
/// With `json` as an array of objects, for programs that write scenes.
ExitCode keys_command(bool json);
