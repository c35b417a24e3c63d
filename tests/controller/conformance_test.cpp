// SPDX-License-Identifier: MIT
//
// The cases of conformance.txt, on the controller itself, in virtual time.
#include "support/catch.hpp"
#include "support/conformance_list.hpp"
#include "support/virtual_machine_tool.hpp"

#include <sstream>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

template <Scalar S>
class ListedTool final : public ListedMachine {
public:
    /// @param bounded  as a firmware has it: a call does little
    explicit ListedTool(bool bounded) {
        tool_.settings.lines_a_call = bounded ? 1 : tool_.settings.lines_a_call;
        tool_.settings.work_a_call = bounded ? 4 : tool_.settings.work_a_call;
    }

    void send(std::string_view bytes) override { tool_.send(bytes); }
    void tick() override { tool_.tick(); }
    [[nodiscard]] Controller& controller() override { return *tool_.controller; }
    [[nodiscard]] std::string& text() override { return tool_.text; }
    void obey(const std::string& command, const std::string& rest) override {
        if (command == "way") {
            CHECK(tool_.machine.distance_mm() == Approx(std::stod(rest)).margin(0.01));
        } else if (command == "told") {
            REQUIRE(!tool_.machine.orders.empty());
            CHECK(tool_.machine.orders.back() == rest);
        } else if (command == "machine") {
            set(rest);
        } else {
            FAIL("unknown command " << command);
        }
    }

private:
    void set(const std::string& rest) {
        std::istringstream words(rest);
        std::string what;
        double value = 0.0;
        words >> what >> value;
        VirtualMachineTool& machine = tool_.machine;
        if (what == "plate") {
            machine.plate = value;
        } else if (what == "inputs") {
            machine.inputs = static_cast<std::uint32_t>(value);
        } else if (what == "alarm") {
            machine.alarm = static_cast<Alarm>(static_cast<int>(value));
            if (machine.alarm != Alarm::none) {
                machine.quick_stop(); // by itself
            }
        } else if (what == "home") {
            machine.home_found = value == 1.0;
            machine.home_clears = value != 2.0;
        } else if (what == "known") {
            machine.known = value != 0.0;
        } else if (what == "input") {
            machine.input = static_cast<std::int32_t>(value);
        } else if (what == "spindle") {
            machine.spindle_ms = static_cast<std::uint32_t>(value);
        } else if (what == "outputs") {
            machine.has_outputs = value != 0.0;
        } else if (what == "slowest") {
            tool_.settings.min_rpm = Decimal::from_integer(static_cast<std::int32_t>(value));
        } else if (what == "homes") {
            tool_.settings.homes = static_cast<std::uint32_t>(value);
        } else if (what == "probes") {
            tool_.settings.probes = value != 0.0;
        } else if (what == "halts") {
            machine.halts_ms = static_cast<std::uint32_t>(value);
        } else {
            FAIL("unknown machine " << what);
        }
    }

    ControlledTool<S> tool_;
};

template <Scalar S>
void run_cases(bool bounded) {
    const int cases = run_conformance_list([bounded] { return std::make_unique<ListedTool<S>>(bounded); },
                                           [](const std::string&, const std::string&) { return true; });
    CHECK(cases > 40);
}

} // namespace

TEMPLATE_TEST_CASE("the controller answers as its conformance list says", "[controller]", double, Fixed) {
    run_cases<TestType>(false);
}

TEST_CASE("an output between two moves that go on straight switches where they meet", "[controller]") {
    ControlledTool<double> tool;
    std::vector<double> at_mm;
    tool.send("G1 X10 F3000\nM62 P3\nX20\nX25\nM63 P3\nX30\nG4 P0.1\n");
    for (int ms = 0; ms < 3000; ++ms) {
        tool.tick();
        at_mm.resize(tool.machine.orders.size(), to_mm(tool.machine.position()[0]));
    }
    REQUIRE(at_mm.size() == 2);
    CHECK(at_mm[0] == Approx(10.0).margin(0.6)); // the machine holds 10 ms of motion
    CHECK(at_mm[1] == Approx(25.0).margin(0.6));
}

TEST_CASE("homing does not begin where its sender has gone, nor what a lock keeps back", "[controller]") {
    const auto [line] = GENERATE(table<std::string>({{"$H\n"}, {"$X\nG0 X100\n"}, {"$X\n$J=X100F3000\n"}}));
    CAPTURE(line);
    ControlledTool<double> tool;
    tool.machine.alarm = Alarm::limit_switch;
    tool.tick();
    tool.machine.alarm = Alarm::none;
    tool.send("\x18");
    for (int ms = 0; ms < 100; ++ms) {
        tool.tick();
    }
    REQUIRE(tool.controller->state() == ControllerState::alarm);
    tool.send(line);
    tool.controller->disconnect();
    for (int ms = 0; ms < 2000; ++ms) {
        tool.tick();
        REQUIRE(tool.controller->state() == ControllerState::alarm);
    }
    CHECK(tool.machine.distance_mm() == 0.0);
}

TEST_CASE("however often its state is asked for, lines are executed", "[controller]") {
    ControllerSettings settings = settings_of_machine_tool();
    VirtualMachineTool machine(settings);
    const auto limits = *MotionLimits<double>::make(settings.machine);
    std::vector<PlannedCell<double>> window(64);
    AccelerationPlanner<double> planner(window);
    ScalarStream<double> stream(limits, planner, rules_cast<double>(path_rules(settings.machine)));
    LineMotion motion(settings, stream);
    std::array<char, 1024> lines{};
    std::array<char, Controller::least_answers> answers{};
    Controller controller(settings, motion, machine, Controller::Memory{lines, answers});
    const auto [asked] = GENERATE(table<std::string>({{"?"}, {"\x83"}}));
    for (int i = 0; i < 200; ++i) {
        controller.receive(asked, 0);
    }
    controller.receive("G21\n", 0);
    controller.execute(1);
    std::array<char, Controller::least_answers> said{};
    const std::string_view text(said.data(), controller.take_answers(said));
    CHECK(text.size() > 1000);
    CHECK(text.substr(text.size() - 4) == "ok\r\n");
}

TEST_CASE("more moves than a path holds, behind one that leaves the travel, end in the alarm", "[controller]") {
    ControlledTool<double> tool;
    tool.send(GENERATE("G0 X50\nG2 X40 I-5 F6000\nG91\n", "G0 X50 Y5\nG5.5 X60 Y0 F6000\nX70 Y0\nX80 Y5\nG91\n"));
    for (int i = 0; i < 20; ++i) {
        tool.send("G3 X-5 Y1 R9\n");
    }
    for (int ms = 0; ms < 3000; ++ms) {
        tool.tick();
    }
    CHECK(tool.text.find("ALARM:2") != std::string::npos);
    CHECK(tool.controller->state() == ControllerState::alarm);
}

TEST_CASE("the controller answers likewise where a call begins one line and plans little", "[controller]") {
    run_cases<Fixed>(true);
}
