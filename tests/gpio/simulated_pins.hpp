// SPDX-License-Identifier: MIT
// SimulatedPins: the lines of a map on a virtual clock: what was set when, and switches that act when a test says so.
#pragma once

#include "splinefeed/hal/gpio/machine_pins.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <functional>
#include <utility>

namespace splinefeed_test {

/// One chip. Not for several threads at once: those of a VirtualClock are one.
class SimulatedPins final : public splinefeed::hal::gpio::MachinePins,
                            public splinefeed::hal::gpio::PinWriter,
                            public splinefeed::hal::gpio::InputSource {
public:
    struct Row {
        std::uint64_t at_ns;
        std::uint64_t levels; // of all lines
    };

    SimulatedPins(const splinefeed::hal::gpio::PinMap& map, splinefeed::hal::Clock& clock)
        : map_(&map), clock_(&clock), levels_(splinefeed::hal::gpio::safe_levels_of(map.chips[0].outputs)),
          safe_(levels_) {}

    /// An input of the map changes, with an edge or without one.
    void drive(std::size_t input, bool active, bool with_edge = true) {
        const auto& mapped = map_->inputs[input];
        const bool level = active == mapped.active_level;
        inputs_ = (inputs_ & ~mapped.line.mask()) | (level ? mapped.line.mask() : 0);
        if (with_edge) {
            events_.push_back({mapped.line.bit, level, clock_->now_ns(), 0});
        }
    }
    [[nodiscard]] bool active(std::size_t input) const {
        const auto& mapped = map_->inputs[input];
        return ((inputs_ & mapped.line.mask()) != 0) == mapped.active_level;
    }
    void fail(bool fails) { fails_ = fails; }
    std::function<void()> changed; ///< called when lines were set: what they move may act on inputs
    /// The call that comes next does not return for so long: whatever has the processor meanwhile.
    void stall(std::uint64_t ns) { stall_ns_ = ns; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    /// Enable and brake are to keep what they have when the lines are released.
    [[nodiscard]] bool kept() const { return kept_; }
    [[nodiscard]] bool released(std::uint64_t levels) const {
        return ((levels & map_->brake->line.mask()) != 0) == map_->brake->released_level;
    }
    [[nodiscard]] bool enabled(std::uint64_t levels) const {
        return ((levels & map_->enable->line.mask()) != 0) == map_->enable->active_level;
    }
    [[nodiscard]] bool enabled() const {
        const auto& line = map_->enable->line;
        return (levels_ & line.mask()) != (safe_ & line.mask());
    }

    // MachinePins
    [[nodiscard]] std::vector<splinefeed::hal::gpio::ChipOutputs> outputs() override {
        splinefeed::hal::gpio::ChipOutputs chip{.writer = this};
        for (unsigned k = 0; k < splinefeed::max_axes; ++k) {
            for (unsigned m = 0; m < map_->axis[k].motors; ++m) {
                chip.step[k].mask |= map_->axis[k].motor[m].step.mask();
                chip.direction[k].mask |= map_->axis[k].motor[m].direction.mask();
            }
        }
        const std::uint64_t enable = map_->enable->line.mask();
        chip.enable = {enable, map_->enable->active_level ? 0 : enable};
        if (map_->brake) {
            const std::uint64_t brake = map_->brake->line.mask();
            chip.brake = {brake, map_->brake->released_level ? 0 : brake};
        }
        return {chip};
    }
    [[nodiscard]] std::vector<Inputs> inputs() override {
        Inputs all{this, {}};
        for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
            all.input.push_back(i);
        }
        return {all};
    }
    [[nodiscard]] std::vector<std::uint64_t> set_times_ns(int calls) override {
        return std::vector<std::uint64_t>(static_cast<std::size_t>(calls), 1000);
    }
    void make_safe() noexcept override { levels_ = safe_; }
    void keep_drives_on() noexcept override { kept_ = true; }
    [[nodiscard]] std::string name(splinefeed::hal::gpio::PinBit input) const override {
        return "line " + std::to_string(input.bit);
    }

    // PinWriter
    [[nodiscard]] bool set(std::uint64_t mask, std::uint64_t levels) noexcept override {
        if (stall_ns_ > 0) {
            clock_->sleep_until_ns(clock_->now_ns() + std::exchange(stall_ns_, 0));
        }
        if (fails_) {
            errno = ENODEV;
            return false;
        }
        levels_ = (levels_ & ~mask) | (levels & mask);
        rows_.push_back({clock_->now_ns(), levels_});
        if (changed) {
            changed();
        }
        return true;
    }

    // InputSource
    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept override { return inputs_; }
    [[nodiscard]] int wait(std::span<splinefeed::hal::gpio::InputEvent> out,
                           std::uint32_t timeout_us) noexcept override {
        const std::uint64_t until_ns = clock_->now_ns() + timeout_us * 1000ULL;
        while (events_.empty() && clock_->now_ns() < until_ns) {
            clock_->sleep_until_ns(std::min(until_ns, clock_->now_ns() + wake_ns));
        }
        int count = 0;
        for (; !events_.empty() && static_cast<std::size_t>(count) < out.size(); ++count) {
            out[static_cast<std::size_t>(count)] = events_.front();
            events_.pop_front();
        }
        return count;
    }

private:
    static constexpr std::uint64_t wake_ns = 50'000; // from an edge to the thread that waits for it

    const splinefeed::hal::gpio::PinMap* map_;
    splinefeed::hal::Clock* clock_;
    std::vector<Row> rows_;
    std::deque<splinefeed::hal::gpio::InputEvent> events_;
    std::uint64_t levels_;
    std::uint64_t safe_;
    std::uint64_t inputs_ = 0;
    std::uint64_t stall_ns_ = 0;
    bool fails_ = false;
    bool kept_ = false;
};

} // namespace splinefeed_test
