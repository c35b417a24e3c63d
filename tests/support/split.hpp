// SPDX-License-Identifier: MIT
// split: many short texts in one, where a line of its own for each would fill a page.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace splinefeed_test {

/// What stands between the bars.
inline std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, '|');) {
        parts.push_back(part);
    }
    return parts;
}

} // namespace splinefeed_test
