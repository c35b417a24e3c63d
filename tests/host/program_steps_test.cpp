// SPDX-License-Identifier: MIT
#include "host_sim/run/program_steps.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

class Orders final : public ProgramOrders {
public:
    void order(const ProgramAction& action, bool standing) override {
        told += std::string(action_name(action.kind)) + (standing ? "! " : " ");
    }
    [[nodiscard]] bool carried_out() const override { return reached; }
    [[nodiscard]] int input() const override { return 1; }
    [[nodiscard]] bool spindle_stands() const override { return stands; }

    std::string told;
    bool reached = false;
    bool stands = true;
};

struct Bench {
    Bench() : figures(plan_figures(ScalarKind::float64, default_machine())), steps(figures, false, &orders) {}

    /// An event behind the move of a row that ends at x.
    void add(EventKind kind, std::uint32_t row, double x_mm, bool stops) {
        SourceStep step;
        step.kind = StepKind::event;
        step.stops = stops;
        step.line = row + 1;
        step.action.kind = kind;
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

    PlanFigures figures;
    Orders orders;
    ProgramSteps steps;
};

} // namespace

TEST_CASE("What switches without a stop is ordered by the first segment behind its place") {
    Bench bench;
    bench.add(EventKind::flood_on, 0, 10.0, false);
    bench.add(EventKind::message, 0, 10.0, false);
    bench.add(EventKind::output_on_with_motion, 1, 20.0, false);
    bench.begin(0);
    CHECK(bench.orders.told.empty());
    bench.begin(1);
    CHECK(bench.orders.told == "flood_on ");
    bench.begin(3);
    CHECK(bench.orders.told == "flood_on output_on_with_motion ");
    CHECK(bench.steps.summary().events == 3);
}

TEST_CASE("A spindle is ordered at standstill, and the machine stands until it has its speed") {
    Bench bench;
    bench.add(EventKind::spindle_clockwise, 0, 10.0, true);
    bench.add(EventKind::mist_on, 0, 10.0, false);
    bench.begin(0);
    PerAxis<double> here{};
    CHECK_FALSE(bench.steps.stands(here, 0.0)); // on the way
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.orders.told == "spindle_clockwise! ");
    bench.orders.reached = true;
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.orders.told == "spindle_clockwise! mist_on ");
    bench.begin(1);
    CHECK(bench.steps.empty());
}

TEST_CASE("A motion that passes a step without standing for it does not go on") {
    Bench bench;
    bench.add(EventKind::spindle_clockwise, 0, 10.0, true);
    bench.begin(0);
    CHECK_THROWS_WITH(bench.begin(1), "the motion has passed line 1 without standing for it");
    CHECK(bench.orders.told.empty());
}

TEST_CASE("A pause begins when the machine has come to its place, and ends when the user says so") {
    Bench bench;
    bench.add(EventKind::pause, 0, 10.0, true);
    bench.add(EventKind::tool_change, 0, 10.0, true);
    bench.begin(0);
    PerAxis<double> here{};
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.orders.told == "stop! ");
    bench.steps.go_on(); // nobody has been asked yet
    bench.orders.reached = true;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.summary().events == 0);
    bench.orders.stands = false;
    bench.steps.go_on();
    CHECK(bench.steps.stands(here, 0.0)); // now for the tool
    CHECK(bench.orders.told == "stop! change_tool! ");
    CHECK(bench.steps.summary().events == 1);
    bench.steps.go_on(); // the spindle still turns
    CHECK(bench.steps.stands(here, 0.0));
    bench.orders.stands = true;
    CHECK(bench.steps.stands(here, 0.0));
    bench.steps.go_on();
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.summary().events == 2);
}

TEST_CASE("An input is asked at standstill, and the program gets its answer once") {
    Bench bench;
    bench.add(EventKind::input_wait, 0, 10.0, true);
    bench.begin(0);
    PerAxis<double> here{};
    CHECK_FALSE(bench.steps.stands(here, 0.0)); // on the way
    CHECK(bench.orders.told.empty());
    here[0] = 10.0;
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.stands(here, 0.0));
    CHECK(bench.orders.told == "input_wait! ");
    CHECK_FALSE(bench.steps.take_answer());
    bench.orders.reached = true;
    CHECK_FALSE(bench.steps.stands(here, 0.0));
    CHECK(bench.steps.take_answer() == 1);
    CHECK_FALSE(bench.steps.take_answer());
    CHECK(bench.steps.empty());
}
