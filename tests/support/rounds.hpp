// SPDX-License-Identifier: MIT
//
// How many random runs a test makes: a few, and a quarter of them under sanitizers, which take several times as long.
// ./check --long runs five times as many, or as many as the test says, in the build by g++ with assertions
// (`gcc_tests`).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
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

/// The round that SPLINEFEED_ROUND names, the only one then; else 0. What a test says of all rounds may fail then.
inline std::uint64_t first_round() {
    const char* const only = std::getenv("SPLINEFEED_ROUND");
    return only != nullptr ? std::strtoull(only, nullptr, 10) : 0;
}

/// Of a random test: the seed that SPLINEFEED_SEED names, else another one in each run. The test tells it where it
/// fails.
inline unsigned random_seed() {
    const char* const given = std::getenv("SPLINEFEED_SEED");
    return given != nullptr ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : std::random_device{}();
}

/// Whether a sweep is made in its finest steps: where SPLINEFEED_LONG is 1, without sanitizers.
inline bool whole_sweep() {
    const char* const set = std::getenv("SPLINEFEED_LONG");
    return !sanitized && set != nullptr && std::string_view(set) == "1";
}

/// @param many  where whole_sweep()
inline int rounds(int few, int many) {
    if (std::getenv("SPLINEFEED_ROUND") != nullptr) {
        return static_cast<int>(first_round()) + 1;
    }
    return sanitized ? (few + 3) / 4 : whole_sweep() ? many : few;
}

inline int rounds(int few) {
    return rounds(few, 5 * few);
}

} // namespace splinefeed_test
