// SPDX-License-Identifier: MIT
// GpioMover: straight moves of a machine on step lines outside a program, and the search for its switches.
#pragma once

#include "host_sim/ports/gpio/gpio_inputs.hpp"

#include <functional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Machine positions are the counts of the port plus, for each axis, an origin that homing determines.
class GpioMover {
public:
    /// All arguments must outlive it.
    /// @param interrupts  number of the user's requests to end: the first one holds the move, which is then the last
    ///                    one
    /// @param quick_stop  called at the second request
    GpioMover(const MachineDescription& machine, const hal::gpio::LineMap& map, GpioInputs& inputs,
              hal::gpio::StepPort& port, std::function<int()> interrupts, std::function<void()> quick_stop,
              hal::Clock& clock);

    /// Each of these axes that has a home switch searches it, the last axis of the machine file first: fast approach,
    /// back off, slow approach, and clear the switch. All within the machine's limits. Returns an empty text, or what
    /// went wrong and what would be right. @param axes  by bits
    [[nodiscard]] std::string home(std::uint32_t axes = UINT32_MAX);
    /// Moves in a straight line from the present position. Returns an empty text, or what went wrong.
    [[nodiscard]] std::string go_to(const PerAxis<double>& mm);

    /// Defines the present position as this count of the machine.
    void preset_position(int axis, std::int64_t count) noexcept;
    /// Where the axis stands is not known until home() has found its reference.
    void forget_position(int axis) noexcept { referenced_[static_cast<unsigned>(axis)] = false; }
    /// Whether the counts of the axis have a reference.
    [[nodiscard]] bool referenced(int axis) const noexcept { return referenced_[static_cast<unsigned>(axis)]; }
    [[nodiscard]] std::int64_t count(int axis) const noexcept {
        return port_->counts(axis) + origin_[static_cast<unsigned>(axis)];
    }
    /// [mm]
    [[nodiscard]] double position(int axis) const noexcept { return mm_of(axis, count(axis)); }
    /// Position of the machine for counts of the port. [mm]
    [[nodiscard]] double position_at(int axis, std::int64_t port_counts) const noexcept {
        return mm_of(axis, port_counts + origin_[static_cast<unsigned>(axis)]);
    }

private:
    /// The event that a move waits for: a change of an input.
    struct Until {
        std::size_t input;
        bool active;
    };
    /// How a move treats a limit that is active at its start: `off` leaves it; `on` ends before it begins.
    enum class Way { on, off };
    struct Moved {
        std::string trouble;                            // empty: no error
        std::optional<PerAxis<std::int64_t>> counts_at; // counts of the port at the event that the move waited for
        bool came = false;
        std::vector<bool> tolerated{}; // inputs that are active since the start of the move and are allowed to be
    };

    [[nodiscard]] double mm_of(int axis, std::int64_t count) const noexcept;
    [[nodiscard]] std::string home_axis(int axis);
    [[nodiscard]] Moved move(const PerAxis<double>& to_mm, double feed_mm_s, Way way, std::optional<Until> until);
    /// Moves one axis by a distance.
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
    PerAxis<bool> referenced_{};
};

} // namespace splinefeed::host
