// SPDX-License-Identifier: MIT
//
// How many random runs a test makes: a few in ./check, twenty times as many in ./check --long.
#pragma once

#include <cstdlib>
#include <string_view>

namespace splinefeed_test {

inline int rounds(int few) {
    const char* const set = std::getenv("SPLINEFEED_LONG");
    return set != nullptr && std::string_view(set) == "1" ? 20 * few : few;
}

} // namespace splinefeed_test
