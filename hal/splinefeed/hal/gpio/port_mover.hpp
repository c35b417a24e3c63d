// SPDX-License-Identifier: MIT
// PortMover: moves of a GpioPort by itself: straight ones, and the search for home switches. It knows where axes are.
#pragma once

#include "splinefeed/hal/gpio/switch_inputs.hpp"
#include "splinefeed/hal/port_failure.hpp"

#include <optional>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// What the counts of an axis are counted from.
enum class Origin : std::uint8_t {
    none,
    told,  ///< the place where somebody says that it stood, or the last one that was known
    known, ///< a reference that it has found, or a place that is known to be right
};

/// Machine positions are the counts of the port plus, for each axis, an origin.
class PortMover {
public:
    /// All arguments must outlive it.
    PortMover(const PinMap& map, const GpioPortSettings& settings, SwitchInputs& inputs, StepPort& port)
        : map_(&map), settings_(&settings), inputs_(&inputs), port_(&port),
          time_(settings.step.clock != nullptr ? settings.step.clock : &system_clock()) {}

    /// Each of these axes that has a home switch searches it, the last axis first: fast approach, back off, slow
    /// approach, and clear the switch. All within the machine's limits, and no further than the pull-offs and
    /// search_mm. Remedy::clear_switch: a switch acts where its axis should be off it. @param axes  by bits
    [[nodiscard]] PortFailure home(std::uint32_t axes);
    /// Moves in a straight line from the present position. Returns an empty text, or what went wrong.
    [[nodiscard]] std::string go_to(const PerAxis<double>& mm);

    /// Defines the present position as this count of the machine.
    void place(int axis, std::int64_t count, Origin origin) noexcept;
    /// From now on nobody knows whether the axis is where its counts say.
    void doubt(int axis) noexcept { origin_[index(axis)] = std::min(origin_[index(axis)], Origin::told); }
    /// It may be anywhere.
    void forget(int axis) noexcept { origin_[index(axis)] = Origin::none; }
    [[nodiscard]] Origin origin(int axis) const noexcept { return origin_[index(axis)]; }
    [[nodiscard]] std::int64_t count(int axis) const noexcept { return port_->counts(axis) + offset_[index(axis)]; }
    /// [mm]
    [[nodiscard]] double position(int axis) const noexcept {
        return settings_->mm_of(static_cast<unsigned>(axis), count(axis));
    }
    /// Position of the machine for counts of the port. [mm]
    [[nodiscard]] double position_at(int axis, std::int64_t port_counts) const noexcept {
        return settings_->mm_of(static_cast<unsigned>(axis), port_counts + offset_[index(axis)]);
    }

private:
    /// The event that a move waits for: an input that becomes so, or is so already.
    struct Until {
        std::size_t input;
        bool active;
    };
    /// How a move treats a limit that is active at its start: `off` leaves it; `on` ends before it begins.
    enum class Way { on, off };
    struct Moved {
        std::string trouble;                            // empty: no error
        std::optional<PerAxis<std::int64_t>> counts_at; // counts of the port at the event's edge, if it was seen
        bool came = false;                              // the event
        std::vector<bool> tolerated{}; // inputs that are active since the start of the move and are allowed to be

        [[nodiscard]] bool ends() const noexcept { return came || !trouble.empty(); }
    };

    [[nodiscard]] static constexpr std::size_t index(int axis) noexcept { return static_cast<std::size_t>(axis); }
    [[nodiscard]] PortFailure home_axis(int axis);
    [[nodiscard]] Moved move(const PerAxis<double>& to_mm, double feed_mm_s, Way way, std::optional<Until> until);
    /// Moves one axis by a distance.
    [[nodiscard]] Moved move_by(int axis, double mm, double feed_mm_s, Way way,
                                std::optional<Until> until = std::nullopt);
    void begin(const PerAxis<bool>& moves, Way way, const std::optional<Until>& until, Moved& moved);
    void look(const std::optional<Until>& until, Moved& moved);
    [[nodiscard]] bool ends_move(std::size_t input, const std::optional<Until>& until) const noexcept;

    const PinMap* map_;
    const GpioPortSettings* settings_;
    SwitchInputs* inputs_;
    StepPort* port_;
    Clock* time_;
    PerAxis<std::int64_t> offset_{};
    PerAxis<Origin> origin_{};
};

} // namespace splinefeed::hal::gpio
