// SPDX-License-Identifier: MIT
//
// How many random runs a test makes: a few; half of them under sanitizers, as in ./check; twenty times as many in
// ./check --long.
#pragma once

#include <cstdlib>
#include <string_view>

namespace splinefeed_test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

/// @param many  in ./check --long
inline int rounds(int few, int many) {
    const char* const set = std::getenv("SPLINEFEED_LONG");
    return set != nullptr && std::string_view(set) == "1" ? many : sanitized ? (few + 1) / 2 : few;
}

inline int rounds(int few) {
    return rounds(few, 20 * few);
}

} // namespace splinefeed_test
