#pragma once

#include <functional>
#include <string>

namespace jostle {

/// The bytes that `make` gives in a child of this process. Whatever a damaged file does to memory there, here it does
/// nothing.
///
/// The child has no input, no output, `seconds` of processor time, whole ones and at least 1, and leaves no core file;
/// `make` may not start threads. Errors: InputError for `path`, the file that `make` reads, if the child does not come
/// to its end; std::bad_alloc if it runs out of memory; std::runtime_error if it cannot be started.
std::string bytes_from_child(const std::string& path, double seconds, const std::function<std::string()>& make);

}  // namespace jostle
