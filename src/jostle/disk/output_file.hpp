#pragma once

#include <string>
#include <string_view>

namespace jostle {

/// Puts `content` where the user has named a place for it, as a shell's > would, but whole or not at all.
///
/// A file, or what a symbolic link leads to, is replaced in its own folder: whoever looks finds the old or the new. Its
/// permissions stay. The temporary file beside it has a name that nothing had. Devices, pipes, and what standard output
/// goes to, are written to. Errors: InputError for a folder; DiskError, after which the old file is there as it was.
void write_output(const std::string& path, std::string_view content);

}  // namespace jostle
