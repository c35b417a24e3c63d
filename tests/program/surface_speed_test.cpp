// SPDX-License-Identifier: MIT
// G96: the spindle turns as the radius asks.
#include "support/gcode.hpp"

#include <cmath>

using namespace splinefeed_test;

namespace {

constexpr double pi = 3.14159265358979323846;

double rpm(double metres, double radius) {
    return metres * 1000.0 / (2.0 * pi * radius);
}

struct Piece {
    double told = 0.0; // the speed that the spindle has along it
    double feed = 0.0; // [mm/s]
    double x = 0.0;    // where it ends
    bool joined = false;
};

/// The moves of a program, each with the speed that the spindle was last told.
std::vector<Piece> pieces_of(GcodeRun<double>& run, const std::string& program) {
    std::vector<Piece> out;
    double told = 0.0;
    for (const ProgramItem<double>& item : run.run(program)) {
        if (item.kind == ItemKind::event) {
            told = number(item.event.value);
        } else {
            out.push_back({told, item.element.feed_mm_s, to_mm(item.element.to[0]), item.element.joined});
        }
    }
    return out;
}

} // namespace

TEST_CASE("G96: a turned shaft has the speed of its radius, by S in m/min or feet/min", "[program][surface_speed]") {
    GcodeRun<double> run;
    run.run("G18 G0 X25");
    CHECK(number(run.run("G96 S100 M3")[1].event.value) == Approx(rpm(100, 25)));
    CHECK(number(run.items()[0].event.value) == Approx(rpm(100, 25)));
    CHECK(run.last("G95 G1 Z-10 F0.2") == "feed 25 0 -10");
    CHECK(run.items().size() == 1); // nothing is to be told
    CHECK(run.items()[0].element.feed_mm_s == Approx(0.2 * rpm(100, 25) / 60));
    run.run("G0 X10");
    CHECK(run.items().size() == 1);
    CHECK(run.last("G1 Z-20") == "feed 10 0 -20"); // behind a rapid the spindle is waited for
    REQUIRE(run.items().size() == 2);
    CHECK(run.items()[0].event.kind == EventKind::spindle_speed);
    CHECK(run.items()[0].stops_before);
    CHECK(number(run.items()[0].event.value) == Approx(rpm(100, 10)));
    CHECK(number(run.run("S50")[0].event.value) == Approx(rpm(50, 10)));
    run.run("G20");
    CHECK(number(run.run("S300")[0].event.value) == Approx(rpm(300 * 0.3048, 10)));
    run.run("G21 G92 X4 Z-20"); // by the coordinates of the program, on either side
    CHECK(number(run.run("S60")[0].event.value) == Approx(rpm(60, 4)));
    run.run("G0 X-5");
    CHECK(number(run.run("G1 Z-30")[0].event.value) == Approx(rpm(60, 5)));
}

TEST_CASE("G96: D is the most that the spindle turns, and G97 keeps what it has", "[program][surface_speed]") {
    GcodeRun<double> run;
    CHECK(number(run.run("G96 D2500 S100 M4")[0].event.value) == 2500.0);
    run.run("G0 X40");
    CHECK(number(run.run("G95 G1 Z-1 F0.1")[0].event.value) == Approx(rpm(100, 40)));
    CHECK(run.run("G97").empty());
    CHECK(run.run("X10")[0].element.feed_mm_s == Approx(0.1 * rpm(100, 40) / 60));
    CHECK(number(run.run("G96 S0")[0].event.value) == 0.0);
    CHECK(run.push("G1 X11").error == ProgramError::spindle_stands);
    CHECK(number(run.run("G97 S700")[0].event.value) == 700.0);
    ProgramSettings settings = six_axes();
    settings.most_speed = Decimal::from_integer(4000);
    GcodeRun<double> other(settings);
    CHECK(number(other.run("G96 S100 D9000 M3")[0].event.value) == 4000.0);
}

TEST_CASE("G96: a face is cut in pieces of nearly one speed, with the feed of each turn", "[program][surface_speed]") {
    GcodeRun<double> run;
    run.run("G18 G0 X30\nG96 S120 D3000 M3\nG95 F0.25");
    const std::vector<Piece> pieces = pieces_of(run, "S120\nG1 X-1 Z-2");
    REQUIRE(pieces.size() > 10);
    double x = 30.0;
    for (const Piece& piece : pieces) {
        CAPTURE(x, piece.x);
        const double outer = std::fmax(std::fabs(x), std::fabs(piece.x));
        const double inner = x * piece.x < 0.0 ? 0.0 : std::fmin(std::fabs(x), std::fabs(piece.x));
        CHECK(piece.told == Approx(std::fmin(3000.0, rpm(120, outer))));
        CHECK(std::fmin(3000.0, inner > 0.0 ? rpm(120, inner) : 3000.0) <= piece.told * 1.0501);
        CHECK(piece.feed == Approx(0.25 * piece.told / 60));
        CHECK(piece.joined == (x != 30.0));
        x = piece.x;
    }
    CHECK(x == -1.0);
    CHECK(run.items().back().element.to[2] == to_position(Decimal::from_integer(-2)));
    CHECK(run.text("G94 F60 X-1") == "feed -1 0 -2");
    run.run("S120\nG61.1 G94 X9");
    for (const ProgramItem<double>& item : run.items()) { // the stop is at the end of the move
        const bool is_last = &item == &run.items().back();
        CHECK((item.kind == ItemKind::event || (item.element.mode == PathMode::exact_stop) == is_last));
    }
    run.run("G64 X-1");
    // A part of the time under G93: 6 s in all.
    double seconds = 0.0;
    double from = -1.0;
    for (const Piece& piece : pieces_of(run, "S120\nG93 G1 X29 F10")) {
        seconds += std::fabs(piece.x - from) / piece.feed;
        from = piece.x;
    }
    CHECK(seconds == Approx(6.0));
}

TEST_CASE("G96: an arc is cut into arcs about its centre, that end where it does", "[program][surface_speed]") {
    GcodeRun<double> run;
    run.run("G18 G0 X2 Z0\nG96 S90 M3\nG94 F300");
    run.run("G3 X12 Z-10 I0 K-10");
    int arcs = 0;
    double sweep = 0.0;
    double told = rpm(90, 2);
    double x = 2.0;
    for (const ProgramItem<double>& item : run.items()) {
        if (item.kind == ItemKind::event) {
            CHECK_FALSE(item.stops_before);
            CHECK(item.event.kind == EventKind::surface_speed);
            told = number(item.event.value);
            continue;
        }
        ++arcs;
        REQUIRE(item.element.shape == MoveShape::arc);
        CHECK(to_mm(item.element.arc.centre[0]) == Approx(2.0));
        CHECK(to_mm(item.element.arc.centre[2]) == Approx(-10.0));
        const double to_x = to_mm(item.element.to[0]);
        CHECK(std::hypot(to_x - 2.0, to_mm(item.element.to[2]) + 10.0) == Approx(10.0).epsilon(1e-8));
        CHECK(told == Approx(rpm(90, std::fmax(x, to_x))));
        CHECK(item.element.feed_mm_s == 5.0);
        sweep += to_double(item.element.arc.sweep_rad);
        x = to_x;
    }
    CHECK(arcs > 20);
    CHECK(std::fabs(sweep) == Approx(pi / 2));
    CHECK(x == 12.0);
}

TEST_CASE("G96 works behind cutter compensation, in cycles and with a spindle that stands",
          "[program][surface_speed]") {
    GcodeRun<double> run;
    run.run("G18 G0 X20 Z5\nG96 S100 M3\nG95 F0.2\nG42.1 D2 G1 X10 Z0\nZ-10\nX15");
    CHECK(run.last("G40 G1 X20 Z-12") == "feed 20 0 -12");
    double told = 0.0;
    for (const ProgramItem<double>& item : run.items()) {
        told = item.kind == ItemKind::event ? number(item.event.value) : told;
    }
    CHECK(told == Approx(rpm(100, 20)));
    CHECK(run.text("M5 G94 F100 G1 X30").find("feed 30 0 -12") != std::string::npos);
    CHECK(run.items().size() == 2); // the stop, and the move in one piece
    CHECK(run.push("G95 F1 X40").error == ProgramError::spindle_stands);
    run.run("M3 G17 G95 F0.1");
    CHECK(run.text("G81 X30 Z-20 R0").find("feed 30 0 -20") != std::string::npos);
}

TEST_CASE("G96 is refused without S, beside threads and splines, and on machines without X",
          "[program][surface_speed]") {
    GcodeRun<double> run;
    CHECK(run.push("G96").error == ProgramError::surface_speed_missing);
    CHECK(run.push("G96 S100 D0").error == ProgramError::surface_speed_missing);
    CHECK(run.push("G97 S100 D50").error == ProgramError::word_unused);
    CHECK_FALSE(run.interpreter().modal().surface.applies());
    run.run("G96 S100 D1000 M3 F100");
    for (const char* line :
         {"G33 Z-5 K1", "G33.1 Z-5 K1", "G84 Z-5 R1", "G5 X1 I1 J1 P1 Q1", "G5.1 X1 I1 J1", "G5.2 X1"}) {
        CAPTURE(line);
        CHECK(run.push(line).error == ProgramError::surface_speed_unsuited);
    }
    CHECK(run.text("G0 X#<_spindle_css_mode> Y#<_spindle_rpm_mode>") == "rapid 1 0 0");
    ProgramSettings settings;
    settings.axes = 2;
    settings.letters = {'Y', 'Z'};
    GcodeRun<double> other(settings);
    CHECK(other.push("G96 S100").error == ProgramError::axis_missing);
}
