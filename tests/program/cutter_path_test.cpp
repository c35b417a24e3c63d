// SPDX-License-Identifier: MIT
// Cutter compensation: what its words do, and that the tool keeps its radius from random contours.
#include "support/gcode.hpp"
#include "support/rounds.hpp"
#include "support/split.hpp"

#include <cmath>
#include <random>

using namespace splinefeed_test;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double allowed_mm = 1e-6;

struct Point {
    double x = 0.0;
    double y = 0.0;
};

double apart(Point a, Point b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// A line, or an arc with a centre.
struct Piece {
    Point from;
    Point to;
    bool is_arc = false;
    Point centre;
    double sweep = 0.0;

    [[nodiscard]] Point at(double t) const {
        if (!is_arc) {
            return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
        }
        const double c = std::cos(t * sweep);
        const double s = std::sin(t * sweep);
        const double x = from.x - centre.x;
        const double y = from.y - centre.y;
        return {centre.x + c * x - s * y, centre.y + s * x + c * y};
    }
    /// Of a point from the piece, as it is or beyond its ends, too.
    [[nodiscard]] double distance(Point p, bool endless) const {
        if (is_arc) {
            double angle =
                std::atan2(p.y - centre.y, p.x - centre.x) - std::atan2(from.y - centre.y, from.x - centre.x);
            angle *= sweep < 0.0 ? -1.0 : 1.0;
            angle -= std::floor(angle / (2.0 * pi)) * 2.0 * pi;
            const bool beside = endless || angle <= std::fabs(sweep);
            return beside ? std::fabs(apart(p, centre) - apart(from, centre)) : std::min(apart(p, from), apart(p, to));
        }
        const double length = apart(from, to);
        double along = ((p.x - from.x) * (to.x - from.x) + (p.y - from.y) * (to.y - from.y)) / length;
        along = endless ? along : std::clamp(along, 0.0, length);
        return apart(p, at(along / length));
    }
};

Piece piece_of(const ProgramItem<double>& item, Point from) {
    Piece out;
    out.from = from;
    out.to = {to_mm(item.element.to[0]), to_mm(item.element.to[1])};
    out.is_arc = item.element.shape == MoveShape::arc;
    if (out.is_arc) {
        out.centre = {to_mm(item.element.arc.centre[0]), to_mm(item.element.arc.centre[1])};
        out.sweep = item.element.arc.sweep_rad;
    }
    return out;
}

std::string number_text(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9f", value);
    return text;
}

/// Lines and arcs that turn by 100 degrees at most, and bend by 35: elements that follow one another do not meet again.
std::vector<std::string> random_contour(std::mt19937_64& random) {
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<std::string> rows;
    double heading = 0.0; // of the entry
    const int count = std::uniform_int_distribution<int>(2, 8)(random);
    for (int i = 0; i < count; ++i) {
        const int kind = std::uniform_int_distribution<int>(0, 5)(random);
        heading += kind == 0 ? 0.0 : kind == 1 ? uniform(-0.06, 0.06) : uniform(-1.74, 1.74);
        if (kind % 2 == 0) {
            const double length = uniform(0.3, 12.0);
            rows.push_back("G1 X" + number_text(length * std::cos(heading)) + " Y" +
                           number_text(length * std::sin(heading)));
            continue;
        }
        const double radius = uniform(0.3, 15.0);
        const double sweep = uniform(0.05, 0.6) * (uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0);
        const double side = sweep < 0.0 ? -1.0 : 1.0;
        const Point centre{-side * radius * std::sin(heading), side * radius * std::cos(heading)};
        heading += sweep;
        rows.push_back((sweep < 0.0 ? "G2 X" : "G3 X") + number_text(centre.x + side * radius * std::sin(heading)) +
                       " Y" + number_text(centre.y - side * radius * std::cos(heading)) + " I" + number_text(centre.x) +
                       " J" + number_text(centre.y));
    }
    return rows;
}

} // namespace

TEST_CASE("the tool keeps its radius from every element", "[program][cutter_path][random]") {
    int taken = 0;
    int refused = 0;
    for (int round = static_cast<int>(first_round()); round < rounds(300, 20000); ++round) {
        std::mt19937_64 random(20261127U + static_cast<std::uint64_t>(round));
        const std::vector<std::string> rows = random_contour(random);
        const double radius = std::array{0.25, 1.0, 3.175}[random() % 3];
        GcodeRun<double> bare;
        GcodeRun<double> run;
        bare.run("G91 F600\nG1 X30");
        run.run("G91 F600\n" + std::string(random() % 2 == 0 ? "G41.1" : "G42.1") + " D" + number_text(2.0 * radius) +
                " G1 X30");
        REQUIRE(run.items().empty()); // the entry waits for the next move
        bool fits = true;
        std::string program;
        for (const std::string& row : rows) {
            REQUIRE(bare.push(row).ok());
            program += row + "\n";
            fits = fits && run.push(row).ok();
        }
        fits = fits && run.push("G40").ok();
        INFO("SPLINEFEED_ROUND=" << round << ", radius " << radius << "\n" << program);
        (fits ? taken : refused) += 1;
        if (!fits) {
            continue;
        }
        std::vector<Piece> walls; // those of line 3 on; line 2 is the entry
        Point at{30.0, 0.0};
        for (std::size_t i = 1; i < bare.items().size(); ++i) {
            walls.push_back(piece_of(bare.items()[i], at));
            at = walls.back().to;
        }
        at = {to_mm(run.items()[0].element.to[0]), to_mm(run.items()[0].element.to[1])};
        for (std::size_t i = 1; i < run.items().size(); ++i) {
            const ProgramItem<double>& item = run.items()[i];
            const Piece way = piece_of(item, at);
            at = way.to;
            const std::size_t wall = item.line - 3;
            const bool around = i + 1 < run.items().size() && run.items()[i + 1].line == item.line;
            for (int k = 0; k <= 40; ++k) {
                const Point tool = way.at(k / 40.0);
                if (!around) {
                    REQUIRE(std::fabs(walls[wall].distance(tool, true) - radius) < allowed_mm);
                }
                const std::size_t end = std::min(wall + (around ? 1 : 2), walls.size());
                for (std::size_t near = wall > 0 ? wall - 1 : 0; near < end; ++near) {
                    REQUIRE(walls[near].distance(tool, false) > radius - allowed_mm);
                }
            }
        }
    }
    CHECK(taken > rounds(300, 20000) / 5);
    CHECK(refused > rounds(300, 20000) / 10);
}

// The numbers are those of LinuxCNC's interpreter.
TEST_CASE("corners of cutter compensation", "[program][cutter_path]") {
    GcodeRun<double> run;
    CHECK(
        run.text(
            "F600 G0 X0 Y0\nG41.1 D4 G1 X10 Y0\nX30\nY20\nG3 X20 Y30 R10\nG1 X10\nY10\nX20 Y15\nX25\nG40 G1 X50 Y50") ==
        "rapid 0 0 0\nfeed 10 2 0\nfeed 28 2 0\nfeed 28 20 0\nfeed arc 20 28 0 about 20 20 0 by 90\nfeed 12 28 0\n"
        "feed 12 13.23607 0\nfeed 19.10557 16.78885 0\nfeed arc 20 17 0 about 20 15 0 by -26.56505\nfeed 25 17 0\n"
        "feed 50 50 0");
    CHECK(run.items()[8].line == 9); // the arc belongs to the move behind it
    GcodeRun<double> arc;
    CHECK(arc.text("F600 G0 X0 Y0\nG42.1 D2 G3 X10 Y10 J10\nG1 Y20\nG0 X20\nG40 X30") ==
          "rapid 0 0 0\nfeed arc 11 10 0 about 0.9545455 10 0 by 95.45262\nfeed 11 19 0\nrapid 20 19 0\nrapid 30 20 0");
}

TEST_CASE("what stands between the moves of a contour waits for them", "[program][cutter_path]") {
    GcodeRun<double> run;
    const std::string flood = "event " + std::to_string(static_cast<int>(EventKind::flood_on)) + " stop 0 0";
    const std::string pause = "event " + std::to_string(static_cast<int>(EventKind::pause)) + " stop 0 0";
    CHECK(run.text("F600 G42.1 D2 G1 X9\nX20\nM8\nG0 Z5\nG4 P1\nG1 Z0\nY10\nM0\nG40 X50") ==
          "feed 9 -1 0\nfeed 20 -1 0\n" + flood +
              "\nrapid 20 -1 5\ndwell 1\nfeed 20 -1 0\nfeed arc 21 0 0 about 20 0 0 by 90\n"
              "feed 21 10 0\n" +
              pause + "\nfeed 50 10 0");
    CHECK(run.items()[1].line + 1 == run.items()[2].line);
    CHECK(run.text("G41.1 D2 X60 Y20\n(MSG,hi)\nX70").substr(0, 6) == "event "); // a message does not wait
}

TEST_CASE("a contour ends with the program, and with the input", "[program][cutter_path]") {
    GcodeRun<double> run;
    CHECK(run.text("F600 G41.1 D2 G1 X10\nX20") == "feed 10 1 0");
    REQUIRE(run.interpreter().end_of_input().ok());
    ProgramItem<double> item;
    REQUIRE(run.interpreter().next(item) == Pull::item);
    CHECK(text_of(item) == "feed 20 1 0");
    GcodeRun<double> ended;
    CHECK(ended.text("F600 G41.1 D2 G1 X10\nX20 M2").substr(0, 23) == "feed 10 1 0\nfeed 20 1 0");
}

TEST_CASE("cutter compensation takes the tool of the table", "[program][cutter_path]") {
    GcodeRun<double> run;
    CHECK(run.text("F600 G42 D4 G1 X20\nX40\nG40") == "feed 20 -2 0\nfeed 40 -2 0");
    CHECK(run.text("G1 X0 Y0\nM61 Q6\nG41 X20\nX40\nG40").substr(0, 10) == "feed 0 0 0");
    CHECK(run.items().back().element.to[1] == to_position(Decimal::from_integer(3)));
}

TEST_CASE("feed of cutter compensation under G93 counts the programmed length", "[program][cutter_path]") {
    GcodeRun<double> run;
    run.run("G42.1 D2 G93 G1 X10 F6\nX20 F6\nY10 F12\nG40");
    REQUIRE(run.items().size() == 4);
    CHECK(run.items()[1].element.feed_mm_s == Approx(1.0));
    CHECK(run.items()[2].element.feed_mm_s == Approx(2.0));
    CHECK(run.items()[3].element.feed_mm_s == Approx(2.0));
}

TEST_CASE("what does not go with cutter compensation is refused", "[program][cutter_path][refusals]") {
    struct Case {
        const char* before;
        const char* lines; ///< each behind that
        ProgramError error;
    };
    const char* const contour = "F600 G41.1 D2 G1 X10\nX20";
    const Case cases[] = {
        {"G19", "G41.1 D1", ProgramError::cutter_plane},
        {"F600", "G41.1", ProgramError::cutter_diameter_missing},
        {"F600", "G41 D40|G41", ProgramError::tool_unknown},
        {"F600", "G41.1 D1 L3", ProgramError::cutter_tool_unsuited},
        {"G41.1 D2 F600", "G1 X1", ProgramError::cutter_entry_too_short},
        {"G41.1 D4 F600", "G2 X1 Y1 R1", ProgramError::cutter_entry_too_short},
        {"G41.1 D2", "G42.1 D2", ProgramError::cutter_on},
        {contour, "G18|G43.1 Z1|G55|M6|G92 X0|G53 G0 X0|G28|M66 P0|G38.2 X30|G81 X1 Z-1 R1|G5 X1 Y1 I1 J1 P1 Q1",
         ProgramError::cutter_active},
        {contour, "G3 X21 Y1 R0.8", ProgramError::cutter_arc_too_small},
        {"F600 G41.1 D2 G1 X10\nX11\nY0.5", "X0", ProgramError::cutter_gouge},
        {"F600 G41.1 D2 G1 X10\nX10.5", "Y5", ProgramError::cutter_gouge},
        {"F600 G41.1 D2 G1 X10\nX10.5", "Y0.5 M2", ProgramError::cutter_gouge},
        {"F600 G41.1 D2 G1 X10\nX20\nY0.5", "G40", ProgramError::cutter_gouge},
        {"F600 G41.1 D2 G1 X10\nX20\nG40", "G3 X30 R9", ProgramError::cutter_exit},
        {"F600 G41.1 D2 G1 X10\nX20\nM8\nM9\nM8\nM9\nM8\nM9", "M8 M3", ProgramError::cutter_far},
    };
    for (const auto& [before, lines, error] : cases) {
        for (const std::string& line : split(lines)) {
            GcodeRun<double> run;
            CAPTURE(before, line);
            run.run(before);
            CHECK(describe(run.push(line).error) == std::string(describe(error)));
        }
    }
}
