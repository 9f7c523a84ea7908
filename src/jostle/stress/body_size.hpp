#pragma once

namespace jostle {

/// Whether it is a size that a body may have: its powers, up to the fifth, stay within the range of doubles.
inline bool is_size(double length) {
    return length >= 1e-30 && length <= 1e30;
}

}  // namespace jostle
