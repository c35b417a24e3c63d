// SPDX-License-Identifier: MIT
// How a run on GPIO lines stops, on a virtual clock: whatever asks for it, and whatever the planner does meanwhile.
#include "port_rig.hpp"
#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr PerAxis<double> to_mm{200.0, 100.0};

MachineDescription with_travel() {
    MachineDescription machine = two_axes();
    machine.travel[0] = {0.0, 10.0};
    return machine;
}

struct Bench : TargetRig {
    explicit Bench(const RunOptions& options = {}) : TargetRig(with_travel(), map_text, options) {}

    [[nodiscard]] double now_ms() const {
        return static_cast<double>(clock.now_ns() - began_ns) / static_cast<double>(ns_per_ms);
    }
    /// Steps on the line of an axis from some row on: rising edges.
    [[nodiscard]] std::int64_t steps(unsigned axis, std::size_t from_row = 1) const {
        std::int64_t count = 0;
        for (std::size_t i = std::max<std::size_t>(from_row, 1); i < lines->rows().size(); ++i) {
            count += (~lines->rows()[i - 1].levels & lines->rows()[i].levels) >> (2 * axis) & 1U;
        }
        return count;
    }
    [[nodiscard]] double last_step_ms() const {
        for (std::size_t i = lines->rows().size() - 1; i > 0; --i) {
            if ((~lines->rows()[i - 1].levels & lines->rows()[i].levels & 0b101U) != 0) {
                return static_cast<double>(lines->rows()[i].at_ns - began_ns) / static_cast<double>(ns_per_ms);
            }
        }
        return 0.0;
    }

    std::uint64_t began_ns = clock.now_ns();
};

/// What happens in a run, and when. [ms]
struct Story {
    enum class Cause { none, hold, quick_stop, hold_then_quick_stop, e_stop, limit, broken_line };
    Cause cause = Cause::none;
    double at_ms = 0.0;
    bool blocked = false;  ///< from that instant on the planner delivers nothing
    bool with_edge = true; ///< the switch reports an edge; else only its level changes
};

struct Outcome {
    hal::PortPhase phase = hal::PortPhase::running;
    std::string why;
    double standstill_ms = 0.0; ///< from the cause to the last step
    double over_ms = 0.0;       ///< and to the end of the run
    std::int64_t after = 0;     ///< steps after the end
};

Outcome run_of(Bench& bench, const Story& story) {
    TargetRun run(bench, to_mm);
    hal::MotionPort& port = run.port;
    bool caused = false;
    bool twice = false;
    Outcome outcome;
    const double begin_ms = bench.now_ms();
    double caused_ms = 0.0;
    for (int i = 0; i < 30'000 && outcome.phase == hal::PortPhase::running; ++i) {
        const double t = bench.now_ms() - begin_ms;
        if (!caused && story.cause != Story::Cause::none && t >= story.at_ms) {
            caused = true;
            bench.clock.sleep_us(static_cast<std::uint64_t>(1000.0 * (story.at_ms - std::floor(story.at_ms))));
            caused_ms = bench.now_ms();
            switch (story.cause) {
            case Story::Cause::none: break;
            case Story::Cause::hold:
            case Story::Cause::hold_then_quick_stop: port.halt(); break;
            case Story::Cause::quick_stop: port.quick_stop(); break;
            case Story::Cause::e_stop: bench.lines->drive(e_stop, true, story.with_edge); break;
            case Story::Cause::limit: bench.lines->drive(limit, true, story.with_edge); break;
            case Story::Cause::broken_line: bench.lines->fail(true); break;
            }
        }
        if (story.cause == Story::Cause::hold_then_quick_stop && caused && !twice && t >= story.at_ms + 20.0) {
            twice = true;
            port.quick_stop();
        }
        outcome.phase = run.tick(!(caused && story.blocked));
    }
    outcome.why = outcome.phase == hal::PortPhase::fault    ? port.failure().what
                  : outcome.phase == hal::PortPhase::halted ? run.target.halted(twice)
                                                            : run.target.signs().holds;
    outcome.standstill_ms = std::max(0.0, bench.last_step_ms() - caused_ms);
    outcome.over_ms = bench.now_ms() - caused_ms;
    const std::size_t rows = bench.lines->rows().size();
    bench.clock.sleep_us(500'000);
    outcome.after = bench.steps(0, rows) + bench.steps(1, rows);
    return outcome;
}

/// The last step of each axis lies on the straight line, and the target knows where.
void require_on_path(const Bench& bench) {
    const auto x = static_cast<double>(bench.steps(0));
    const auto y = static_cast<double>(bench.steps(1));
    CHECK(std::fabs(y - x * to_mm[1] / to_mm[0]) <= 1.0);
    CHECK(bench.target->where() ==
          fmt::format("; the machine stands at x={:.4f} y={:.4f} mm", x / steps_per_mm, y / steps_per_mm));
}

} // namespace

TEST_CASE("a run on lines ends where its plan ends", "[stopping]") {
    Bench bench;
    const Outcome outcome = run_of(bench, {});
    CHECK(outcome.phase == hal::PortPhase::idle);
    CHECK(bench.steps(0) == 16'000);
    CHECK(bench.steps(1) == 8'000);
    CHECK(bench.lines->enabled());
    bench.target.reset(); // the lines, which it owns, become safe with it
}

TEST_CASE("every stop stops, at any time, whether the planner delivers or is blocked", "[stopping]") {
    using Cause = Story::Cause;
    struct Kind {
        const char* name;
        Cause cause;
        bool blocked;
        double standstill_ms; // stated in docs/explanation/stopping.md
        hal::PortPhase phase;
        const char* why;
    };
    // 80 ms are held at full speed, 100 ms is the braking time, and a plan acts with its next segment.
    const std::array kinds{
        Kind{"signal", Cause::hold, false, 182.0, hal::PortPhase::idle, "interrupted: held on the path"},
        Kind{"signal, planner blocked", Cause::hold, true, 132.0, hal::PortPhase::halted,
             "interrupted: held on the path"},
        Kind{"second signal", Cause::hold_then_quick_stop, false, 122.0, hal::PortPhase::halted, "interrupted twice"},
        Kind{"two signals at once, planner blocked", Cause::quick_stop, true, 102.0, hal::PortPhase::halted,
             "interrupted twice"},
        Kind{"limit switch", Cause::limit, false, 184.0, hal::PortPhase::idle, "the limit of axis x (line 1) acts"},
        Kind{"limit switch, planner blocked", Cause::limit, true, 134.0, hal::PortPhase::halted,
             "the limit of axis x (line 1) acts"},
        Kind{"e-stop", Cause::e_stop, false, 0.6, hal::PortPhase::fault,
             "the e-stop was pressed: the drives were disabled"},
        Kind{"e-stop, planner blocked", Cause::e_stop, true, 0.6, hal::PortPhase::fault,
             "the e-stop was pressed: the drives were disabled"},
        Kind{"a line that cannot be set", Cause::broken_line, false, 0.6, hal::PortPhase::fault,
             "a line cannot be set"},
    };
    const std::uint64_t seed = 20'261;
    fmt::print("stops on GPIO lines, seed {}:\n", seed);
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        double worst_ms = 0.0;
        double over_ms = 0.0;
        std::int64_t after = 0;
        for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds(4, 80)); ++round) {
            RandomPath random(seed + 1000 * kind + round);
            Story story{.cause = kinds[kind].cause,
                        .at_ms = random.between(10.0, 2000.0),
                        .blocked = kinds[kind].blocked,
                        .with_edge = true};
            Bench bench;
            CAPTURE(kinds[kind].name, story.at_ms, round);
            const Outcome outcome = run_of(bench, story);
            REQUIRE(outcome.phase == kinds[kind].phase);
            CHECK(outcome.why.find(kinds[kind].why) != std::string::npos);
            CHECK(outcome.standstill_ms <= kinds[kind].standstill_ms);
            CHECK(outcome.after == 0);
            for (const RunTarget::AxisPlace& place : bench.target->places()) {
                CHECK(place.known().has_value() == (outcome.phase != hal::PortPhase::fault));
            }
            if (outcome.phase != hal::PortPhase::fault) {
                require_on_path(bench);
            } else if (story.cause == Cause::e_stop) {
                CHECK_FALSE(bench.lines->enabled());
                CHECK(bench.target->where().find("drives are off") != std::string::npos);
            } else {
                CHECK(bench.target->where().find("may still be on") != std::string::npos);
            }
            worst_ms = std::max(worst_ms, outcome.standstill_ms);
            over_ms = std::max(over_ms, outcome.over_ms);
            after += outcome.after;
        }
        fmt::print("  {:38} standstill within {:7.2f} ms, end of the run within {:7.1f} ms, steps after it {}\n",
                   kinds[kind].name, worst_ms, over_ms, after);
    }
}

TEST_CASE("an axis that is asked to stop has no place before it stands", "[stopping]") {
    Bench bench;
    TargetRun run(bench, to_mm);
    while (bench.now_ms() < 500.0) {
        REQUIRE(run.tick() == hal::PortPhase::running);
    }
    RunTarget& target = run.target;
    CHECK(target.places()[0].known()); // as far as it has come
    target.port().quick_stop();
    CHECK_FALSE(target.places()[0].known());
    bench.clock.sleep_us(110'000);
    CHECK(target.places()[0].known());
}

TEST_CASE("an axis that did not find its reference has no place, the others do", "[stopping]") {
    Bench bench({.orders = {.home = true}});
    hal::StraightMotion motion(bench.machine.settings, {0.0, 0.0}, to_mm, 100.0);
    FeedSegment first;
    REQUIRE(motion.next(first));
    RunTarget& target = *bench.target;
    CHECK(target.port().prepare(first).what.find(
              "axis x does not find its reference: the home of axis x (line 2) does not act") == 0);
    REQUIRE(target.places().size() == 2);
    CHECK_FALSE(target.places()[0].known());
    CHECK(target.places()[1].known() == 0.0);
    CHECK(target.where().find("y=0.0000") != std::string::npos);
    CHECK(target.where().find("x=") == std::string::npos);
}

TEST_CASE("a switch whose edge nobody told stops the machine by its level", "[stopping]") {
    Bench bench;
    SECTION("limit") {
        const Outcome outcome = run_of(bench, {.cause = Story::Cause::limit, .at_ms = 300.0, .with_edge = false});
        CHECK(outcome.phase == hal::PortPhase::idle);
        CHECK(outcome.why.find("the limit of axis x") != std::string::npos);
        CHECK(outcome.standstill_ms < 200.0);
    }
    SECTION("e-stop") {
        const Outcome outcome = run_of(bench, {.cause = Story::Cause::e_stop, .at_ms = 300.0, .with_edge = false});
        CHECK(outcome.phase == hal::PortPhase::fault);
        CHECK(outcome.standstill_ms < 25.0); // levels are looked at every 5 ms, three times
    }
}

TEST_CASE("a host that stands still for longer than motors tolerate is a fault, a shorter time is made up for",
          "[stopping]") {
    const double stall_ms = GENERATE(20.0, 39.0, 45.0, 1000.0);
    Bench bench;
    TargetRun run(bench, to_mm);
    bool stalled = false;
    hal::PortPhase phase = hal::PortPhase::running;
    for (int i = 0; i < 10'000 && phase == hal::PortPhase::running; ++i) {
        if (!stalled && bench.now_ms() > 800.0) {
            stalled = true;
            bench.lines->stall(static_cast<std::uint64_t>(stall_ms * 1e6));
        }
        phase = run.tick();
    }
    CAPTURE(stall_ms);
    if (stall_ms < 40.0) {
        CHECK(phase == hal::PortPhase::idle);
        CHECK(bench.steps(0) == 16'000);
    } else {
        CHECK(phase == hal::PortPhase::fault);
        RunTarget& target = run.target;
        CHECK(run.port.failure().what.find("no step was made for longer than 40 ms") != std::string::npos);
        CHECK(target.where().find("is not known") != std::string::npos);
        CHECK_FALSE(target.places().front().known());
        CHECK(bench.last_step_ms() < 800.0 + stall_ms + 2.0);
        CHECK_FALSE(bench.lines->enabled());
    }
}
