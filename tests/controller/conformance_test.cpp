// SPDX-License-Identifier: MIT
//
// The cases of conformance.txt, on the controller itself, in virtual time.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "support/virtual_machine_tool.hpp"

#include <fstream>
#include <sstream>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

/// \n, \r, \t, \\ and \xHH.
std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            out += text[i];
            continue;
        }
        const char c = text.at(++i);
        if (c == 'x') {
            out += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
            i += 2;
        } else {
            out += c == 'n' ? '\n' : c == 'r' ? '\r' : c == 't' ? '\t' : c;
        }
    }
    return out;
}

/// * stands for any text.
bool matches(std::string_view pattern, std::string_view line) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
        return pattern == line;
    }
    if (line.substr(0, star) != pattern.substr(0, star)) {
        return false;
    }
    for (std::size_t from = star; from <= line.size(); ++from) {
        if (matches(pattern.substr(star + 1), line.substr(from))) {
            return true;
        }
    }
    return false;
}

/// What a case needs to go on does not happen.
struct CaseFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <Scalar S>
class Case {
public:
    explicit Case(bool bounded) {
        tool_.settings.lines_a_call = bounded ? 1 : tool_.settings.lines_a_call;
        tool_.settings.work_a_call = bounded ? 4 : tool_.settings.work_a_call;
    }

    void run(const std::string& command, const std::string& rest) {
        if (command == ">") {
            tool_.send(unescaped(rest));
            wait(1);
        } else if (command == "times") {
            const std::size_t space = rest.find(' ');
            for (int n = std::stoi(rest.substr(0, space)); n > 0; --n) {
                tool_.send(unescaped(rest.substr(space + 1)));
            }
        } else if (command == "<") {
            expect(rest);
        } else if (command == "wait") {
            wait(std::stoi(rest));
        } else if (command == "until") {
            until(rest);
        } else if (command == "at") {
            require_place(rest);
        } else if (command == "way") {
            CHECK(tool_.machine.distance_mm() == Approx(std::stod(rest)).margin(0.01));
        } else if (command == "machine") {
            set(rest);
        } else if (command == "told") {
            REQUIRE(!tool_.machine.orders.empty());
            CHECK(tool_.machine.orders.back() == rest);
        } else if (command == "connect") {
            tool_.controller->connect();
        } else if (command == "disconnect") {
            tool_.controller->disconnect();
        } else {
            FAIL("unknown command " << command);
        }
    }
    void finish() {
        wait(300);
        CHECK(std::string(left()) == "");
    }

private:
    [[nodiscard]] std::string_view left() const { return std::string_view(tool_.text).substr(seen_); }
    void wait(int ms) {
        for (; ms > 0; --ms) {
            tool_.tick();
        }
    }
    std::string next_line() {
        for (int ms = 0; left().find('\n') == std::string_view::npos && ms < 20000; ++ms) {
            tool_.tick();
        }
        const std::size_t end = left().find('\n');
        if (end == std::string_view::npos) {
            return "(nothing more: " + std::string(left()) + ")";
        }
        const std::string line(left().substr(0, end + 1));
        seen_ += end + 1;
        REQUIRE(line.size() >= 2);
        CHECK(line[line.size() - 2] == '\r');
        return line.substr(0, line.size() - 2);
    }
    void expect(const std::string& pattern) {
        const std::string line = next_line();
        if (!matches(pattern, line)) {
            throw CaseFailed("it said: " + line);
        }
    }
    // A report that the case does not see.
    std::string report() {
        const std::size_t before = tool_.text.size();
        tool_.send("?");
        wait(1);
        const std::size_t begin = tool_.text.find('<', before);
        REQUIRE(begin != std::string::npos);
        const std::size_t end = tool_.text.find('\n', begin) + 1;
        const std::string line = tool_.text.substr(begin, end - begin - 2);
        tool_.text.erase(begin, end - begin);
        return line;
    }
    void until(const std::string& state) {
        std::string line;
        for (int tries = 0; tries < 3000; ++tries) {
            line = report();
            if (line.compare(1, state.size(), state) == 0 && line[1 + state.size()] == '|') {
                return;
            }
            wait(19);
        }
        throw CaseFailed("never " + state + ": " + line);
    }
    void require_place(const std::string& rest) {
        const std::string line = report();
        std::istringstream said(line.substr(line.find("Pos:") + 4));
        std::istringstream wanted(rest);
        double value = 0.0;
        double given = 0.0;
        INFO(line);
        while (wanted >> value) {
            said >> given;
            CHECK(given == Approx(value).margin(0.0015));
            said.ignore(1);
        }
    }
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
            machine.home_found = value != 0.0;
        } else if (what == "known") {
            machine.known = value != 0.0;
        } else if (what == "input") {
            machine.input = static_cast<std::int32_t>(value);
        } else if (what == "spindle") {
            machine.spindle_ms = static_cast<std::uint32_t>(value);
        } else if (what == "probes") {
            tool_.settings.probes = value != 0.0;
        } else if (what == "halts") {
            machine.halts_ms = static_cast<std::uint32_t>(value);
        } else {
            FAIL("unknown machine " << what);
        }
    }

    ControlledTool<S> tool_;
    std::size_t seen_ = 0;
};

/// @param bounded  as a firmware has it: a call does little
template <Scalar S>
void run_cases(bool bounded) {
    std::ifstream file(source_folder() + "/tests/controller/conformance.txt");
    REQUIRE(file.good());
    std::unique_ptr<Case<S>> present;
    std::string name;
    std::string line;
    int number = 0;
    int cases = 0;
    while (std::getline(file, line)) {
        ++number;
        if (line.empty() || line[0] == '#') {
            continue;
        }
        const std::size_t space = line.find(' ');
        const std::string command = line.substr(0, space);
        const std::string rest = space == std::string::npos ? "" : line.substr(space + 1);
        INFO("case: " << (command == "case" ? rest : name) << ", line " << number << ": " << line);
        if (command == "case") {
            if (present) {
                present->finish();
            }
            name = rest;
            present = std::make_unique<Case<S>>(bounded);
            ++cases;
        } else if (present && command != "needs") { // else it has failed; this machine has everything
            try {
                present->run(command, rest);
            } catch (const std::exception& failure) {
                FAIL_CHECK(failure.what());
                present.reset();
            }
        }
    }
    INFO("case: " << name);
    if (present) {
        present->finish();
    }
    CHECK(cases > 40);
}

} // namespace

TEMPLATE_TEST_CASE("the controller answers as its conformance list says", "[controller]", double, Fixed) {
    run_cases<TestType>(false);
}

TEST_CASE("however often its state is asked for, lines are executed", "[controller]") {
    ControllerSettings settings = settings_of_machine_tool();
    VirtualMachineTool machine(settings);
    const auto limits = *MotionLimits<double>::make(settings.machine);
    std::vector<PlannedCell<double>> window(64);
    AccelerationPlanner<double> planner(window);
    ScalarMotion<double> motion(settings, limits, planner);
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
