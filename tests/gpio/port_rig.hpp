// SPDX-License-Identifier: MIT
// A StepPort with a brake on simulated lines, and what the lines tell of its motion.
#pragma once

#include "gpio_bench.hpp"
#include "host_sim/ports/gpio/gpio_settings.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "splinefeed/hal/motion/straight_motion.hpp"
#include "support/virtual_clock.hpp"

#include <cmath>

namespace splinefeed_test {

inline const std::string braked_map = map_text + R"([brake]
line = 5
release_ms = 30
engage_ms = 80
)";

struct PortRig {
    explicit PortRig(const std::string& text = braked_map)
        : map(splinefeed::host::parse_gpio_map(text, "m.toml", machine, "chip")) {}
    [[nodiscard]] double now_ms() const { return static_cast<double>(clock.now_ns() - began_ns) * 1e-6; }
    /// Hands segments over as long as there is room; the last one is not at rest where the motion goes on.
    bool feed(splinefeed::hal::StraightMotion& motion) {
        splinefeed::FeedSegment segment;
        while (port.room() > 0) {
            if (!motion.next(segment)) {
                return false;
            }
            if (!port.submit(segment)) {
                return true;
            }
        }
        return true;
    }
    /// Signed steps of an axis on its lines up to an instant, from the first row on.
    [[nodiscard]] std::int64_t steps(unsigned axis, std::uint64_t until_ns = UINT64_MAX) const {
        std::int64_t count = 0;
        const auto& rows = lines.rows();
        for (std::size_t i = 1; i < rows.size() && rows[i].at_ns <= until_ns; ++i) {
            if (((~rows[i - 1].levels & rows[i].levels) >> (2 * axis) & 1U) != 0) {
                count += (rows[i].levels >> (2 * axis + 1) & 1U) != 0 ? 1 : -1;
            }
        }
        return count;
    }
    /// The most that an axis accelerated or braked, by its steps, in stretches of 20 ms. [mm/s^2]
    [[nodiscard]] double most_acceleration(unsigned axis) const {
        constexpr std::uint64_t stretch_ns = 20'000'000;
        double most = 0.0;
        std::array<double, 3> at{};
        const std::uint64_t end_ns = lines.rows().back().at_ns + 2 * stretch_ns;
        for (std::uint64_t t = began_ns; t <= end_ns; t += stretch_ns) {
            at = {at[1], at[2], static_cast<double>(steps(axis, t)) / steps_per_mm};
            most = std::max(most, std::fabs(at[0] - 2.0 * at[1] + at[2]) / (20e-3 * 20e-3));
        }
        return most;
    }

    VirtualClock clock;
    std::uint64_t began_ns = clock.now_ns();
    splinefeed::host::MachineDescription machine = two_axes();
    splinefeed::hal::gpio::PinMap map;
    SimulatedPins lines{map, clock};
    splinefeed::hal::gpio::StepPort port{lines.outputs(), splinefeed::host::port_settings(machine, map, &clock)};
};
/// One whose drives have no brake.
struct PlainRig : PortRig {
    PlainRig() : PortRig(map_text) {}
};

/// A GpioTarget on simulated lines.
struct TargetRig {
    TargetRig(const splinefeed::host::MachineDescription& description, const std::string& text,
              const splinefeed::host::RunOptions& options = {})
        : machine(description) {
        auto own_map = std::make_unique<splinefeed::hal::gpio::PinMap>(
            splinefeed::host::parse_gpio_map(text, "m.toml", machine, "chip"));
        map = own_map.get();
        auto own_lines = std::make_unique<SimulatedPins>(*map, clock);
        lines = own_lines.get();
        target = std::make_unique<splinefeed::host::GpioTarget>(std::move(own_map), std::move(own_lines), machine,
                                                                options, &clock);
    }

    VirtualClock clock;
    splinefeed::host::MachineDescription machine;
    splinefeed::hal::gpio::PinMap* map = nullptr;
    SimulatedPins* lines = nullptr;
    std::unique_ptr<splinefeed::host::GpioTarget> target;
};

/// A straight run on a target from zero, as LiveMachine and Motion do it, a millisecond at a time.
class TargetRun {
public:
    TargetRun(TargetRig& rig, const splinefeed::PerAxis<double>& to)
        : target(*rig.target), clock_(rig.clock), motion_(rig.machine.settings, {0.0, 0.0}, to, 100.0) {
        REQUIRE(motion_.next(*next_));
        REQUIRE_FALSE(port.prepare(*next_));
    }
    /// With a planner that is blocked nothing is delivered.
    splinefeed::hal::PortPhase tick(bool delivers = true) {
        if (!target.signs().holds.empty()) {
            motion_.hold();
        }
        while (delivers && next_ && port.room() > 0 && port.submit(*next_)) {
            if (!motion_.next(*next_)) {
                next_.reset();
                port.complete();
            }
        }
        const splinefeed::hal::PortPhase phase = port.poll().phase;
        if (phase == splinefeed::hal::PortPhase::running) {
            clock_.sleep_us(1000);
        }
        return phase;
    }

    splinefeed::host::RunTarget& target;
    splinefeed::hal::MotionPort& port = target.port();

private:
    VirtualClock& clock_;
    splinefeed::hal::StraightMotion motion_;
    std::optional<splinefeed::FeedSegment> next_{std::in_place};
};

} // namespace splinefeed_test
