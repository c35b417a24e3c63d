// SPDX-License-Identifier: MIT
// packed_column: a column of integers as a short text, for the page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splinefeed::host {

/// The differences of neighbours (the first from 0) in seven bits a byte, the sign in the lowest bit and the lowest
/// group first; the bytes in base64. Behind a 0 stands how many more follow it. Smooth columns take little more than a
/// byte a value, and constant ones next to nothing.
[[nodiscard]] std::string packed_column(const std::vector<std::int64_t>& values);

} // namespace splinefeed::host
