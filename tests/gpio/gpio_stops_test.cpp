// SPDX-License-Identifier: MIT
// How a run on GPIO lines stops, on a virtual clock: whatever asks for it, and whatever the planner does meanwhile.
#include "port_rig.hpp"
#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr PerAxis<double> end_mm{200.0, 100.0};

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

} // namespace

TEST_CASE("an axis that is asked to stop has no place before it stands", "[stopping]") {
    Bench bench;
    TargetRun run(bench, end_mm);
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
    hal::StraightMotion motion(bench.machine.settings, {0.0, 0.0}, end_mm, 100.0);
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

TEST_CASE("a host that stands still for longer than motors tolerate is a fault, a shorter time is made up for",
          "[stopping]") {
    const double stall_ms = GENERATE(20.0, 39.0, 45.0, 1000.0);
    Bench bench;
    TargetRun run(bench, end_mm);
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
