// SPDX-License-Identifier: MIT
#include "host_sim/run/program_steps.hpp"

#include "host_sim/config/machine_file.hpp"
#include "live/talking_target.hpp"
#include "support/catch.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/move_stream/scalar_stream.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

#include <vector>

using namespace splinefeed_test;

namespace {

struct Bench {
    Bench() {
        static_cast<void>(told());
        REQUIRE(stream.place({}).ok());
    }

    /// A move of x, 10 mm on.
    void move() {
        PathElement<double> element;
        element.to = stream.end();
        element.to[0].raw += position_from_mm(10.0).raw;
        element.feed_mm_s = 50.0;
        REQUIRE(stream.push(element).value());
    }
    /// An event behind the moves so far.
    void add(EventKind kind, bool stops) {
        SourceStep step;
        step.kind = StepKind::event;
        step.stops = stops;
        step.line = 1;
        step.action.kind = kind;
        step.action.number = 4;
        if (stops && !waits_for_user(kind) && kind != EventKind::input_wait) {
            step.action.spindle = SpindleTurn{1, 1000.0};
        }
        PathFeeder::Pushed pushed;
        pushed.step = &step;
        pushed.moves = stream.moves();
        if (stops) {
            REQUIRE(stream.stop());
        }
        steps.add(pushed);
    }
    /// Segments until one of the move of that number begins; false: there is none up to the end of what is known.
    bool come_to(std::uint32_t number) {
        FeedSegment segment;
        Pull pull = Pull::item;
        while ((pull = stream.next(segment, Supply::pauses, WorkBudget::unlimited)) == Pull::item) {
            steps.begin(0.0);
            if (segment.waypoint == number) {
                return true;
            }
        }
        return false;
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
    MotionLimits<double> limits = *MotionLimits<double>::make(machine.settings);
    std::vector<PlannedCell<double>> window = std::vector<PlannedCell<double>>(256);
    AccelerationPlanner<double> planner{window};
    ScalarStream<double> stream{limits, planner, rules_cast<double>(path_rules(machine.settings))};
    ProgramSteps steps{figures, stream, false, live};
};

} // namespace

TEST_CASE("What switches without a stop is ordered by the first segment behind its place") {
    Bench bench;
    bench.move();
    bench.add(EventKind::flood_on, false);
    bench.add(EventKind::message, false);
    bench.move();
    bench.add(EventKind::output_on_with_motion, false);
    bench.move();
    REQUIRE(bench.come_to(0));
    CHECK(bench.told().empty());
    REQUIRE(bench.come_to(1));
    CHECK(bench.told() == "flood_on 4");
    REQUIRE(bench.come_to(2));
    CHECK(bench.told() == "output_on_with_motion 4");
    CHECK(bench.steps.summary().events == 3);
}

TEST_CASE("A spindle is ordered at standstill, and the machine stands until it has its speed") {
    Bench bench;
    bench.world.set("slow");
    bench.move();
    bench.add(EventKind::spindle_clockwise, true);
    REQUIRE(bench.come_to(0));
    CHECK_FALSE(bench.steps.stands(0.0)); // on the way
    REQUIRE_FALSE(bench.come_to(1));
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.told(1).empty());
    CHECK(bench.told(1) == "spindle 1 1000");
    CHECK(bench.steps.stands(0.0));
    CHECK_FALSE(bench.stream.has_room());
    bench.world.clear("slow");
    CHECK_FALSE(bench.steps.stands(0.0));
    CHECK(bench.stream.has_room()); // and the next moves come
    bench.add(EventKind::mist_on, false);
    CHECK_FALSE(bench.steps.stands(0.0));
    CHECK(bench.told() == "mist_on 4");
    CHECK(bench.steps.empty());
}

TEST_CASE("A pause begins when the machine has come to its place, and ends when the user says so") {
    Bench bench;
    bench.move();
    bench.add(EventKind::pause, true);
    REQUIRE_FALSE(bench.come_to(1));
    CHECK(bench.steps.stands(0.0));
    bench.steps.go_on(); // nobody has been asked yet
    CHECK_FALSE(bench.live.carried_out());
    CHECK(bench.told().empty());
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.steps.summary().events == 0);
    bench.world.set("turning");
    bench.steps.go_on();
    CHECK_FALSE(bench.steps.stands(0.0));
    CHECK(bench.steps.summary().events == 1);
    bench.add(EventKind::tool_change, true);
    CHECK(bench.steps.stands(0.0)); // now for the tool
    CHECK_FALSE(bench.live.carried_out());
    CHECK(bench.told().empty());
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.steps.summary().events == 1);
    bench.steps.go_on(); // the spindle still turns
    CHECK(bench.steps.stands(0.0));
    bench.world.clear("turning");
    CHECK(bench.steps.stands(0.0));
    bench.steps.go_on();
    CHECK_FALSE(bench.steps.stands(0.0));
    CHECK(bench.steps.summary().events == 2);
}

TEST_CASE("An input is asked at standstill, and the program gets its answer once") {
    Bench bench;
    bench.world.set("level 1");
    bench.move();
    bench.add(EventKind::input_wait, true);
    REQUIRE(bench.come_to(0));
    CHECK_FALSE(bench.steps.stands(0.0)); // on the way
    CHECK(bench.told().empty());
    REQUIRE_FALSE(bench.come_to(1));
    CHECK(bench.steps.stands(0.0));
    CHECK(bench.steps.stands(0.0));
    CHECK_FALSE(bench.steps.take_answer());
    CHECK(bench.told(1).empty());
    CHECK(bench.told(1) == "watch 4, unwatch");
    CHECK_FALSE(bench.steps.stands(0.0));
    CHECK(bench.steps.take_answer() == 1);
    CHECK_FALSE(bench.steps.take_answer());
    CHECK(bench.steps.empty());
}
