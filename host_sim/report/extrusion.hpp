// SPDX-License-Identifier: MIT
// Extrusion: how much filament the lines of a printer's program ask for, read from their text.
#pragma once

#include <string_view>

namespace splinefeed::host {

/// Follows M82, M83, G90, G91 and G92 as Marlin does: absolute until something else is said. What is a number in an
/// expression is none here.
class Extrusion {
public:
    /// The next line. Returns what its move pushes [mm of filament]; 0: it is no move, or pulls back.
    [[nodiscard]] double line(std::string_view text);

private:
    bool relative_ = false;
    double at_mm_ = 0.0;
};

} // namespace splinefeed::host
