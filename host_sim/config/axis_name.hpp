// SPDX-License-Identifier: MIT
// axis_name: an axis's name as a file or an option writes it.
#pragma once

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Axes have small letters, and may be written with capitals: "x" for "X". Other texts stay as they are.
[[nodiscard]] inline std::string axis_name_of(std::string_view text) {
    std::string name(text);
    if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z') {
        name[0] = static_cast<char>(name[0] - 'A' + 'a');
    }
    return name;
}

} // namespace splinefeed::host
