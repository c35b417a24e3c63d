// SPDX-License-Identifier: MIT
// A sender streams points of G5.5: what the machine then does passes through each of them, and does not bend suddenly.
#include "support/catch.hpp"
#include "support/virtual_machine_tool.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

using Place = std::array<double, 2>;

double cross(const Place& a, const Place& b) {
    return a[0] * b[1] - a[1] * b[0];
}

Place way(const Place& from, const Place& to) {
    return {to[0] - from[0], to[1] - from[1]};
}

double length(const Place& a) {
    return std::hypot(a[0], a[1]);
}

double distance_to_leg(const Place& point, const Place& from, const Place& to) {
    const Place leg = way(from, to);
    const Place there = way(from, point);
    const double size = leg[0] * leg[0] + leg[1] * leg[1];
    const double u = size > 0.0 ? std::clamp((there[0] * leg[0] + there[1] * leg[1]) / size, 0.0, 1.0) : 0.0;
    return length({there[0] - u * leg[0], there[1] - u * leg[1]});
}

/// The places of the machine, a millisecond apart, while the points are sent.
std::vector<Place> travel(const std::vector<Place>& points, const char* word, bool in_bursts) {
    ControlledTool<double> tool;
    std::vector<Place> places;
    const auto tick = [&] {
        tool.tick();
        const PerAxis<Position>& at = tool.machine.position();
        const Place place{to_mm(at[0]), to_mm(at[1])};
        if (places.empty() || places.back() != place) {
            places.push_back(place);
        }
    };
    tool.send("G0 Y40\nF3000\n");
    int sent = 0;
    for (const Place& point : points) {
        std::array<char, 60> line{};
        std::snprintf(line.data(), line.size(), "%sX%.5f Y%.5f\n", sent == 0 ? word : "", point[0], point[1]);
        tool.send(line.data());
        const int pause_ms = ++sent % 25 == 0 && in_bursts ? 60 : 5;
        for (int ms = 0; ms < pause_ms; ++ms) {
            tick();
        }
    }
    for (int ms = 0; ms < 20000 && (ms < 200 || tool.controller->state() != ControllerState::idle); ++ms) {
        tick();
    }
    CHECK(tool.controller->state() == ControllerState::idle);
    CHECK(tool.text.find("rror") == std::string::npos);
    return places;
}

/// The largest change of the curvature from one place to the next one, where the machine is fast enough to see it.
double largest_jump(const std::vector<Place>& places) {
    double largest = 0.0;
    double last = 0.0;
    bool known = false;
    for (std::size_t i = 1; i + 1 < places.size(); ++i) {
        if (places[i - 1][0] < 0.5) { // a corner leads to the curve
            continue;
        }
        const Place before = way(places[i - 1], places[i]);
        const Place after = way(places[i], places[i + 1]);
        const double reach = length(way(places[i - 1], places[i + 1]));
        if (length(before) < 0.01 || length(after) < 0.01) {
            known = false;
            continue;
        }
        const double bend = 2.0 * cross(before, after) / (length(before) * length(after) * reach);
        largest = known ? std::max(largest, std::abs(bend - last)) : largest;
        last = bend;
        known = true;
    }
    return largest;
}

std::vector<Place> wave() {
    std::vector<Place> points;
    for (int i = 1; i <= 120; ++i) {
        const double x = 2.0 * i + 0.6 * std::sin(1.7 * i);
        points.push_back({std::round(x * 1e5) / 1e5, std::round((40.0 + 20.0 * std::sin(x / 12.0)) * 1e5) / 1e5});
    }
    return points;
}

std::string point_on_circle(int i) {
    std::array<char, 60> line{};
    std::snprintf(line.data(), line.size(), "X%.4f Y%.4f\n", 100.0 + 30.0 * std::cos(0.1 * i),
                  100.0 + 30.0 * std::sin(0.1 * i));
    return line.data();
}

/// Sends points to a machine that is held, as long as they are taken, and `most`. Returns how many were.
int send_held(ControlledTool<double>& tool, int most) {
    const auto sends = [&](const std::string& line) {
        tool.text.clear();
        tool.send(line);
        for (int ms = 0; ms < 10; ++ms) {
            tool.tick();
        }
        return tool.text.find("ok") != std::string::npos;
    };
    sends("!F3000 G0 " + point_on_circle(0));
    sends("G5.5 " + point_on_circle(1));
    int sent = 1;
    while (sent < most && sends(point_on_circle(sent + 1))) {
        ++sent;
    }
    return sent;
}

} // namespace

TEST_CASE("a line waits behind a curve that a pause has ended and the path has no room for", "[controller][points]") {
    ControlledTool<double> full;
    const int taken = send_held(full, 2000);
    REQUIRE(taken < 2000);
    ControlledTool<double> tool;
    REQUIRE(send_held(tool, taken) == taken);
    for (int ms = 0; ms < 300; ++ms) {
        tool.tick();
    }
    tool.text.clear();
    tool.send("~"); // behind a pause, so the curve ends
    for (int ms = 0; ms < 5; ++ms) {
        tool.tick();
    }
    tool.send("G1 X50 Y50\n");
    for (int ms = 0; ms < 200000 && (ms < 200 || tool.controller->state() != ControllerState::idle); ++ms) {
        tool.tick();
    }
    CHECK(tool.text == "ok\r\n");
    CHECK(tool.machine.position()[0] == position_from_mm(50.0));
}

TEST_CASE("a machine travels through the points that a sender streams", "[controller][points]") {
    const bool in_bursts = GENERATE(false, true);
    const std::vector<Place> points = wave();
    const std::vector<Place> places = travel(points, "G5.5 ", in_bursts);
    double farthest = 0.0;
    for (const Place& point : points) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < places.size(); ++i) {
            nearest = std::min(nearest, distance_to_leg(point, places[i - 1], places[i]));
        }
        farthest = std::max(farthest, nearest);
    }
    CAPTURE(farthest, places.size(), largest_jump(places));
    CHECK(farthest < 1.2e-4); // of that the sagitta of 0.05 mm on the sharpest bend is 4.4e-5
    CHECK(length(way(places.back(), points.back())) < 1e-9);
    CHECK(largest_jump(places) < 0.01);
}

TEST_CASE("lines that come in time make no stop", "[controller]") {
    const char* const word = GENERATE("G5.5 ", "G1 ");
    const bool in_bursts = GENERATE(false, true);
    const std::vector<Place> places = travel(wave(), word, in_bursts);
    double slowest = 1.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i][0] > 5.0 && places[i][0] < 235.0) {
            slowest = std::min(slowest, length(way(places[i - 1], places[i])));
        }
    }
    CHECK(slowest > 0.015); // lines have corners
}
