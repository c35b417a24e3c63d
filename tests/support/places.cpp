// SPDX-License-Identifier: MIT
#include "support/places.hpp"

namespace splinefeed::test {

std::string source_folder() {
    return SPLINEFEED_SOURCE_DIR;
}

std::string tool_path() {
    return SPLINEFEED_TOOL;
}

} // namespace splinefeed::test
