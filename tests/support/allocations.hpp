// SPDX-License-Identifier: MIT
//
// How often this executable has called operator new; for executables that link allocations_test.cpp.
#pragma once

#include <cstddef>

namespace splinefeed_test {

[[nodiscard]] std::size_t allocations() noexcept;

} // namespace splinefeed_test
