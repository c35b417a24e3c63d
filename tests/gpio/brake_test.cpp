// SPDX-License-Identifier: MIT
// The brake of an axis that would fall, and what drives on lines are left at, on a virtual clock.
#include "gpio_bench.hpp"

#include "host_sim/planning/straight_motion.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

const std::string braked_map = map_text + R"([brake]
line = 5
release_ms = 30
engage_ms = 80
)";
constexpr std::uint64_t step_lines = 0b101;

struct Bench {
    explicit Bench(std::optional<bool> on_at_end = {}) {
        machine.drives_on_at_end = on_at_end;
        auto own_map = std::make_unique<hal::gpio::LineMap>(parse_gpio_map(braked_map, "m.toml", machine, "chip"));
        auto own_lines = std::make_unique<SimulatedLines>(*own_map, clock);
        lines = own_lines.get();
        target = std::make_unique<GpioTarget>(std::move(own_map), std::move(own_lines), machine, RunOptions{}, &clock);
    }
    /// Until it is over, or `cause` happens at an instant. [ms]
    hal::PortPhase run(double at_ms, const std::function<void()>& cause) {
        RunTarget& run_target = *target;
        StraightMotion motion(machine, {0.0, 0.0}, {20.0, 10.0}, 100.0);
        FeedSegment segment;
        REQUIRE(motion.next(segment));
        const std::uint64_t began_ns = clock.now_ns();
        hal::MotionPort& port = run_target.port();
        REQUIRE_FALSE(port.prepare(segment));
        bool more = true;
        bool caused = false;
        for (int i = 0; i < 5000; ++i) {
            if (!caused && static_cast<double>(clock.now_ns() - began_ns) >= at_ms * 1e6) {
                caused = true;
                cause();
            }
            if (!run_target.holds().empty()) {
                motion.hold();
            }
            while (more && port.room() > 0 && port.submit(segment)) {
                more = motion.next(segment);
                if (!more) {
                    port.complete();
                }
            }
            if (const hal::PortPhase phase = port.poll().phase; phase != hal::PortPhase::running) {
                return phase;
            }
            clock.sleep_us(1000);
        }
        return hal::PortPhase::running;
    }
    hal::PortPhase run() {
        return run(1e9, [] {});
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

    VirtualClock clock;
    MachineDescription machine = two_axes();
    SimulatedLines* lines = nullptr;
    std::unique_ptr<GpioTarget> target;
};

} // namespace

TEST_CASE("the brake is released when the drives hold the axes, and engaged before they let go", "[brake]") {
    Bench bench;
    CHECK(bench.run() == hal::PortPhase::idle);
    const SimulatedLines& lines = *bench.lines;
    const std::uint64_t on_ns = bench.first_ns([&](std::uint64_t levels) { return lines.enabled(levels); });
    const std::uint64_t free_ns = bench.first_ns([&](std::uint64_t levels) { return lines.released(levels); });
    const std::uint64_t step_ns = bench.first_ns([&](std::uint64_t levels) { return (levels & step_lines) != 0; });
    CHECK(free_ns >= on_ns + 5 * ns_per_ms); // settle_ms
    CHECK(step_ns >= free_ns + 30 * ns_per_ms);
    CHECK(step_ns < free_ns + 60 * ns_per_ms);
    const std::size_t rows = lines.rows().size();
    CHECK(static_cast<RunTarget&>(*bench.target).finish().empty());
    const std::uint64_t held_ns = bench.first_ns([&](std::uint64_t levels) { return !lines.released(levels); }, rows);
    const std::uint64_t off_ns = bench.first_ns([&](std::uint64_t levels) { return !lines.enabled(levels); }, rows);
    REQUIRE(off_ns != UINT64_MAX);
    CHECK(off_ns >= held_ns + 80 * ns_per_ms);
    CHECK_FALSE(lines.kept());
}

TEST_CASE("an e-stop engages the brake in the call that switches the drives off", "[brake]") {
    Bench bench;
    CHECK(bench.run(200.0, [&] { bench.lines->drive(e_stop, true); }) == hal::PortPhase::fault);
    const SimulatedLines& lines = *bench.lines;
    bool was_free = false;
    for (const SimulatedLines::Row& row : lines.rows()) {
        was_free = was_free || lines.released(row.levels);
        CHECK((!was_free || lines.released(row.levels) == lines.enabled(row.levels)));
    }
    CHECK(was_free);
    CHECK_FALSE(lines.enabled());
    const std::uint64_t before_ns = bench.clock.now_ns();
    CHECK(static_cast<RunTarget&>(*bench.target).finish().empty());
    CHECK(bench.clock.now_ns() < before_ns + 2 * ns_per_ms); // nothing to wait for
}

TEST_CASE("drives on lines stay on where the machine file says so, and the machine stands where it is known",
          "[brake]") {
    Bench bench(true);
    SECTION("behind a whole run") {
        CHECK(bench.run() == hal::PortPhase::idle);
        CHECK(static_cast<RunTarget&>(*bench.target).finish().empty());
        CHECK(bench.lines->kept());
        CHECK(bench.lines->enabled());
        CHECK(bench.lines->released(bench.lines->rows().back().levels));
    }
    SECTION("but not behind an e-stop") {
        CHECK(bench.run(200.0, [&] { bench.lines->drive(e_stop, true); }) == hal::PortPhase::fault);
        CHECK(static_cast<RunTarget&>(*bench.target).finish().empty());
        CHECK_FALSE(bench.lines->kept());
        CHECK_FALSE(bench.lines->enabled());
    }
}

TEST_CASE("a parked port switches the drives on again, and releases the brake", "[brake]") {
    Bench bench;
    hal::gpio::LineMap map = parse_gpio_map(braked_map, "m.toml", bench.machine, "chip");
    SimulatedLines lines(map, bench.clock);
    hal::gpio::StepPort port(lines.outputs(), port_settings(bench.machine, map, &bench.clock));
    for (int i = 0; i < 2; ++i) {
        static_cast<void>(port.start());
        bench.clock.sleep_us(20'000);
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
