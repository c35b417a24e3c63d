// SPDX-License-Identifier: MIT
// How often all threads of this executable together have called operator new; under a sanitizer malloc, too.
#pragma once

#include <cstddef>

namespace splinefeed_test {

[[nodiscard]] std::size_t allocations() noexcept;

} // namespace splinefeed_test
