// SPDX-License-Identifier: MIT
// GpioMover: straight moves of a machine on step lines that are no program, and the search for its switches.
#pragma once

#include "host_sim/target/gpio/gpio_inputs.hpp"

#include <functional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Machine positions are counts: those of the port and, for each axis, an origin that the switch tells.
class GpioMover {
public:
    /// All arguments outlive it.
    /// @param interrupts  how often the user has asked for an end: once holds a move, and it is the last one
    /// @param quick_stop  called for the second time
    GpioMover(const MachineDescription& machine, const hal::gpio::LineMap& map, GpioInputs& inputs,
              hal::gpio::StepPort& port, std::function<int()> interrupts, std::function<void()> quick_stop,
              hal::Clock& clock);

    /// Each axis that has a home switch finds it, the last axis of the machine file first: fast, back off, slow, and
    /// stands clear of it. Within the machine's limits. Empty, or what went wrong and what would be right.
    [[nodiscard]] std::string home();
    /// A straight line from where the machine is. Empty, or what went wrong.
    [[nodiscard]] std::string go_to(const PerAxis<double>& mm);

    /// Where it is now shall be this count of the machine.
    void preset_position(int axis, std::int64_t count) noexcept;
    [[nodiscard]] std::int64_t count(int axis) const noexcept {
        return port_->counts(axis) + origin_[static_cast<unsigned>(axis)];
    }
    /// [mm]
    [[nodiscard]] double position(int axis) const noexcept { return mm_of(axis, count(axis)); }
    /// What counts that the port had are on the machine. [mm]
    [[nodiscard]] double position_at(int axis, std::int64_t port_counts) const noexcept {
        return mm_of(axis, port_counts + origin_[static_cast<unsigned>(axis)]);
    }

private:
    /// What a move waits for: a change of an input.
    struct Until {
        std::size_t input;
        bool active;
    };
    /// Where a move leads: a limit that acts from its start is left on the way, or ends it before it begins.
    enum class Way { on, off };
    struct Moved {
        std::string trouble;                            // empty: none
        std::optional<PerAxis<std::int64_t>> counts_at; // of the port, when what it waited for came
        bool came = false;
        std::vector<bool> tolerated{}; // inputs that act since its start, and may
    };

    [[nodiscard]] double mm_of(int axis, std::int64_t count) const noexcept;
    [[nodiscard]] std::string home(int axis);
    [[nodiscard]] Moved move(const PerAxis<double>& to_mm, double feed_mm_s, Way way, std::optional<Until> until);
    /// One axis by so many mm.
    [[nodiscard]] Moved move_by(int axis, double mm, double feed_mm_s, Way way,
                                std::optional<Until> until = std::nullopt);
    [[nodiscard]] bool check_inputs(const std::optional<Until>& until, Moved& moved);
    void begin(const PerAxis<bool>& moves, Way way, const std::optional<Until>& until, Moved& moved) const;
    [[nodiscard]] bool ends_move(std::size_t input, const std::optional<Until>& until) const noexcept;

    const MachineDescription* machine_;
    const hal::gpio::LineMap* map_;
    GpioInputs* inputs_;
    hal::gpio::StepPort* port_;
    std::function<int()> interrupts_;
    std::function<void()> quick_stop_;
    hal::Clock* time_;
    PerAxis<std::int64_t> origin_{};
};

} // namespace splinefeed::host
