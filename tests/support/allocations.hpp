// SPDX-License-Identifier: MIT
// How often all threads of this executable together have called operator new.
#pragma once

#include <cstddef>

namespace splinefeed_test {

[[nodiscard]] std::size_t allocations() noexcept;
/// False under a sanitizer, which has an operator new of its own.
[[nodiscard]] bool allocations_are_counted() noexcept;

} // namespace splinefeed_test
