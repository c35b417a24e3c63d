// SPDX-License-Identifier: MIT
//
// A program that a sender streams moves the machine as a run of its file does, segment by segment.
#include "host_sim/serve/served_motion.hpp"

#include "host/temporary_folder.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "support/catch.hpp"

#include <fmt/format.h>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

class Nobody final : public CurveWatch {
public:
    void segment(const CurveSegment<double>& /*segment*/, std::uint32_t /*row*/,
                 const PathFeeder& /*feeder*/) override {}
};

std::vector<FeedSegment> planned(const RunMachine& machine, const std::string& program) {
    const TemporaryFolder folder;
    PathArguments arguments;
    arguments.input = folder.file("p.nc");
    arguments.format = input_format("gcode");
    arguments.gcode.dialect = "grbl";
    arguments.scalar = ScalarKind::fixed;
    std::ofstream(arguments.input) << program;
    PathInput input(arguments, PathUse::executed, machine.path());
    Nobody nobody;
    const auto path = plan_path(input, machine.machine, nobody, {});
    std::vector<FeedSegment> out;
    FeedSegment segment;
    for (Pull pull = Pull::starved; pull != Pull::finished; pull = path->next(segment, Supply::flows)) {
        if (pull == Pull::item) {
            out.push_back(segment);
            continue;
        }
        PathFeeder::Pushed ignored;
        path->stream().go_on();
        static_cast<void>(path->feeder().more(ignored));
    }
    return out;
}

std::vector<FeedSegment> served(const RunMachine& machine, const std::string& program) {
    const ControllerSettings settings = serve_settings(machine, {});
    ServedMotion of(machine.machine, settings);
    LineMotion& motion = of.motion();
    motion.place({});
    std::vector<FeedSegment> out;
    const auto take = [&](Supply supply) {
        FeedSegment segment;
        Pull pull = Pull::item;
        while ((pull = motion.next(segment, supply)) == Pull::item || pull == Pull::busy) {
            if (pull == Pull::item) {
                out.push_back(segment);
            }
        }
    };
    std::istringstream lines(program);
    std::uint32_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        const BlockStatus status = motion.push(line, ++number);
        CAPTURE(line, describe(status.error));
        REQUIRE(status.ok());
        for (BlockProgress progress = motion.pass_on(); progress != BlockProgress::done; progress = motion.pass_on()) {
            take(progress == BlockProgress::waits ? Supply::late : Supply::flows);
            if (progress == BlockProgress::waits) {
                REQUIRE(motion.exhausted());
                motion.carried_out();
            }
        }
    }
    take(Supply::pauses);
    CHECK_FALSE(motion.left_travel());
    CHECK(motion.exhausted());
    return out;
}

void compare(const RunMachine& machine, const std::string& program) {
    const std::vector<FeedSegment> of_run = planned(machine, program);
    const std::vector<FeedSegment> of_serve = served(machine, program);
    CAPTURE(program, of_run.size(), of_serve.size());
    CHECK(of_run.size() > 100);
    REQUIRE(of_run.size() == of_serve.size());
    for (std::size_t i = 0; i < of_run.size(); ++i) {
        const FeedSegment& a = of_run[i];
        const FeedSegment& b = of_serve[i];
        CAPTURE(i);
        REQUIRE(a.duration_ticks == b.duration_ticks);
        REQUIRE(a.waypoint == b.waypoint);
        REQUIRE(a.start == b.start);
        REQUIRE(a.end == b.end);
        REQUIRE(a.start_velocity == b.start_velocity);
        REQUIRE(a.end_velocity == b.end_velocity);
    }
}

RunMachine machine_of(double jerk_mm_s3) {
    MachineDescription machine = default_machine();
    for (unsigned k = 0; k < 3; ++k) {
        machine.settings.axis[k].max_jerk_mm_s3 = jerk_mm_s3;
        machine.travel[k] = host::Travel{-500.0, 500.0};
    }
    return {std::move(machine), true};
}

} // namespace

TEST_CASE("serve moves the machine as run does, segment by segment", "[serve]") {
    const RunMachine machine = machine_of(GENERATE(0.0, 50'000.0));
    compare(machine,
            "G21 G90\nF1500\nG0 X10\nG1 Y10\nX20 Y14\nG4 P0.2\nG2 X30 Y4 R12\nM8\nG1 Z-2\nG61\nX10\nG64 P0.2\nY0\n"
            "X0\nS100\nM3\nG1 Z5\nM5\n"
            "G1 X5 F600\nM2\n");
    const unsigned seed = Catch::rngSeed();
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::string program = "G21 G90 G64 P0.05\nF2000\n";
    double x = 0.0;
    double y = 0.0;
    for (int i = 0; i < 120; ++i) {
        const bool small = random() % 3 != 0;
        x += number(-1.0, 1.0) * (small ? 1.0 : 20.0);
        y += number(-1.0, 1.0) * (small ? 1.0 : 20.0);
        program += fmt::format("G{} X{:.4f} Y{:.4f}\n", random() % 9 == 0 ? 0 : 1, x, y);
        switch (random() % 12) {
        case 0: program += "G4 P0.01\n"; break;
        case 1: program += fmt::format("F{:.0f}\n", number(300.0, 6000.0)); break;
        case 2: program += fmt::format("G1 X{:.4f} Y{:.4f}\n", x, y); break; // no way
        case 3: program += "M8\nM9\n"; break;
        case 4: program += random() % 2 != 0 ? "G61\n" : "G64 P0.1\n"; break;
        default: break;
        }
    }
    compare(machine, program);
}
