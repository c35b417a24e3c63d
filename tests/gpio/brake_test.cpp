// SPDX-License-Identifier: MIT
// The brake of an axis that would fall, and what drives on lines are left at, on a virtual clock.
#include "port_rig.hpp"
#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t step_lines = 0b101;

MachineDescription with_end(std::optional<bool> on_at_end) {
    MachineDescription machine = two_axes();
    machine.drives_on_at_end = on_at_end;
    return machine;
}

struct Bench : TargetRig {
    explicit Bench(std::optional<bool> on_at_end = {}) : TargetRig(with_end(on_at_end), braked_map) {}
    /// Until it is over, or `cause` happens at an instant. [ms]
    hal::PortPhase run(double at_ms = 0.0, std::function<void()> cause = {}) {
        TargetRun run(*this, {20.0, 10.0});
        const std::uint64_t began_ns = clock.now_ns();
        hal::PortPhase phase = hal::PortPhase::running;
        for (int i = 0; i < 5000 && phase == hal::PortPhase::running; ++i) {
            if (cause && static_cast<double>(clock.now_ns() - began_ns) >= at_ms * 1e6) {
                std::exchange(cause, {})();
            }
            phase = run.tick();
        }
        return phase;
    }
    /// When the levels first were like that, from a row on.
    template <class Condition>
    [[nodiscard]] std::uint64_t first_ns(const Condition& is, std::size_t from = 0) const {
        for (std::size_t i = from; i < lines->rows().size(); ++i) {
            if (is(lines->rows()[i].levels)) {
                return lines->rows()[i].at_ns;
            }
        }
        return UINT64_MAX;
    }
};

} // namespace

TEST_CASE("the brake is released when the drives hold the axes, and engaged before they let go", "[brake]") {
    Bench bench;
    CHECK(bench.run() == hal::PortPhase::idle);
    const SimulatedPins& lines = *bench.lines;
    const std::uint64_t on_ns = bench.first_ns([&](std::uint64_t levels) { return lines.enabled(levels); });
    const std::uint64_t free_ns = bench.first_ns([&](std::uint64_t levels) { return lines.released(levels); });
    const std::uint64_t step_ns = bench.first_ns([&](std::uint64_t levels) { return (levels & step_lines) != 0; });
    CHECK(free_ns >= on_ns + 5 * ns_per_ms); // settle_ms
    CHECK(step_ns >= free_ns + 30 * ns_per_ms);
    CHECK(step_ns < free_ns + 60 * ns_per_ms);
    const std::size_t rows = lines.rows().size();
    CHECK(static_cast<RunTarget&>(*bench.target).leave(false).empty());
    const std::uint64_t held_ns = bench.first_ns([&](std::uint64_t levels) { return !lines.released(levels); }, rows);
    const std::uint64_t off_ns = bench.first_ns([&](std::uint64_t levels) { return !lines.enabled(levels); }, rows);
    REQUIRE(off_ns != UINT64_MAX);
    CHECK(off_ns >= held_ns + 80 * ns_per_ms);
    CHECK_FALSE(lines.kept());
}

TEST_CASE("an e-stop engages the brake in the call that switches the drives off", "[brake]") {
    Bench bench;
    CHECK(bench.run(200.0, [&] { bench.lines->drive(e_stop, true); }) == hal::PortPhase::fault);
    const SimulatedPins& lines = *bench.lines;
    bool was_free = false;
    for (const SimulatedPins::Row& row : lines.rows()) {
        was_free = was_free || lines.released(row.levels);
        CHECK((!was_free || lines.released(row.levels) == lines.enabled(row.levels)));
    }
    CHECK(was_free);
    CHECK_FALSE(lines.enabled());
    const std::uint64_t before_ns = bench.clock.now_ns();
    CHECK(static_cast<RunTarget&>(*bench.target).leave(false).empty());
    CHECK(bench.clock.now_ns() < before_ns + 2 * ns_per_ms); // nothing to wait for
}

TEST_CASE("drives on lines stay on where the machine file says so, and the machine stands where it is known",
          "[brake]") {
    Bench bench(true);
    SECTION("behind a whole run") {
        CHECK(bench.run() == hal::PortPhase::idle);
        CHECK(static_cast<RunTarget&>(*bench.target).leave(false).empty());
        CHECK(bench.lines->kept());
        CHECK(bench.lines->enabled());
        CHECK(bench.lines->released(bench.lines->rows().back().levels));
    }
    SECTION("but not behind an e-stop") {
        CHECK(bench.run(200.0, [&] { bench.lines->drive(e_stop, true); }) == hal::PortPhase::fault);
        CHECK(static_cast<RunTarget&>(*bench.target).leave(false).empty());
        CHECK_FALSE(bench.lines->kept());
        CHECK_FALSE(bench.lines->enabled());
    }
}

TEST_CASE_METHOD(PortRig, "a parked port switches the drives on again, and releases the brake", "[brake]") {
    for (int i = 0; i < 2; ++i) {
        static_cast<void>(port.start());
        clock.sleep_us(20'000);
        CHECK(lines.enabled());
        CHECK(lines.released(lines.rows().back().levels));
        port.close();
        port.power_off();
        CHECK_FALSE(lines.enabled());
        CHECK_FALSE(lines.released(lines.rows().back().levels));
        port.reset();
    }
    const std::size_t rows = lines.rows().size();
    port.power_off(); // already
    CHECK(lines.rows().size() == rows);
}
