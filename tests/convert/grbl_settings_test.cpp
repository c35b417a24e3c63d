// SPDX-License-Identifier: MIT
// A machine file as lines of grbl, and back.
#include "host_sim/convert/grbl_settings.hpp"

#include "host_sim/config/machine_file.hpp"
#include "host_sim/convert/grbl_machine.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"
#include "support/rounds.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool notes(const GrblSettings& settings, std::string_view word) {
    return std::ranges::any_of(settings.left_out, [&](const std::string& note) { return note.find(word) == 0; });
}

/// All that lines of grbl say of a machine is equal.
void check_equal(const std::string& text) {
    CAPTURE(text);
    const MachineDescription machine = parse_machine(text, "m.toml");
    const GrblSettings settings = grbl_settings(text, "m.toml");
    CAPTURE(settings.lines);
    const std::string again = machine_text(grbl_sketch(settings.lines, "m.toml"));
    CAPTURE(again);
    CHECK(machine_problems(again, "m.toml").empty());
    const MachineDescription read = parse_machine(again, "m.toml");
    REQUIRE(read.settings.axes == machine.settings.axes);
    for (const unsigned k : indices(machine.settings.axes)) {
        const AxisSettings& axis = machine.settings.axis[k];
        const AxisSettings& back = read.settings.axis[k];
        CHECK(read.axis_name[k] == machine.axis_name[k]);
        CHECK(back.rotary == axis.rotary);
        CHECK(back.steps_per_mm == axis.steps_per_mm);
        CHECK(back.max_velocity_mm_s == axis.max_velocity_mm_s);
        CHECK(back.max_acceleration_mm_s2 == axis.max_acceleration_mm_s2);
        CHECK(back.max_jerk_mm_s3 == axis.max_jerk_mm_s3);
        CHECK(read.inverted[k] == machine.inverted[k]);
        CHECK(read.motors[k].invert_step == machine.motors[k].invert_step);
        REQUIRE(read.travel[k].has_value() == machine.travel[k].has_value());
        if (machine.travel[k] && !notes(settings, "travel_mm of axis " + machine.axis_name[k])) {
            CHECK(read.travel[k]->low == machine.travel[k]->low);
            CHECK(read.travel[k]->high == machine.travel[k]->high);
        }
    }
    CHECK(read.drives_on_at_end == machine.drives_on_at_end);
    CHECK(read.step.step_length_us == machine.step.step_length_us);
    REQUIRE(read.spindle.has_value() == machine.spindle.has_value());
    if (machine.spindle) {
        CHECK(read.spindle->max_rpm == machine.spindle->max_rpm);
        CHECK(read.spindle->min_rpm == machine.spindle->min_rpm);
    }
    if (!notes(settings, "path.max_feed_mm_s")) {
        CHECK(read.settings.max_feed_mm_s == machine.settings.max_feed_mm_s);
    }
    CHECK(grbl_settings(again, "m.toml").lines == settings.lines);
}

/// With up to six decimals.
double random_number(std::mt19937& random, double most) {
    const int decimals = static_cast<int>(random() % 7);
    const double scale = std::pow(10.0, decimals);
    return std::max(1.0, std::floor(most * static_cast<double>(random()) / 4294967296.0 * scale) / scale);
}

std::string random_machine(std::mt19937& random) {
    const auto chance = [&] {
        return random() % 2 == 0;
    };
    std::string axes;
    double fastest[2] = {};
    for (const char name : {'x', 'y', 'z', 'a', 'b', 'c'}) {
        if (name != 'x' && chance()) {
            continue;
        }
        const double velocity = random_number(random, 500.0);
        double& most = fastest[name >= 'x' ? 0 : 1];
        most = std::max(most, velocity);
        axes += fmt::format("[[axis]]\nname = \"{}\"\nmax_velocity_mm_s = {}\nmax_acceleration_mm_s2 = {}\n"
                            "steps_per_mm = {}\n",
                            name, velocity, random_number(random, 2000.0), random_number(random, 1000.0));
        axes += name < 'x' ? "kind = \"rotary\"\n" : "";
        axes += chance() ? fmt::format("max_jerk_mm_s3 = {}\n", random_number(random, 90'000.0)) : "";
        axes += chance() ? "invert = true\n" : "";
        axes += chance() ? "invert_step = true\n" : "";
        const double length = random_number(random, 900.0);
        axes += chance()   ? ""
                : chance() ? fmt::format("travel_mm = [0, {}]\n", length)
                           : fmt::format("travel_mm = [-{}, 0]\n", length);
    }
    std::string text = chance() ? fmt::format("drives_at_end = \"{}\"\n", chance() ? "on" : "off") : "";
    text += fmt::format("[path]\nmax_feed_mm_s = {}\n", fastest[0]);
    text += chance() ? fmt::format("[step]\nstep_length_us = {}\n", random_number(random, 90.0)) : "";
    text += chance() ? "[spindle]\nmax_rpm = 24000.5\nmin_rpm = 6000.25\n" : "";
    return text + axes;
}

} // namespace

TEST_CASE("The lines of every example machine make an equal machine", "[convert]") {
    int machines = 0;
    for (const char* const folder : {"examples", "examples/firmware", "tests/schemas", "tests/serve"}) {
        for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() + "/" + folder)) {
            const std::string text = text_of(entry.path());
            if (entry.path().extension() == ".toml" && text.find("[[axis]]") != std::string::npos &&
                machine_problems(text, "m").empty()) {
                CAPTURE(entry.path().string());
                check_equal(text);
                ++machines;
            }
        }
    }
    CHECK(machines >= 6);
}

TEST_CASE("The lines of random machines make equal machines, and nothing is left out", "[convert]") {
    const unsigned seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int round = 0; round < splinefeed_test::rounds(300); ++round) {
        const std::string text = random_machine(random);
        check_equal(text);
        for (const std::string& note : grbl_settings(text, "m").left_out) {
            CAPTURE(text);
            CHECK(note.find("axis ") == 0); // it has no travel_mm
        }
    }
}

TEST_CASE("A machine file as lines", "[convert]") {
    const GrblSettings settings = grbl_settings(R"(name = "m"
drives_at_end = "on"
sample_period_us = 500
[path]
max_feed_mm_s = 50
chord_error_mm = 0.001
[spindle]
max_rpm = 24000
[[axis]]
name = "z"
max_velocity_mm_s = 12.345678
max_acceleration_mm_s2 = 200
max_jerk_mm_s3 = 5000
steps_per_mm = 400
travel_mm = [-80.5, 0]
[[axis]]
name = "x"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
steps_per_mm = 66.666667
max_braking_mm_s2 = 900
invert = true
travel_mm = [0, 300]
[[axis]]
name = "y"
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
travel_mm = [-10, 20]
[[axis]]
name = "a"
max_velocity_mm_s = 10
max_acceleration_mm_s2 = 10
)",
                                                "m.toml");
    CHECK(settings.lines == "$0=2\n$1=255\n$2=0\n$3=1\n$22=9\n$23=1\n$20=1\n$30=24000\n$31=0\n"
                            "$100=66.666667\n$101=1000\n$102=400\n$103=1000\n"
                            "$110=6000\n$111=6000\n$112=740.74068\n$113=600\n"
                            "$120=1000\n$121=1000\n$122=200\n$123=10\n"
                            "$130=300\n$131=30\n$132=80.5\n"
                            "$800=0\n$801=0\n$802=5000\n$803=0\n");
    const std::vector<std::string> notes{
        "axis a: it is linear, and read back it is not",
        "the order of the axes: grbl's is x, y, z, a, b, c",
        "travel_mm of axis y: it neither begins nor ends at 0; $131 says that it has 30 mm up to 0",
        "axis a has no travel_mm: a controller keeps the $133 that it has",
        "path.max_feed_mm_s: grbl's is the velocity of the fastest axis",
        "keys for which grbl has no number: path.chord_error_mm, sample_period_us, max_braking_mm_s2 of axis x",
    };
    CHECK(settings.left_out == notes);
}
