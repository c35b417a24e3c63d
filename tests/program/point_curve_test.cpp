// SPDX-License-Identifier: MIT
// G5.5: the moves are those of the spline through all points, solved at once, and what ends it.
#include "support/curve_oracle.hpp"
#include "support/gcode.hpp"
#include "support/split.hpp"

#include <array>
#include <cmath>

using namespace splinefeed_test;

namespace {

using Point = std::array<double, 3>;

// A wave that climbs, with legs of 0.5 to 2 mm.
std::vector<Point> wave(int count) {
    std::vector<Point> points{{0.0, 0.0, 0.0}};
    for (int i = 1; i <= count; ++i) {
        const double x = points.back()[0] + 1.0 + 0.5 * std::sin(2.7 * i);
        points.push_back({std::round(x * 1e4) / 1e4, std::round(3e4 * std::sin(x / 4.0)) / 1e4, 0.01 * i});
    }
    return points;
}

std::string line_of(const Point& point, const char* word = "") {
    char text[80];
    std::snprintf(text, sizeof text, "%sX%.4f Y%.4f Z%.4f", word, point[0], point[1], point[2]);
    return text;
}

} // namespace

TEMPLATE_TEST_CASE("G5.5 is the G2 spline through its points", "[program][points]", double, float, Fixed) {
    constexpr double tolerance = std::is_same_v<TestType, float> ? 1e-4 : 2e-6;
    const std::vector<Point> points = wave(60);
    GcodeRun<TestType> run;
    std::string program = "G90 G21";
    for (std::size_t i = 1; i < points.size(); ++i) {
        program += "\n" + line_of(points[i], i == 1 ? "G5.5 F600 " : i == 30 ? "F1200 " : "");
    }
    const std::vector<ProgramItem<TestType>> items = run.run(program + "\nG1 X500");
    REQUIRE(items.size() == points.size());
    std::vector<Vec> chords;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        Vec& chord = chords.emplace_back();
        for (unsigned k = 0; k < 3; ++k) {
            chord[k] = static_cast<Real>(points[i + 1][k] - points[i][k]);
        }
    }
    const std::vector<Cubic> cubics = solve_run(chords, spans_of(chords, Parameterization::chordal));
    for (std::size_t i = 0; i < cubics.size(); ++i) {
        const ProgramItem<TestType>& item = items[i];
        CAPTURE(i);
        REQUIRE(item.element.shape == MoveShape::bezier);
        CHECK(item.line == i + 2);
        CHECK(item.feed == Decimal::from_integer(i < 29 ? 600 : 1200));
        CHECK(to_double(item.element.feed_mm_s) == Approx(i < 29 ? 10.0 : 20.0));
        CHECK(item.element.joined == (i > 0));
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(item.element.to[k] == position_from_mm(points[i + 1][k])); // exactly
            for (unsigned p = 1; p < 3; ++p) {
                CHECK(to_double(item.element.bezier.points[k][p]) / chord_units_per_mm ==
                      Approx(static_cast<double>(cubics[i][p][k])).margin(tolerance));
            }
        }
    }
    CHECK(items.back().element.shape == MoveShape::line);
    CHECK_FALSE(items.back().element.joined);
}

TEST_CASE("what ends a curve through points, and what does not", "[program][points]") {
    const std::pair<bool, const char*> groups[] = {
        {true, "G1 X9|G1|G0 X9|G80|G4 P0|M8|M62 P1|S500|T2|G54|G92 X0"
               "|G43.1 Z1|G64 P1|G28|(MSG,here)|X4 M8|G5 X9 Y9 I1 J1 P1 Q1|G5.2 X9 Y9|M0|M2|X4 M2|X4 Y1 M0|X4 M1|%"},
        {false, "|(here)|N7|G91|G20 F9|G17|G94|#1 = 5|X4 Y1|G5.5 X4"}};
    for (const auto& [ends, lines] : groups) {
        for (const std::string& line : split(lines)) {
            CAPTURE(line);
            GcodeRun<double> run;
            run.run("G5.5 X1 Y0 F600\nX2 Y1\nX3 Y1");
            CHECK(run.interpreter().has_curve());
            CHECK(run.items().empty()); // of so few points nothing is known yet
            const Decimal tolerance = run.interpreter().modal().tolerance_mm;
            REQUIRE(run.push(line).ok());
            const bool begins = line == "X4 M8"; // another one
            CHECK(run.interpreter().has_curve() == (!ends || begins));
            REQUIRE(run.items().size() >= (ends ? 3U : 0U));
            if (ends) {
                CHECK(run.item_text(2) == "feed bezier 3 1 0 degree 3");
                CHECK(run.items()[2].element.tolerance_mm == Approx(number(tolerance))); // not that of the line
                CHECK_FALSE(run.items()[0].element.joined);
                CHECK(run.items()[2].element.joined);
            } else {
                CHECK(run.items().empty());
                run.interpreter().end_curve(); // as where the input pauses
                REQUIRE(run.push("").error == ProgramError::block_pending);
            }
        }
    }
}

TEST_CASE("a point beside M0 or M2 belongs to the curve, which ends in it", "[program][points]") {
    const auto [words, event] = GENERATE(table<std::string, EventKind>({{"M0", EventKind::pause},
                                                                        {"M1", EventKind::optional_pause},
                                                                        {"M60", EventKind::pallet_pause},
                                                                        {"M2", EventKind::program_end},
                                                                        {"M30", EventKind::program_end}}));
    const bool goes_before = GENERATE(false, true);
    CAPTURE(words, goes_before);
    const std::string begin = goes_before ? "G5.5 X1 Y0 F600\nX2 Y1\n" : "F600\n";
    GcodeRun<double> apart;
    const auto expected = apart.run(begin + "G5.5 X3 Y1\n" + words);
    GcodeRun<double> run;
    const auto items = run.run(begin + "G5.5 X3 Y1 " + words);
    REQUIRE(items.size() == (goes_before ? 4U : 2U));
    REQUIRE(items.size() == expected.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        CHECK(run.item_text(i) == apart.item_text(i));
        CHECK((i + 1 == items.size() || items[i].element.bezier.points == expected[i].element.bezier.points));
    }
    CHECK(items.back().event.kind == event);
    CHECK_FALSE(run.interpreter().has_curve());
}

TEST_CASE("an output before a curve through points leaves the moves behind that as they are", "[program][points]") {
    const auto word = GENERATE(as<std::string>(), "M62 P1", "M63 P1", "M67 E1 Q2");
    const auto chain_of = [](const std::string& begin) {
        GcodeRun<double> run;
        const auto items = run.run("G64 P0.1 F600\nG1 X-1\n" + begin + "G5.5 X1 Y0\nX2 Y1\nX3 Y1\nG1 X4 Y2\nX5 Y2");
        std::vector<double> chain;
        for (const auto& item : items) {
            if (item.kind == ItemKind::move) {
                chain.push_back(item.element.chain_tolerance_mm);
                CHECK(item.element.joined == (chain.size() == 3 || chain.size() == 4));
            }
        }
        return chain;
    };
    std::vector<double> expected = chain_of("");
    REQUIRE(expected.size() == 6);
    REQUIRE(expected[1] > 0.0);
    expected[1] = 0.0;
    CHECK(chain_of(word + "\n") == expected);
}

TEST_CASE("an output behind which the program was dropped changes no move of the next one", "[program]") {
    GcodeRun<double> run;
    run.run("M62 P1");
    run.interpreter().start({});
    CHECK(run.run("G64 P0.1 G1 X1 F600")[0].element.chain_tolerance_mm > 0.0);
}

TEST_CASE("a refused line leaves a curve through points as it was", "[program][points]") {
    GcodeRun<double> run;
    run.run("G5.5 X1 Y0 F600\nX2 Y1");
    for (const char* line : {"X3 P1", "G1 X2 Q7", "G93", "G41.1 D1 X9 Y9", "M999", "X3 Y1 X4"}) {
        CAPTURE(line);
        static_cast<void>(run.push(line));
        CHECK(run.interpreter().has_curve());
        CHECK(run.items().empty());
    }
    const std::vector<ProgramItem<double>> items = run.run("G94\nX3 Y1 F600\nG80");
    CHECK(items.size() == 3);
}

TEST_CASE("corners, points that coincide, and legs of any length in a curve through points", "[program][points]") {
    GcodeRun<double> run;
    SECTION("a corner") {
        const auto items = run.run("G5.5 X1 Y0 F600\nX2 Y0\nX2 Y1\nX2 Y2\nG80");
        REQUIRE(items.size() == 4);
        CHECK(items[1].element.joined);
        CHECK_FALSE(items[2].element.joined);
        CHECK(items[3].element.joined);
    }
    SECTION("the last point is reached exactly") {
        const auto items = run.run("G5.5 X1 Y0 F600\nX2 Y1\nX2.00003 Y1\nX2.00006 Y1\nG80");
        REQUIRE(items.size() == 3);
        CHECK(items[2].element.shape == MoveShape::line);
        CHECK(items[2].element.to[0] == position_from_mm(2.00006));
    }
    SECTION("no point is elsewhere") {
        CHECK(run.run("G5.5 X0 F600\nX0 Y0\nG80").empty());
        CHECK_FALSE(run.interpreter().has_curve());
    }
    SECTION("feeds and lines of many points that coincide") {
        std::string program = "G5.5 X1 Y0 F600\nX2 Y1 F700";
        for (int i = 0; i < 100; ++i) {
            program += "\nX2 Y1";
        }
        const auto items = run.run(program + "\nX3 Y1 F800\nG80");
        REQUIRE(items.size() == 3);
        CHECK(items[1].line == 2);
        CHECK(items[2].line == 103);
        CHECK(items[2].feed == Decimal::from_integer(800));
    }
    SECTION("from a micrometre to metres") {
        const auto items = run.run("G5.5 X0.001 Y0 F600\nX8000 Y1\nX8000.001 Y1.0005\nX7999 Y1.0006\nX0 Y5\nG80");
        CHECK(items.size() == 5);
    }
}

TEST_CASE("an interpreter without memory for it refuses a curve through points", "[program][points]") {
    Interpreter<double> interpreter(six_axes());
    interpreter.start({});
    CHECK(interpreter.push("G5.5 X1 F600", 1).error == ProgramError::points_unsupported);
    CHECK_FALSE(interpreter.has_curve());
}
