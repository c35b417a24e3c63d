// SPDX-License-Identifier: MIT
// G76: the moves are computed here by hand, in double.
#include "support/gcode.hpp"

#include <cmath>

using namespace splinefeed_test;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

struct Place {
    bool cuts = false;
    double x = 0.0;
    double z = 0.0;
    double feed = 0.0; // [mm/s]
};

struct Thread {
    double from_z = 0.0;
    double to_z = 0.0;
    double crest_x = 0.0;
    double drive_x = 0.0;
    std::vector<double> depths; // below the crests
    double height = 0.0;
    double compound_deg = 0.0;
    double pitch_mm_s = 0.0;
    double taper = 0.0;
    bool tapered_in = false;
    bool tapered_out = false;
};

/// The passes begin earlier by as much as their flank has moved: so all of them cut the same flank at the end of the
/// way in.
std::vector<Place> moves_of(const Thread& thread) {
    std::vector<Place> out;
    const double way = thread.to_z < thread.from_z ? -1.0 : 1.0; // along Z
    const double in = thread.crest_x > thread.drive_x ? 1.0 : -1.0;
    const double slope = std::tan(thread.compound_deg * degree);
    const double angled = thread.pitch_mm_s * std::hypot(thread.taper, thread.height) / thread.taper;
    for (const double depth : thread.depths) {
        const double z = thread.from_z + way * depth * slope;
        const double end = thread.to_z - way * (thread.height - depth) * slope;
        const double x = thread.crest_x + in * depth;
        const double clear = thread.drive_x - in * (thread.height - depth);
        out.push_back({false, clear, z, 0.0});
        if (thread.tapered_in) {
            out.push_back({true, x - in * thread.height, z, angled});
            out.push_back({true, x, z + way * thread.taper, angled});
        } else {
            out.push_back({false, x, z, 0.0});
        }
        if (thread.tapered_out) {
            out.push_back({true, x, end - way * thread.taper, thread.pitch_mm_s});
            out.push_back({true, x - in * thread.height, end, angled});
        } else {
            out.push_back({true, x, end, thread.pitch_mm_s});
        }
        out.push_back({false, clear, end, 0.0});
    }
    out.push_back({false, thread.drive_x, thread.to_z, 0.0});
    return out;
}

void check(const std::vector<ProgramItem<double>>& items, const std::vector<Place>& places) {
    REQUIRE(items.size() == places.size());
    bool cut_before = false;
    for (std::size_t i = 0; i < items.size(); ++i) {
        CAPTURE(i);
        const PathElement<double>& element = items[i].element;
        CHECK(items[i].move == (places[i].cuts ? MoveKind::turning : MoveKind::rapid));
        CHECK(to_mm(element.to[0]) == Approx(places[i].x).margin(2e-8));
        CHECK(to_mm(element.to[2]) == Approx(places[i].z).margin(2e-8));
        CHECK(element.feed_mm_s == Approx(places[i].feed));
        CHECK(items[i].stops_before == (places[i].cuts && !cut_before)); // the mark of the spindle
        cut_before = places[i].cuts;
    }
}

} // namespace

TEST_CASE("G76 outside: passes by a degression, at an angle, and once more at full depth", "[program][thread]") {
    GcodeRun<double> run;
    run.run("G18 S300 M3\nG0 X12 Z5");
    Thread thread;
    thread.from_z = 5;
    thread.to_z = -20;
    thread.drive_x = 12;
    thread.crest_x = 10;
    thread.height = 0.92;
    for (int pass = 1; 0.3 * std::sqrt(pass) < 0.92; ++pass) {
        thread.depths.push_back(0.3 * std::sqrt(pass));
    }
    CHECK(thread.depths.size() == 9);
    thread.depths.push_back(0.92);
    thread.depths.push_back(0.92);
    thread.compound_deg = 29.5;
    thread.pitch_mm_s = 1.5 * 300 / 60;
    check(run.run("G76 P1.5 Z-20 I-2 J0.3 K0.92 R2 Q29.5 H1"), moves_of(thread));
    CHECK(run.text("G0 X0") == "rapid 0 0 -20");
}

TEST_CASE("G76 inside, in inches and diameters, with tapers, upwards", "[program][thread]") {
    GcodeRun<double> run;
    run.run("G18 G20 G7 S600 M4\nG54 G0 X0.4 Z-1\nG92 X0.6 Z-0.5");
    Thread thread;
    thread.from_z = -25.4;
    thread.to_z = -12.7;
    thread.drive_x = 5.08;
    thread.crest_x = 5.08 + 0.635;
    thread.height = 1.27;
    thread.depths = {0.508, 1.016, 1.27};
    thread.pitch_mm_s = 2.54 * 600 / 60;
    thread.taper = 3.81;
    thread.tapered_in = thread.tapered_out = true;
    check(run.run("G76 P0.1 Z0 I0.05 J0.04 K0.1 E0.15 L3"), moves_of(thread));
    thread.tapered_in = false;
    run.run("G0 Z-0.5");
    check(run.run("G76 P0.1 Z0 I0.05 J0.04 K0.1 E0.4 L2 R0.5"), [&] {
        thread.taper = 10.16;
        return moves_of(thread);
    }());
}

TEST_CASE("G76 takes words that make a thread", "[program][thread]") {
    GcodeRun<double> run;
    CHECK(run.push("G76 P1 Z-5 I-1 J0.4 K1").error == ProgramError::spindle_stands);
    run.run("S100 M3 G0 Z5");
    for (const char* words :
         {"Z-5 I-1 J0.4 K1", "P1 Z-5 J0.4 K1", "P1 Z-5 I0 J0.4 K1", "P1 Z-5 I-1 K1", "P1 Z-5 I-1 J0.4",
          "P0 Z-5 I-1 J0.4 K1", "P1 Z-5 I-1 J0.4 K0.4", "P1 Z-5 I-1 J0.4 K1 L4", "P1 Z-5 I-1 J0.4 K1 L0.5",
          "P1 Z-5 I-1 J0.4 K1 H-1", "P1 Z-5 I-1 J0.4 K1 Q81", "P1 Z-5 I-1 J0.4 K1 Q-1", "P1 Z5 I-1 J0.4 K1",
          "P1 X3 I-1 J0.4 K1", "P1 Z-5 I-1 J0.4 K1 E5.1 L3", "P1 Z-5 I-1 J0.000001 K1", "P1 Z-5 I-1 J0.01 K1 R3"}) {
        CAPTURE(words);
        CHECK(run.push(std::string("G76 ") + words).error == ProgramError::thread_word_invalid);
    }
    CHECK(run.push("G76 P1 Z-5 I-1 J0.4 K1 A1").error == ProgramError::cycle_axis_word);
    CHECK(run.push("G76 I-1 J0.4 K1 P1").error == ProgramError::axis_words_missing);
    CHECK(run.push("G76 P1000 Z-5 I-1 J0.4 K1 S10000").error == ProgramError::feed_out_of_range);
    CHECK(run.push("G76 P1 Z-5 I-1 J40 K70000").error == ProgramError::move_too_long);
    CHECK(run.last("G76 P1 Z-5 I-1 J0.4 K1 X3") == "rapid 3 0 -5"); // the way to the end
    CHECK(run.text("G96 S100 G0 X1") != "");
    CHECK(run.push("G76 P1 Z-5 I-1 J0.4 K1").error == ProgramError::surface_speed_unsuited);
}
