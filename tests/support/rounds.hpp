// SPDX-License-Identifier: MIT
//
// How many random runs a test makes: a few, and half of them under sanitizers, which take several times as long.
// ./check --long runs twenty times as many, in the build by g++ with assertions (`gcc_tests`).
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

/// @param many  where SPLINEFEED_LONG is 1, without sanitizers
inline int rounds(int few, int many) {
    if (sanitized) {
        return (few + 1) / 2;
    }
    const char* const set = std::getenv("SPLINEFEED_LONG");
    return set != nullptr && std::string_view(set) == "1" ? many : few;
}

inline int rounds(int few) {
    return rounds(few, 20 * few);
}

} // namespace splinefeed_test
