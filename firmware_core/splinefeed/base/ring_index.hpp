// SPDX-License-Identifier: MIT
// ring_index: where the i-th place from some start lies in a ring.
#pragma once

#include <cstddef>

namespace splinefeed {

/// i modulo size, without a division: small processors have none, and on others it takes longer than the rest of an
/// access. @pre i < 2 size
[[nodiscard]] constexpr std::size_t ring_index(std::size_t i, std::size_t size) noexcept {
    return i < size ? i : i - size;
}

} // namespace splinefeed
