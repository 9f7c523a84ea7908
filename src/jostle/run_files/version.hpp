#pragma once

namespace jostle {

// What files say of the program that wrote them.
extern const char* const program_version;   ///< "0.1.0"
extern const char* const program_commit;    ///< of git; "unknown" if it was built from an archive
extern const char* const program_compiler;  ///< its name, its version, and the kind of the build

}  // namespace jostle
