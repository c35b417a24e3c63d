// SPDX-License-Identifier: MIT
//
// Programs on a served machine of lines: how they flow, and what they switch.
#include "operated_lines.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed_test;

TEST_CASE("a program that is streamed line by line never waits, and takes as long as a run of it", "[serve]") {
    constexpr double run_ms = 6315.0; // splinefeed run circle.ngc --dialect grbl -m tests/serve/machine.toml
    constexpr int ahead = 20;         // lines that the sender has on their way
    ServedLines machine;
    std::vector<std::string> program{"G1 F3000\n"};
    for (int n = 0; n < 600; ++n) {
        program.push_back(fmt::format("X{:.3f}Y{:.3f}\n", 40 + 20 * std::cos(n / 50.0), 40 + 20 * std::sin(n / 50.0)));
    }
    std::size_t sent = 0;
    std::size_t answered = 0;
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t longest_ns = 0;
    for (int ms = 0; ms < 20'000 && (ms < 1000 || machine.controller->state() != ControllerState::idle); ++ms) {
        for (; sent < program.size() && sent < answered + ahead; ++sent) {
            machine.send(program[sent]);
        }
        machine.tick();
        for (; machine.text.rfind("ok\r\n", 0) == 0; machine.text.erase(0, 4)) {
            ++answered;
        }
        if (const std::uint64_t step_ns = machine.last_step_ns(); step_ns != last_ns) {
            longest_ns = last_ns != 0 ? std::max(longest_ns, step_ns - last_ns) : 0;
            first_ns = first_ns == 0 ? step_ns : first_ns;
            last_ns = step_ns;
        }
    }
    CHECK(answered == program.size());
    CHECK(longest_ns < 5'000'000);
    CHECK(std::fabs(static_cast<double>(last_ns - first_ns) * 1e-6 - run_ms) < 0.01 * run_ms);
}

TEST_CASE("spindle, coolant, outputs and an input of a program are lines", "[serve]") {
    std::string text = served_machine();
    text.replace(text.find("[spindle]\n"), 10, "[spindle]\nenable = { line = \"SPINDLE\" }\nspin_up_s = 0.3\n");
    text += "[lines]\nchip = \"/dev/gpiochip1\"\n[coolant.flood]\nline = \"FLOOD\"\n"
            "[[output]]\nnumber = 3\nline = \"CLAMP\"\n[[input]]\nnumber = 2\nline = \"READY\"\n";
    OperatedLines machine(served_map, 7, text);
    const auto rows = [&] {
        return machine.chips.chip.at(0)->rows();
    };
    std::vector<double> at_mm; // x, where lines were set
    const auto until_ok = [&](int lines) {
        machine.text.clear();
        for (int ms = 0; ms < 20'000; ++ms) {
            int oks = 0;
            for (std::size_t i = 0; (i = machine.text.find("ok", i)) != std::string::npos; ++i) {
                ++oks;
            }
            if (oks == lines) {
                return true;
            }
            machine.tick();
            at_mm.resize(rows().size(), machine.mm(0));
        }
        return false;
    };
    machine.send("M3 S1000\n");
    const std::uint64_t begun_ns = machine.clock.now_ns();
    REQUIRE(until_ok(1));
    CHECK(machine.clock.now_ns() - begun_ns > 290'000'000);
    machine.send("M8\nG1 X10 F3000\nM62 P3\nX20\nM63 P3\nX30\nM9\nM5\nG4 P0.1\n");
    REQUIRE(until_ok(9));
    REQUIRE(rows().size() == 6); // spindle, flood, clamp on and off, flood, spindle
    CHECK(at_mm[1] == 0.0);
    CHECK(at_mm[2] == Approx(10.0).margin(0.3));
    CHECK(at_mm[3] == Approx(20.0).margin(0.3));
    CHECK(at_mm[4] == 30.0);
    CHECK(rows().back().levels == 0);
    machine.send("M66 P2 L3 Q5\nG1 X40\nG4 P0.1\n");
    machine.text.clear();
    machine.wait(1000);
    CHECK(machine.mm(0) == 30.0);
    CHECK(machine.text.empty());
    machine.chips.inputs.at(0)->now = 1;
    REQUIRE(until_ok(3));
    CHECK(machine.mm(0) == 40.0);
    machine.send("M8\nM3 S500\nG1 X200\n");
    REQUIRE(until_ok(3));
    machine.wait(500);
    machine.press(ServedLines::e_stop, true);
    machine.wait(5);
    CHECK(rows().back().levels == 0); // all off
}
