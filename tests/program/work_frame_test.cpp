// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/work_frame.hpp"

#include "support/gcode.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <random>

using namespace splinefeed_test;

TEST_CASE("to the machine and back, against double", "[program][frame]") {
    const unsigned seed = random_seed();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto any = [&](int most) {
        return Decimal{static_cast<std::int64_t>(random() % 2000001) * most * 1000 - most * 1000000000LL};
    };
    const AxisLetters letters(six_axes());
    for (int i = 0; i < rounds(2000); ++i) {
        WorkFrame frame(letters);
        WorkOffsets& offsets = frame.offsets();
        offsets.active = static_cast<int>(random() % 9);
        WorkSystem& system = offsets.systems[static_cast<unsigned>(offsets.active)];
        offsets.g92_applies = random() % 2 == 0;
        AxisPoint program{};
        for (unsigned k = 0; k < 6; ++k) {
            system.origin[k] = any(300);
            offsets.g92[k] = any(300);
            offsets.tool[k] = any(300);
            program[k] = any(1000);
        }
        system.rotation_deg = random() % 3 == 0 ? Decimal{} : any(720);
        frame.update();
        const AxisPoint machine = frame.to_machine(program);
        const double angle = number(system.rotation_deg) * M_PI / 180.0;
        const auto shifted = [&](unsigned k) {
            return number(program[k]) + (offsets.g92_applies ? number(offsets.g92[k]) : 0.0);
        };
        const double x = shifted(0) * std::cos(angle) - shifted(1) * std::sin(angle);
        const double y = shifted(0) * std::sin(angle) + shifted(1) * std::cos(angle);
        CHECK(std::fabs(number(machine[0]) - (x + number(system.origin[0]) + number(offsets.tool[0]))) < 2e-9);
        CHECK(std::fabs(number(machine[1]) - (y + number(system.origin[1]) + number(offsets.tool[1]))) < 2e-9);
        const AxisPoint back = frame.to_program(machine);
        for (unsigned k = 0; k < 6; ++k) {
            CHECK(std::abs(back[k].raw - program[k].raw) <= (frame.is_turned() && k < 2 ? 2 : 0));
        }
        AxisPoint wanted = program;
        wanted[2] += Decimal::from_integer(3);
        frame.set_place(offsets.active, machine, wanted); // G10 L20
        frame.update();
        const AxisPoint placed = frame.to_program(machine);
        for (unsigned k = 0; k < 6; ++k) {
            CHECK(std::abs(placed[k].raw - wanted[k].raw) <= 2);
        }
    }
}

TEST_CASE("moves in a turned system do not drift", "[program][frame]") {
    GcodeRun<double> run;
    run.run("G10 L2 P1 R33.3\nG0 X0 Y0\nG91 G1 F600");
    for (int i = 0; i < 5000; ++i) {
        REQUIRE(run.push(i % 2 == 0 ? "X0.123456789 Y0.987654321" : "X-0.123456789 Y-0.987654321").ok());
    }
    CHECK(run.interpreter().position()[0].raw == 0);
    CHECK(run.interpreter().position()[1].raw == 0);
}
