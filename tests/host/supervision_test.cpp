// SPDX-License-Identifier: MIT
#include "host_sim/run/supervision.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <unistd.h>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// Takes and executes at once; it says what it was told, in order.
class TalkingTarget final : public RunTarget {
public:
    class Port final : public hal::MotionPort {
    public:
        explicit Port(TalkingTarget& target) : target_(&target) {}

    private:
        [[nodiscard]] int do_room() const noexcept override { return target_->takes ? 1 : 0; }
        [[nodiscard]] bool do_submit(const FeedSegment& segment) noexcept override {
            target_->said("segment " + std::to_string(segment.index));
            return target_->phase == hal::PortPhase::running;
        }
        hal::PortState do_poll() noexcept override { return {target_->phase, target_->executed}; }
        void do_halt() noexcept override { target_->phase = hal::PortPhase::halted; }

        TalkingTarget* target_;
    };

    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    [[nodiscard]] std::string prepare(const FeedSegment& /*first*/) override {
        said("prepare");
        return refusal;
    }
    void complete() override {
        said("complete");
        phase = hal::PortPhase::idle;
    }
    void hold() override {
        said("hold");
        if (halts) {
            port().halt();
        }
    }
    void quick_stop() override {
        said("quick stop");
        if (stops) {
            port().halt();
        }
    }
    [[nodiscard]] std::string holds() const override { return reason; }
    [[nodiscard]] bool achieved() const override { return false; }
    [[nodiscard]] std::string fault() const override { return "a fault"; }
    [[nodiscard]] std::string halted(bool quick) const override { return quick ? "stopped" : "held"; }
    [[nodiscard]] std::string finish() override {
        said("finish");
        return unfinished;
    }
    void release() noexcept override { said("release"); }
    [[nodiscard]] std::string where() const override { return "; there"; }
    void describe(Summary& /*summary*/) const override {}
    void update() override {
        if (breaks) {
            throw std::runtime_error("it broke");
        }
    }

    void said(const std::string& what) {
        const std::lock_guard lock(mutex_);
        said_.push_back(what);
    }
    [[nodiscard]] std::vector<std::string> told() const {
        const std::lock_guard lock(mutex_);
        return said_;
    }

    // Before the thread, or atomic.
    std::string refusal;
    std::string reason;
    std::string unfinished;
    std::atomic<bool> takes{true};
    std::atomic<bool> halts{true};
    std::atomic<bool> stops{true};
    std::atomic<bool> breaks{false};
    std::atomic<hal::PortPhase> phase{hal::PortPhase::running};
    std::atomic<std::uint64_t> executed{0};

private:
    Port port_{*this};
    mutable std::mutex mutex_;
    std::vector<std::string> said_;
};

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

    std::atomic<bool> ended{false};
    std::atomic<bool> lost{false};

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
    [[nodiscard]] double stop_timeout_s() const override { return 0.05; }

    std::atomic<bool> ended{false};
    std::atomic<bool> is_reached{false};
    std::atomic<bool> is_still{true};
    std::atomic<bool> lost{false};

private:
    TalkingTarget* target_;
};

/// A machine with a spindle, or with switches.
template <class Output>
struct With {
    explicit With(TalkingTarget& target) {
        auto made = std::make_unique<Output>(target);
        output = made.get();
        if constexpr (std::is_same_v<Output, TalkingSpindle>) {
            outputs = std::make_unique<ProgramOutputs>(std::move(made), nullptr);
        } else {
            outputs = std::make_unique<ProgramOutputs>(nullptr, std::move(made));
        }
    }
    Output* output;
    std::unique_ptr<ProgramOutputs> outputs;
};

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

FeedSegment segment(std::uint32_t index) {
    FeedSegment one;
    one.index = index;
    one.duration_ticks = 8000;
    return one;
}

/// The signal comes, and the watch has counted it.
void request(int count) {
    REQUIRE(kill(getpid(), SIGINT) == 0);
    for (int i = 0; i < 5000 && SignalWatch::interrupts() < count; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(SignalWatch::interrupts() == count);
}

template <class Condition>
bool comes(Condition condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
}

using Told = std::vector<std::string>;

} // namespace

TEST_CASE("a run's segments reach the target in order, and then its end", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    Supervision supervision(target, signals);
    Told expected{"prepare"};
    for (std::uint32_t i = 0; i < 100; ++i) {
        REQUIRE(supervision.submit(segment(i)));
        expected.push_back("segment " + std::to_string(i));
    }
    CHECK(supervision.finish());
    expected.emplace_back("complete");
    expected.emplace_back("finish");
    CHECK(target.told() == expected);
    CHECK(supervision.where() == "; there");
}

TEST_CASE("drives that are not left as the machine file says end a run with that sentence", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.unfinished = "a drive did not confirm that it is off";
    SECTION("behind a whole motion") {
        Supervision supervision(target, signals);
        REQUIRE(supervision.submit(segment(0)));
        CHECK_FALSE(supervision.finish());
        CHECK(supervision.ending() == "a drive did not confirm that it is off; there");
    }
    SECTION("behind a refusal") {
        target.refusal = "no";
        Supervision supervision(target, signals);
        static_cast<void>(supervision.submit(segment(0)));
        CHECK_FALSE(supervision.finish());
        CHECK(supervision.ending() == "no; a drive did not confirm that it is off; there");
    }
}

TEST_CASE("the planner is ahead of a port that takes nothing by no more than is handed over", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.takes = false;
    Supervision supervision(target, signals);
    std::uint32_t i = 0;
    while (supervision.room()) {
        REQUIRE(supervision.submit(segment(i++)));
    }
    CHECK(i == Supervision::hand_over_us / 1000);
    REQUIRE(comes([&] { return !target.told().empty(); }));
    request(1);
    CHECK_FALSE(supervision.submit(segment(i)));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == "held; there");
    CHECK(target.told() == Told{"prepare", "hold", "finish"});
}

TEST_CASE("a signal is obeyed while the planner does nothing, the second one at once", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.halts = false;
    Supervision supervision(target, signals);
    REQUIRE(supervision.submit(segment(0)));
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    request(1);
    CHECK(comes([&] { return target.told().back() == "hold"; }));
    CHECK_FALSE(supervision.over());
    request(2);
    CHECK(comes([&] { return supervision.over(); }));
    CHECK(target.told() == Told{"prepare", "segment 0", "hold", "quick stop", "finish"});
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == "stopped; there");
}

TEST_CASE("each request is passed on once, and a third signal asks for nothing more", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.halts = target.stops = false;
    Supervision supervision(target, signals);
    REQUIRE(supervision.submit(segment(0)));
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    const auto passes = [] { // twenty looks
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    };
    request(1);
    passes();
    CHECK(target.told() == Told{"prepare", "segment 0", "hold"});
    request(2);
    passes();
    request(3);
    passes();
    CHECK(target.told() == Told{"prepare", "segment 0", "hold", "quick stop"});
    CHECK_FALSE(supervision.over());
    target.phase = hal::PortPhase::halted;
    CHECK(comes([&] { return supervision.over(); }));
    CHECK(supervision.ending() == "stopped; there");
}

TEST_CASE("two signals before the first look are a quick stop", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.halts = false;
    Supervision supervision(target, signals);
    REQUIRE(supervision.submit(segment(0)));
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    // Two signals of different kinds are both pending, however late the watch is woken.
    REQUIRE(kill(getpid(), SIGTERM) == 0);
    REQUIRE(kill(getpid(), SIGHUP) == 0);
    CHECK(comes([&] { return supervision.over(); }));
    const Told told = target.told();
    REQUIRE(told.size() > 2);
    CHECK(told[told.size() - 2] == "quick stop");
    CHECK(told.back() == "finish");
    CHECK_FALSE(supervision.finish());
}

TEST_CASE("a signal before the first segment leaves the drives alone", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    Supervision supervision(target, signals);
    request(1);
    REQUIRE(supervision.submit(segment(0)));
    CHECK_FALSE(supervision.finish());
    CHECK(target.told().empty());
    CHECK(supervision.ending() == "interrupted before anything was moved; the drives were not enabled");
}

TEST_CASE("what a target refuses or why it fails ends the run", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    SECTION("refused") {
        target.refusal = "refused";
    }
    SECTION("fault") {
        target.phase = hal::PortPhase::fault;
    }
    Supervision supervision(target, signals);
    REQUIRE(supervision.submit(segment(0)));
    CHECK(comes([&] { return supervision.over(); }));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == (target.refusal.empty() ? "a fault; there" : "refused; there"));
}

TEST_CASE("the planner learns that its plan is to be held, and the run ends where that ends", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    target.reason = "a limit acts";
    Supervision supervision(target, signals);
    REQUIRE(supervision.submit(segment(0)));
    CHECK(comes([&] { return supervision.hold_asked(); }));
    CHECK_FALSE(supervision.over());
    REQUIRE(supervision.submit(segment(1)));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == "a limit acts; there");
}

TEST_CASE("a planner that leaves before the end has the axes held", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    {
        Supervision supervision(target, signals);
        REQUIRE(supervision.submit(segment(0)));
    }
    const Told told = target.told();
    CHECK(std::count(told.begin(), told.end(), "hold") == 1);
    CHECK(target.phase == hal::PortPhase::halted);
}

TEST_CASE("a spindle gets its order when the machine has come to its place", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSpindle> machine(target);
    TalkingSpindle& spindle = *machine.output;
    Supervision supervision(target, signals, machine.outputs.get());
    target.executed = 1000; // on the way to the references
    REQUIRE(supervision.submit(segment(0)));
    supervision.order(turn(1, 12000.0), true);
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    target.executed = 1002; // the segment, and the first of standstill
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(target.told() == Told{"prepare", "segment 0"});
    target.executed = 1003;
    CHECK(comes([&] { return target.told().back() == "spindle 1 12000"; }));
    CHECK_FALSE(supervision.carried_out());
    spindle.is_reached = true;
    CHECK(supervision.carried_out());
    CHECK(supervision.finish());
    CHECK(target.told() == Told{"prepare", "segment 0", "spindle 1 12000", "complete", "spindle ends", "finish"});
}

TEST_CASE("trouble of a spindle holds the motion and ends the run", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSpindle> machine(target);
    TalkingSpindle& spindle = *machine.output;
    Supervision supervision(target, signals, machine.outputs.get());
    REQUIRE(supervision.submit(segment(0)));
    spindle.is_still = false;
    spindle.lost = true;
    REQUIRE(comes([&] { return supervision.over(); }));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() ==
          "no answer; held; the spindle did not confirm that it stands and may still turn; there");
    const Told told = target.told();
    CHECK(std::find(told.begin(), told.end(), "hold") < std::find(told.begin(), told.end(), "spindle ends"));
}

TEST_CASE("a second signal and a fault end the spindle first of all", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSpindle> machine(target);
    TalkingSpindle& spindle = *machine.output;
    Supervision supervision(target, signals, machine.outputs.get());
    SECTION("the second signal") {
        target.halts = false;
        REQUIRE(supervision.submit(segment(0)));
        REQUIRE(comes([&] { return target.told().size() == 2; }));
        request(1);
        REQUIRE(comes([&] { return target.told().back() == "hold"; }));
        CHECK_FALSE(spindle.ended);
        supervision.order(turn(1, 12000.0), true); // nothing is started any more
        target.executed = 10;
        request(2);
        REQUIRE(comes([&] { return supervision.over(); }));
        CHECK_FALSE(supervision.finish());
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "spindle ends", "quick stop", "finish"});
    }
    SECTION("a fault") {
        REQUIRE(supervision.submit(segment(0)));
        REQUIRE(comes([&] { return target.told().size() == 2; }));
        target.phase = hal::PortPhase::fault;
        REQUIRE(comes([&] { return supervision.over(); }));
        CHECK_FALSE(supervision.finish());
        CHECK(target.told().at(2) == "spindle ends");
        CHECK(supervision.ending() == "a fault; there");
    }
}

TEST_CASE("a program whose spindle does not come to a standstill has not succeeded", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSpindle> machine(target);
    TalkingSpindle& spindle = *machine.output;
    Supervision supervision(target, signals, machine.outputs.get());
    spindle.is_still = false;
    REQUIRE(supervision.submit(segment(0)));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == "the spindle did not confirm that it stands and may still turn; there");
}

TEST_CASE("a spindle that may still turn is told whatever ended the run", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSpindle> machine(target);
    TalkingSpindle& spindle = *machine.output;
    Supervision supervision(target, signals, machine.outputs.get());
    spindle.is_still = false;
    REQUIRE(supervision.submit(segment(0)));
    target.breaks = true;
    REQUIRE(comes([&] { return supervision.over(); }));
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == "it broke; the spindle did not confirm that it stands and may still turn");
    const Told told = target.told();
    CHECK(std::find(told.begin(), told.end(), "spindle ends") < std::find(told.begin(), told.end(), "quick stop"));
}

TEST_CASE("switches act in order when the machine has come to their place, and end with the run", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSwitches> machine(target);
    Supervision supervision(target, signals, machine.outputs.get());
    REQUIRE(supervision.submit(segment(0)));
    supervision.order(switching(EventKind::flood_on), false);
    supervision.order(switching(EventKind::output_on, 3), false);
    REQUIRE(supervision.submit(segment(1)));
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

TEST_CASE("trouble of a line holds the motion and ends the run; nothing is switched after a signal", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    const With<TalkingSwitches> machine(target);
    Supervision supervision(target, signals, machine.outputs.get());
    REQUIRE(supervision.submit(segment(0)));
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    SECTION("trouble") {
        machine.output->lost = true;
        REQUIRE(comes([&] { return supervision.over(); }));
        CHECK_FALSE(supervision.finish());
        CHECK(supervision.ending() == "a line is lost; held; there");
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
        REQUIRE(comes([&] { return supervision.over(); }));
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "switches end", "finish"});
    }
    SECTION("a fault") {
        target.phase = hal::PortPhase::fault;
        REQUIRE(comes([&] { return supervision.over(); }));
        CHECK(target.told() == Told{"prepare", "segment 0", "switches end", "finish"});
    }
}
