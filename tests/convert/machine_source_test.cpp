// SPDX-License-Identifier: MIT
#include "host_sim/convert/machine_source.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"
#include "support/golden_text.hpp"
#include "support/places.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

constexpr const char* files[] = {"mill.ini", "gantry.ini", "printer.cfg", "corexy.cfg", "m503.txt", "m503_old.txt"};
constexpr std::string_view kinds[] = {"linuxcnc", "linuxcnc", "klipper", "klipper", "marlin", "marlin"};

std::string text_of(const std::string& file) {
    std::ifstream in(splinefeed::test::source_folder() + "/tests/convert/" + file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    REQUIRE(text.str().size() > 100);
    return text.str();
}

std::string made_of(const std::string& text, const std::string& file) {
    MachineAnswers nobody(AnswerSource::nobody, file);
    return machine_text(read_machine(machine_source("", text, file), text, file, nobody));
}

MachineDescription machine_of(const std::string& file) {
    return parse_machine(made_of(text_of(file), file), file);
}

std::string refusal(const std::string& text) {
    try {
        static_cast<void>(made_of(text, "f"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void check_axis(const MachineDescription& machine, unsigned k, std::array<double, 3> numbers,
                std::optional<std::array<double, 2>> travel) {
    CAPTURE(machine.name, k);
    const AxisSettings& axis = machine.settings.axis[k];
    CHECK(axis.max_velocity_mm_s == Approx(numbers[0]));
    CHECK(axis.max_acceleration_mm_s2 == Approx(numbers[1]));
    CHECK(axis.steps_per_mm == Approx(numbers[2]));
    REQUIRE(machine.travel[k].has_value() == travel.has_value());
    if (travel) {
        CHECK(machine.travel[k]->low == Approx((*travel)[0]));
        CHECK(machine.travel[k]->high == Approx((*travel)[1]));
    }
}

} // namespace

TEST_CASE("Files of four kinds become the machine files of machines.txt, which their readers take") {
    std::string all;
    for (std::size_t i = 0; i < std::size(files); ++i) {
        const std::string text = text_of(files[i]);
        CAPTURE(files[i]);
        REQUIRE(find_machine_source(text) != nullptr);
        CHECK(find_machine_source(text)->name == kinds[i]);
        const std::string machine = made_of(text, files[i]);
        CHECK(machine_problems(machine, files[i]).empty());
        all += machine + "\n";
        std::string dos = text; // lines of another system
        for (std::size_t at = 0; (at = dos.find('\n', at)) != std::string::npos; at += 2) {
            dos.insert(at, 1, '\r');
        }
        CHECK(made_of(dos, files[i]) == machine);
    }
    splinefeed_test::require_golden("convert/machines.txt", all);
}

TEST_CASE("The numbers are those of the files, in mm and seconds") {
    using Range = std::array<double, 2>;
    const MachineDescription mill = machine_of("mill.ini");
    CHECK(mill.settings.axes == 4);
    CHECK(mill.settings.max_feed_mm_s == 45.0);
    CHECK(mill.spindle->max_rpm == 6000.0);
    CHECK(mill.step.step_length_us == 5.0);
    CHECK(mill.step.direction_setup_us == 5.0);
    check_axis(mill, 0, {40.0, 250.0, 400.0}, Range{-0.5, 320.25}); // the joint accelerates less
    check_axis(mill, 1, {40.0, 300.0, 400.0}, Range{-150.0, 0.0});
    CHECK((mill.inverted[1] && !mill.inverted[0]));
    check_axis(mill, 2, {20.0, 150.0, 800.0}, Range{-90.0, 1.0});
    check_axis(mill, 3, {36.0, 180.0, 88.888889}, std::nullopt);
    CHECK(mill.settings.axis[3].rotary);
    const MachineDescription gantry = machine_of("gantry.ini");
    CHECK(gantry.settings.max_feed_mm_s == 127.0);
    check_axis(gantry, 0, {127.0, 508.0, 80.0}, Range{0.0, 1016.0});
    check_axis(gantry, 1, {88.9, 508.0, 80.0}, Range{0.0, 1524.0}); // the slower of its joints
    CHECK(gantry.motors[1].count == 2);
    check_axis(gantry, 2, {38.1, 381.0, 1000.0}, std::nullopt);
    const MachineDescription printer = machine_of("printer.cfg");
    CHECK(printer.settings.max_feed_mm_s == 300.0);
    check_axis(printer, 0, {300.0, 2500.0, 80.0}, Range{-3.5, 235.0}); // the later of two counts
    CHECK((printer.motors[0].invert_direction[0] && !printer.motors[1].invert_direction[0]));
    check_axis(printer, 1, {300.0, 2500.0, 200.0}, Range{0.0, 230.0});
    check_axis(printer, 2, {12.0, 150.0, 2400.0}, Range{-2.0, 250.0});
    CHECK((printer.motors[2].count == 2 && printer.motors[2].invert_step));
    const MachineDescription corexy = machine_of("corexy.cfg");
    check_axis(corexy, 0, {500.0, 15000.0, 1000.0}, Range{0.0, 350.0}); // steps are not stated: the usual
    check_axis(corexy, 2, {500.0, 15000.0, 1600.0}, Range{0.0, 340.0});
    const MachineDescription marlin = machine_of("m503.txt");
    CHECK(marlin.settings.max_feed_mm_s == 300.0);
    check_axis(marlin, 0, {300.0, 500.0, 80.0}, std::nullopt); // M204 P is lower than M201 X
    check_axis(marlin, 1, {250.0, 400.0, 80.0}, std::nullopt);
    check_axis(marlin, 2, {5.0, 100.0, 400.0}, std::nullopt);
    CHECK(marlin.settings.axes == 3);
    check_axis(machine_of("m503_old.txt"), 2, {5.08, 1016.0, 400.0}, std::nullopt); // inches
}

TEST_CASE("A number of each file that is none is refused with its line, wherever it stands") {
    for (const char* const file : files) {
        const std::vector<std::string> lines = splinefeed_test::split_lines(text_of(file));
        std::string machine = made_of(text_of(file), file);
        machine.resize(std::min(machine.find("# What a machine file does not say"), machine.size()));
        int refused = 0;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::size_t sign = lines[i].find_first_of("=:");
            const std::size_t digit = sign != std::string::npos ? lines[i].find_first_of("0123456789", sign) : sign;
            if (machine.find(fmt::format("# line {}: [", i + 1)) == std::string::npos || digit == std::string::npos ||
                lines[i].find("pin") != std::string::npos) {
                continue;
            }
            std::vector<std::string> wrong = lines;
            wrong[i].insert(digit, "1,");
            CAPTURE(file, wrong[i]);
            CHECK(refusal(fmt::format("{}\n", fmt::join(wrong, "\n"))).find(fmt::format("f:{}: [", i + 1)) == 0);
            ++refused;
        }
        CHECK((refused >= 3 || std::string_view(file).starts_with("m503")));
    }
}

TEST_CASE("What a text looks like decides, and the option where it looks like nothing") {
    CHECK(find_machine_source("") == nullptr);
    CHECK(find_machine_source("[path]\nmax_feed_mm_s = 1\n[[axis]]\nname = 'x'\n") == nullptr);
    CHECK(find_machine_source("M92 X80\n") == nullptr);
    CHECK(machine_source("marlin", "", "f").name == "marlin");
    CHECK_THROWS_WITH(machine_source("auto", "hello\n", "f"),
                      "f: what it is cannot be told; name it by --from: grbl, linuxcnc, klipper, marlin");
    CHECK_THROWS_WITH(machine_source("mach3", "", "f"),
                      "--from 'mach3': it must be one of grbl, linuxcnc, klipper, marlin and auto");
}
