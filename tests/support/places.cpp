// SPDX-License-Identifier: MIT
#include "support/places.hpp"

#include <cstdlib>

namespace splinefeed::test {

std::string source_folder() {
    return SPLINEFEED_SOURCE_DIR;
}

std::string tool_path() {
    const char* const named = std::getenv("SPLINEFEED_TOOL");
    return named != nullptr ? named : SPLINEFEED_TOOL;
}

} // namespace splinefeed::test
