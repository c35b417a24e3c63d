// SPDX-License-Identifier: MIT
// ring_index: the index in a ring buffer of the i-th element after a start.
#pragma once

#include <cstddef>

namespace splinefeed {

/// i modulo size, without a division: small processors have no divide instruction, and on others a division takes
/// longer than the rest of the access. @pre i < 2 size
[[nodiscard]] constexpr std::size_t ring_index(std::size_t i, std::size_t size) noexcept {
    return i < size ? i : i - size;
}

} // namespace splinefeed
