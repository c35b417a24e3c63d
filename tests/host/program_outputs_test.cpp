// SPDX-License-Identifier: MIT
// ProgramOutputs under Supervision: when a spindle and switches get their orders, and when they end.
#include "host_sim/ports/program_outputs.hpp"

#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"
#include "talking_target.hpp"

#include <algorithm>

using namespace splinefeed_test;
using splinefeed::us_per_ms;

namespace {

class TalkingSwitches final : public RunSwitches {
public:
    explicit TalkingSwitches(TalkingTarget& target) : target_(&target) {}
    void act(EventKind kind, std::int32_t number) override {
        target_->said(std::string(action_name(kind)) + " " + std::to_string(number));
    }
    void end() noexcept override {
        if (!ended.exchange(true)) {
            target_->said("switches end");
        }
    }
    [[nodiscard]] std::string trouble() const override { return lost ? "a line is lost" : ""; }
    [[nodiscard]] std::string unconfirmed() const override { return hangs ? "output 3" : ""; }

    std::atomic<bool> ended{false};
    std::atomic<bool> lost{false};
    std::atomic<bool> hangs{false};

private:
    TalkingTarget* target_;
};

/// It says to the target what it was told.
class TalkingSpindle final : public RunSpindle {
public:
    explicit TalkingSpindle(TalkingTarget& target) : target_(&target) {}

    void order(int direction, double rpm) override {
        target_->said("spindle " + std::to_string(direction) + " " + std::to_string(static_cast<int>(rpm)));
    }
    void end() override {
        if (!ended.exchange(true)) {
            target_->said("spindle ends");
        }
    }
    [[nodiscard]] bool reached() const override { return is_reached; }
    [[nodiscard]] bool stands() const override { return is_still; }
    [[nodiscard]] std::string trouble() const override { return lost ? "no answer" : ""; }
    [[nodiscard]] double stop_timeout_s() const override { return timeout_s; }

    std::atomic<bool> ended{false};
    std::atomic<bool> is_reached{false};
    std::atomic<bool> is_still{true};
    double timeout_s = 0.05;
    std::atomic<bool> lost{false};

private:
    TalkingTarget* target_;
};

/// Input 4 alone; it has a level, or none has been read.
class TalkingInputs final : public RunInputs {
public:
    explicit TalkingInputs(TalkingTarget& target) : target_(&target) {}

    [[nodiscard]] bool watch(std::int32_t number) override {
        target_->said("watch " + std::to_string(number));
        return number == 4;
    }
    void unwatch() override { target_->said("unwatch"); }
    [[nodiscard]] std::optional<InputReading> take() override {
        const int now = level;
        return now < 0 ? std::nullopt : std::optional(InputReading{now > 0, hal::system_clock().now_us()});
    }
    [[nodiscard]] std::string trouble() const override { return lost ? "an input is lost" : ""; }

    std::atomic<int> level{-1};
    std::atomic<bool> lost{false};

private:
    TalkingTarget* target_;
};

template <class Output>
std::unique_ptr<ProgramOutputs> outputs_of(std::unique_ptr<Output> output) {
    ProgramOutputs::Switches switches;
    ProgramOutputs::Inputs inputs;
    std::unique_ptr<RunSpindle> spindle;
    if constexpr (std::is_same_v<Output, TalkingSpindle>) {
        spindle = std::move(output);
    } else if constexpr (std::is_same_v<Output, TalkingSwitches>) {
        switches.push_back(std::move(output));
    } else {
        inputs.push_back(std::move(output));
    }
    return std::make_unique<ProgramOutputs>(std::move(spindle), std::move(switches), std::move(inputs));
}

/// The run of a machine with a spindle, switches or inputs.
template <class Output>
struct Talking {
    SignalWatch signals{{}};
    TalkingTarget target;
    std::unique_ptr<Output> made = std::make_unique<Output>(target);
    Output& output = *made;
    std::unique_ptr<ProgramOutputs> outputs = outputs_of(std::move(made));
};
using SpindleRun = RunOf<Talking<TalkingSpindle>>;
using SwitchRun = RunOf<Talking<TalkingSwitches>>;
using InputRun = RunOf<Talking<TalkingInputs>>;

ProgramAction turn(int direction, double rpm) {
    ProgramAction action;
    action.kind = EventKind::spindle_clockwise;
    action.spindle = SpindleTurn{direction, rpm};
    return action;
}

ProgramAction switching(EventKind kind, std::int32_t number = 0) {
    ProgramAction action;
    action.kind = kind;
    action.number = number;
    return action;
}

ProgramAction question(InputWait wait, double timeout_s) {
    ProgramAction action = switching(EventKind::input_wait, 4);
    action.wait = wait;
    action.value = timeout_s;
    return action;
}

} // namespace

TEST_CASE_METHOD(SpindleRun, "a spindle gets its order when the machine has come to its place", "[supervision]") {
    target.executed = 1000; // on the way to the references
    submit();
    supervision.order(turn(1, 12000.0), true);
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    target.executed = 1002; // the segment, and the first of standstill
    stays({"prepare", "segment 0"});
    target.executed = 1003;
    CHECK(comes([&] { return target.told().back() == "spindle 1 12000"; }));
    CHECK_FALSE(supervision.carried_out());
    output.is_reached = true;
    CHECK(supervision.carried_out());
    CHECK(supervision.finish());
    CHECK(target.told() == Told{"prepare", "segment 0", "spindle 1 12000", "complete", "spindle ends", "finish"});
}

TEST_CASE_METHOD(SpindleRun, "trouble of a spindle holds the motion and ends the run", "[supervision]") {
    submit();
    output.is_still = false;
    output.lost = true;
    is_over();
    fails("no answer; held; the spindle did not confirm that it stands and may still turn; there");
    const Told told = target.told();
    CHECK(std::find(told.begin(), told.end(), "hold") < std::find(told.begin(), told.end(), "spindle ends"));
}

TEST_CASE_METHOD(SpindleRun, "a second signal and a fault end the spindle first of all", "[supervision]") {
    SECTION("the second signal") {
        target.halts = false;
        move();
        request(1);
        REQUIRE(comes([&] { return target.told().back() == "hold"; }));
        CHECK_FALSE(output.ended);
        supervision.order(turn(1, 12000.0), true); // nothing is started any more
        target.executed = 10;
        request(2);
        is_over();
        CHECK_FALSE(supervision.finish());
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "spindle ends", "quick stop", "finish"});
    }
    SECTION("a fault") {
        move();
        target.phase = hal::PortPhase::fault;
        is_over();
        CHECK_FALSE(supervision.finish());
        CHECK(target.told().at(2) == "spindle ends");
        CHECK(supervision.ending() == "a fault; there");
    }
}

TEST_CASE_METHOD(SpindleRun, "a program whose spindle does not come to a standstill has not succeeded",
                 "[supervision]") {
    output.is_still = false;
    submit();
    fails("the spindle did not confirm that it stands and may still turn; there");
}

TEST_CASE_METHOD(SpindleRun, "a spindle that may still turn is told whatever ended the run", "[supervision]") {
    output.is_still = false;
    submit();
    target.breaks = true;
    is_over();
    fails("it broke; held; the spindle did not confirm that it stands and may still turn; there");
    const Told told = target.told();
    CHECK(std::find(told.begin(), told.end(), "spindle ends") < std::find(told.begin(), told.end(), "quick stop"));
}

TEST_CASE_METHOD(SwitchRun, "switches act in order when the machine has come to their place, and end with the run",
                 "[supervision]") {
    submit();
    supervision.order(switching(EventKind::flood_on), false);
    supervision.order(switching(EventKind::output_on, 3), false);
    submit(1);
    supervision.order(switching(EventKind::coolant_off), false);
    REQUIRE(comes([&] { return target.told().size() == 3; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(target.told().size() == 3);
    CHECK_FALSE(supervision.carried_out());
    target.executed = 1;
    CHECK(comes([&] { return target.told().size() == 5; }));
    target.executed = 2;
    CHECK(comes([&] { return target.told().size() == 6; }));
    CHECK(supervision.carried_out());
    CHECK(supervision.finish());
    CHECK(target.told() == Told{"prepare", "segment 0", "segment 1", "flood_on 0", "output_on 3", "coolant_off 0",
                                "complete", "switches end", "finish"});
}

TEST_CASE_METHOD(SwitchRun, "trouble of a line holds the motion and ends the run; nothing is switched after a signal",
                 "[supervision]") {
    move();
    SECTION("trouble") {
        output.lost = true;
        is_over();
        fails("a line is lost; held; there");
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "switches end", "finish"});
    }
    SECTION("a signal") {
        target.halts = false;
        request(1);
        REQUIRE(comes([&] { return target.told().back() == "hold"; }));
        supervision.order(switching(EventKind::mist_on), false);
        target.executed = 10;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        CHECK(target.told().back() == "hold"); // and what is on stays on, until the machine stands
        target.phase = hal::PortPhase::halted;
        is_over();
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "switches end", "finish"});
    }
    SECTION("a fault") {
        target.phase = hal::PortPhase::fault;
        is_over();
        CHECK(target.told() == Told{"prepare", "segment 0", "switches end", "finish"});
    }
}

TEST_CASE_METHOD(InputRun, "an input is read when the machine stands, until it answers", "[supervision]") {
    output.level = 1; // as it was before
    submit();
    supervision.order(question(InputWait::low, 60.0), true);
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    output.level = 0;
    target.executed = 2;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(target.told().size() == 2);
    output.level = 1;
    target.executed = 3;
    REQUIRE(comes([&] { return target.told().back() == "watch 4"; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK_FALSE(supervision.carried_out());
    output.level = 0;
    CHECK(comes([&] { return supervision.carried_out(); }));
    CHECK(supervision.input() == 0);
    supervision.order(question(InputWait::high, 0.05), true);
    CHECK(comes([&] { return supervision.carried_out(); }));
    CHECK(supervision.input() == -1);
    CHECK(supervision.finish());
    CHECK(target.told() ==
          Told{"prepare", "segment 0", "watch 4", "unwatch", "watch 4", "unwatch", "complete", "finish"});
}

TEST_CASE_METHOD(InputRun, "another order does not answer a question; one of no input ends it", "[supervision]") {
    submit();
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    target.executed = 1;
    supervision.order(question(InputWait::low, 60.0), false);
    REQUIRE(comes([&] { return target.told().back() == "watch 4"; }));
    supervision.order(switching(EventKind::coolant_off), false);
    supervision.order(turn(1, 100.0), false);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK_FALSE(supervision.carried_out());
    supervision.order(switching(EventKind::input_wait, -1), false);
    CHECK(comes([&] { return supervision.carried_out(); }));
    CHECK(supervision.finish());
}

TEST_CASE_METHOD(InputRun, "an input that never answers does not keep a run from its end", "[supervision]") {
    target.executed = 10;
    submit();
    SECTION("a signal") {
        supervision.order(question(InputWait::high, 1000.0), true);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        request(1);
        is_over();
        CHECK(supervision.ending() == "held; there");
    }
    SECTION("its trouble") {
        output.lost = true;
        is_over();
        CHECK(supervision.ending() == "an input is lost; held; there");
    }
}

TEST_CASE_METHOD(SwitchRun, "an output that does not confirm its end is said", "[supervision]") {
    output.hangs = true;
    submit();
    fails("output 3 did not confirm its last level; there");
}

TEST_CASE("the end waits for each output as long as that one may take", "[supervision]") {
    TalkingTarget target;
    VirtualClock clock;
    auto made = std::make_unique<TalkingSpindle>(target);
    TalkingSpindle& spindle = *made;
    spindle.timeout_s = 10.0;
    ProgramOutputs::Switches switches;
    switches.push_back(std::make_unique<TalkingSwitches>(target));
    auto& lines = static_cast<TalkingSwitches&>(*switches.back());
    ProgramOutputs outputs(std::move(made), std::move(switches), {}, clock);
    outputs.end();
    CHECK_FALSE(outputs.ends());
    lines.hangs = true; // a module that does not answer
    clock.sleep_us(900 * us_per_ms);
    CHECK(outputs.ends());
    clock.sleep_us(200 * us_per_ms);
    CHECK_FALSE(outputs.ends());
    CHECK(outputs.unended() == "output 3 did not confirm its last level");
    spindle.is_still = false;
    clock.sleep_us(8800 * us_per_ms);
    outputs.end(); // once more: the time counts from the first
    CHECK(outputs.ends());
    clock.sleep_us(200 * us_per_ms);
    CHECK_FALSE(outputs.ends());
    CHECK(outputs.unended() ==
          "the spindle did not confirm that it stands and may still turn; output 3 did not confirm "
          "its last level");
}
