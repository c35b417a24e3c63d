// SPDX-License-Identifier: MIT
// All decisions are made by integers: every scalar gives the same items, and the same places to the bit.
#include "support/gcode.hpp"
#include "support/rounds.hpp"

#include <random>

using namespace splinefeed_test;

namespace {

std::string random_line(std::mt19937_64& random) {
    const auto pick = [&](unsigned n) {
        return static_cast<unsigned>(random() % n);
    };
    const auto value = [&] {
        char text[20];
        std::snprintf(text, sizeof text, "%.3f", static_cast<int>(pick(40001)) / 1000.0 - 20.0);
        return std::string(text);
    };
    const char* const codes[] = {"G0",   "G1",  "G2",  "G3",  "G5",  "G81", "G83", "G80",   "G17", "G18", "G19",
                                 "G20",  "G21", "G90", "G91", "G92", "G10", "G54", "G55",   "G61", "G64", "G28",
                                 "G5.2", "M3",  "M8",  "G4",  "G52", "G93", "G94", "G90.1", "M66", "G98", "G99"};
    std::string line;
    if (pick(3) > 0) {
        line += codes[pick(sizeof codes / sizeof *codes)];
    }
    for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'K', 'R', 'P', 'Q', 'L', 'F', 'A'}) {
        if (pick(letter <= 'F' || letter >= 'X' ? 3 : 6) == 0) {
            line += " " + std::string(1, letter) + value();
        }
    }
    return line;
}

} // namespace

TEST_CASE("double, float and Fixed make the same items", "[program][scalar]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    GcodeRun<double> in_double;
    GcodeRun<float> in_float;
    GcodeRun<Fixed> in_fixed;
    for (const char* const line : {"F100", "G10 L2 P2 X3 Y4 R30"}) {
        REQUIRE(in_double.push(line).ok());
        REQUIRE(in_float.push(line).ok());
        REQUIRE(in_fixed.push(line).ok());
    }
    int moves = 0;
    for (int i = 0; i < rounds(20000); ++i) {
        const std::string line = i % 20 == 0 ? "G5.3" : i % 20 == 1 ? "G94 F100 G90 G17" : random_line(random);
        CAPTURE(line);
        in_double.items().clear();
        in_float.items().clear();
        in_fixed.items().clear();
        const BlockStatus status = in_double.push(line);
        REQUIRE(in_float.push(line).error == status.error);
        REQUIRE(in_fixed.push(line).error == status.error);
        const bool rational = !in_double.items().empty() && in_double.items().back().element.bezier.degree == 5;
        if (rational) { // cut by a tolerance, which the scalars keep each in its own way
            REQUIRE(in_fixed.interpreter().position() == in_double.interpreter().position());
            continue;
        }
        REQUIRE(in_fixed.items().size() == in_double.items().size());
        for (std::size_t k = 0; k < in_fixed.items().size(); ++k) {
            const auto& a = in_double.items()[k];
            const auto& b = in_fixed.items()[k];
            REQUIRE(a.kind == b.kind);
            if (a.kind != ItemKind::move) {
                continue;
            }
            ++moves;
            REQUIRE(a.element.shape == b.element.shape);
            REQUIRE(a.element.to == b.element.to);
            REQUIRE(a.element.arc.centre == b.element.arc.centre);
            REQUIRE(to_double(b.element.feed_mm_s) == Approx(a.element.feed_mm_s).epsilon(1e-6).margin(1e-8));
            REQUIRE(to_double(b.element.arc.sweep_rad) == Approx(a.element.arc.sweep_rad).margin(1e-9));
        }
    }
    CHECK(moves > 20);
}
