// SPDX-License-Identifier: MIT
// The line that reports tell is the one that is executed.
#include "splinefeed/controller/line_numbers.hpp"

#include "support/catch.hpp"
#include "support/virtual_machine_tool.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::test;

TEST_CASE("the line of a move is right or unknown", "[controller][lines]") {
    const std::uint32_t seed = Catch::rngSeed() + 1;
    CAPTURE(seed);
    std::minstd_rand random(seed);
    const auto below = [&random](std::uint32_t n) {
        return static_cast<std::uint32_t>(random()) % n;
    };
    LineNumbers numbers;
    std::map<std::uint32_t, std::uint32_t> lines;
    std::uint32_t line = 1;
    std::uint32_t step = 1;
    const std::uint32_t first = 0xffffff00U; // modulo 2^32
    for (std::uint32_t i = 0; i < 2000; ++i) {
        step = below(20) == 0 ? 5 * below(4) : step;
        line += below(30) == 0 ? below(9) : step;
        numbers.add(first + i, line);
        lines[i] = line;
        const std::uint32_t asked = i - std::min(i, below(300));
        const std::uint32_t found = numbers.find(first + asked);
        CHECK((found == lines[asked] || (found == 0 && i - asked > 64)));
    }
    CHECK(numbers.find(first + 2000) == 0);
    numbers.clear();
    CHECK(numbers.find(first + 1999) == 0);
    for (std::uint32_t i = 0; i < 5000; ++i) { // a program with numbers in tens is one run
        numbers.add(i, 10 * i + 10);
    }
    CHECK(numbers.find(0) == 10);
    CHECK(numbers.find(4999) == 50000);
}

namespace {

struct Leg {
    double from[2];
    double to[2];

    [[nodiscard]] double distance(double x, double y) const {
        const double way[2] = {to[0] - from[0], to[1] - from[1]};
        const double there[2] = {x - from[0], y - from[1]};
        const double u = (there[0] * way[0] + there[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
        const double v = std::clamp(u, 0.0, 1.0);
        return std::hypot(there[0] - v * way[0], there[1] - v * way[1]);
    }
};

} // namespace

TEST_CASE("where the machine is lies on the line that a report tells", "[controller][lines]") {
    const bool rounds = GENERATE(false, true);
    CAPTURE(rounds);
    std::map<int, std::size_t> numbers;
    std::vector<Leg> legs;
    ControlledTool<double> tool;
    std::string program = rounds ? "G64 P0.02 F3000\n" : "G61 F3000\n"; // line 1
    double at[2] = {0.0, 0.0};
    int counted = 1;
    for (int i = 0; i < 60; ++i) {
        const double to[2] = {at[0] + 3.0, 20.0 + (i % 2 == 0 ? 9.0 : -9.0) * (0.3 + 0.2 * std::sin(1.3 * i))};
        const bool stated = i % 3 == 1;
        ++counted;
        const int number = stated ? 1000 + 10 * i : counted;
        char text[80];
        std::snprintf(text, sizeof text, "G1 X%.4f Y%.4f\n", to[0], to[1]);
        program += (stated ? "N" + std::to_string(number) + " " : std::string()) + text;
        if (i % 7 == 3) {
            program += "(note)\n\nG21\n";
            counted += 2; // an empty line is none
        }
        numbers[number] = legs.size();
        legs.push_back({{at[0], at[1]}, {to[0], to[1]}});
        at[0] = to[0];
        at[1] = to[1];
    }
    tool.send("$10=7\n" + program);
    int seen = 0;
    for (int ms = 0; ms < 12000; ++ms) {
        tool.tick();
        const double x = to_mm(tool.machine.position()[0]);
        const double y = to_mm(tool.machine.position()[1]);
        tool.text.clear();
        tool.send("?");
        tool.tick();
        const std::size_t found = tool.text.find("|Ln:");
        if (found == std::string::npos) {
            CHECK((tool.text.find("<Idle") == 0 || x == 0.0));
            continue;
        }
        const int line = std::stoi(tool.text.substr(found + 4));
        CAPTURE(line, x, y);
        REQUIRE(numbers.count(line) == 1);
        const std::size_t i = numbers[line];
        const double behind = rounds && i + 1 < legs.size() ? legs[i + 1].distance(x, y) : 1e9; // a rounded corner
        CHECK(std::min(legs[i].distance(x, y), behind) < (rounds ? 0.03 : 1e-3));
        ++seen;
    }
    CHECK(seen > 1500);
    CHECK(tool.controller->state() == ControllerState::idle);
}
