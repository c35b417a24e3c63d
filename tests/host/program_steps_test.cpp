// SPDX-License-Identifier: MIT
#include "host_sim/run/program_steps.hpp"

#include "host_sim/config/machine_file.hpp"
#include "live/talking_target.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

namespace {

struct Bench {
    Bench() { static_cast<void>(told()); }

    /// An event behind the move of a row that ends at x.
    void add(EventKind kind, std::uint32_t row, double x_mm, bool stops) {
        SourceStep step;
        step.kind = StepKind::event;
        step.stops = stops;
        step.line = row + 1;
        step.action.kind = kind;
        step.action.number = 4;
        if (stops && !waits_for_user(kind) && kind != EventKind::input_wait) {
            step.action.spindle = SpindleTurn{1, 1000.0};
        }
        SourceStep move;
        move.line = row + 1;
        PathFeeder::Pushed pushed;
        pushed.move = &move;
        pushed.position[0] = position_from_mm(x_mm);
        pushed.step = &step;
        pushed.row = row;
        steps.add(pushed);
    }
    void begin(std::uint32_t row) {
        FeedSegment segment;
        segment.waypoint = row;
        steps.begin(segment, 0.0);
    }

    /// What the machine was told when it has executed so many more segments, at standstill.
    [[nodiscard]] std::string told(int segments = 2) {
        for (int i = 0; i < segments; ++i) {
            REQUIRE(live.submit(segment_between(0.0, 0.0)));
        }
        world.clock.sleep_us(20 * us_per_ms);
        return world.take_told();
    }

    PlanFigures figures = plan_figures(ScalarKind::float64, default_machine());
    TalkingWorld world{"mute", "outputs spindle switches inputs"};
    SignalWatch signals{{}};
    MachineDescription machine = talking_machine();
    TalkingTarget target{world};
    LiveMachine live{target, machine, {.segment_ticks = 8000, .signals = &signals, .clock = &world.clock}, [this] {
                         return world.outputs();
                     }};
    ProgramSteps steps{figures, false, live};
};

} // namespace

TEST_CASE("What switches without a stop is ordered by the first segment behind its place") {
    Bench bench;
    bench.add(EventKind::flood_on, 0, 10.0, false);
    bench.add(EventKind::message, 0, 10.0, false);
    bench.add(EventKind::output_on_with_motion, 1, 20.0, false);
    bench.begin(0);
    CHECK(bench.told().empty());
    bench.begin(1);
    CHECK(bench.told() == "flood_on 4");
    bench.begin(3);
    CHECK(bench.told() == "output_on_with_motion 4");
    CHECK(bench.steps.summary().events == 3);
}

TEST_CASE("A spindle is ordered at standstill, and the machine stands until it has its speed") {
    Bench bench;
    bench.world.set("slow");
    bench.add(EventKind::spindle_clockwise, 0, 10.0, true);
    bench.add(EventKind::mist_on, 0, 10.0, false);
    bench.begin(0);
    PerAxis<double> here{};
    CHECK_FALSE(bench.steps.stands(here, 0.0)); // on the way
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.told(1).empty());
    CHECK(bench.told(1) == "spindle 1 1000");
    CHECK(bench.steps.stands(here, 0.0));
    bench.world.clear("slow");
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.told() == "mist_on 4");
    bench.begin(1);
    CHECK(bench.steps.empty());
}

TEST_CASE("A motion that passes a step without standing for it does not go on") {
    Bench bench;
    bench.add(EventKind::spindle_clockwise, 0, 10.0, true);
    bench.begin(0);
    CHECK_THROWS_WITH(bench.begin(1), "the motion has passed line 1 without standing for it");
    CHECK(bench.told().empty());
}

TEST_CASE("A pause begins when the machine has come to its place, and ends when the user says so") {
    Bench bench;
    bench.add(EventKind::pause, 0, 10.0, true);
    bench.add(EventKind::tool_change, 0, 10.0, true);
    bench.begin(0);
    PerAxis<double> here{};
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    bench.steps.go_on(); // nobody has been asked yet
    CHECK_FALSE(bench.live.carried_out());
    CHECK(bench.told().empty());
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.summary().events == 0);
    bench.world.set("turning");
    bench.steps.go_on();
    CHECK(bench.steps.stands(here, 0.0)); // now for the tool
    CHECK_FALSE(bench.live.carried_out());
    CHECK(bench.told().empty());
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.summary().events == 1);
    bench.steps.go_on(); // the spindle still turns
    CHECK(bench.steps.stands(here, 0.0));
    bench.world.clear("turning");
    CHECK(bench.steps.stands(here, 0.0));
    bench.steps.go_on();
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.summary().events == 2);
}

TEST_CASE("An input is asked at standstill, and the program gets its answer once") {
    Bench bench;
    bench.world.set("level 1");
    bench.add(EventKind::input_wait, 0, 10.0, true);
    bench.begin(0);
    PerAxis<double> here{};
    CHECK_FALSE(bench.steps.stands(here, 0.0)); // on the way
    CHECK(bench.told().empty());
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK_FALSE(bench.steps.take_answer());
    CHECK(bench.told(1).empty());
    CHECK(bench.told(1) == "watch 4, unwatch");
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.take_answer() == 1);
    CHECK_FALSE(bench.steps.take_answer());
    CHECK(bench.steps.empty());
}
