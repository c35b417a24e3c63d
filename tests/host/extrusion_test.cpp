// SPDX-License-Identifier: MIT
#include "host_sim/report/extrusion.hpp"

#include "support/catch.hpp"

#include <string>
#include <utility>
#include <vector>

using splinefeed::host::Extrusion;

TEST_CASE("filament of a print: absolute, relative, set anew, pulled back, and what is none") {
    Extrusion extrusion;
    const std::vector<std::pair<std::string, double>> lines{
        {"G1 X5 E0.5", 0.5},
        {"g1 x6 e0.75 ; E9", 0.25},
        {"G1 X7", 0.0},
        {"G1 E-1", 0.0}, // back
        {"G1 E0.75", 1.75},
        {"G92 E0", 0.0},
        {"G1 X8 (E5) E0.25", 0.25},
        {"M83", 0.0},
        {"G0 X9 E0.5", 0.5},
        {"G2 X9 I1 E.125", 0.125},
        {"G1 X9 E-2", 0.0},
        {"G1 X9 E0.5", 0.5},
        {"M82", 0.0},
        {"G1 X9 E0.25", 0.875}, // absolute goes on from all that was said
        {"G91", 0.0},
        {"G1 X1 E0.25", 0.25},
        {"M67 E1 Q5", 0.0},
        {"G1 X[#1] E", 0.0},
        {"", 0.0},
    };
    for (const auto& [text, filament_mm] : lines) {
        CAPTURE(text);
        CHECK(extrusion.line(text) == Approx(filament_mm).margin(1e-12));
    }
}
