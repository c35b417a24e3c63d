// SPDX-License-Identifier: MIT
// PositioningAxis: power stage, reference and shaft of one axis of a drive that is told by registers what to do.
#pragma once

#include "host_sim/drive/motor_axis.hpp"
#include "host_sim/drive/position_generator.hpp"

#include <cstdint>

namespace splinefeed::host {

enum class AxisPower : std::uint8_t { off, on, stopping_fault, fault };
enum class AxisFault : std::uint8_t { none, following_error, watchdog };

struct PositioningAxisParameters {
    MotorAxisParameters shaft;
    double start_counts = 0.0;
    double stop_counts_s2 = 2e6; ///< of a quick stop and of a fault
    double homing_counts_s = 2e4;
    double homing_counts_s2 = 2e5;
    double following_window_counts = 0.0; ///< beyond: a fault; 0: none
};

class PositioningAxis {
public:
    explicit PositioningAxis(const PositioningAxisParameters& parameters) noexcept;

    void enable() noexcept; ///< not out of a fault
    void disable() noexcept;
    void reset_fault() noexcept; ///< off afterwards
    /// Those that move do nothing unless the power is on.
    void move(double target_counts, const MoveLimits& limits) noexcept;
    void follow(double target_counts, double duration_s) noexcept;
    void home() noexcept;
    void halt(double deceleration_counts_s2) noexcept;
    void quick_stop() noexcept; ///< and the move is over
    /// Stops hard, then the power goes.
    void trip(AxisFault fault) noexcept;
    void power_cycle() noexcept;
    void set_following_window(double counts) noexcept { parameters_.following_window_counts = counts; }
    void advance(double duration_s) noexcept;
    /// Time changes nothing.
    [[nodiscard]] bool idle() const noexcept;

    [[nodiscard]] AxisPower power() const noexcept { return power_; }
    [[nodiscard]] AxisFault fault() const noexcept { return fault_; }
    [[nodiscard]] bool moving() const noexcept { return !generator_.at_rest(); }
    [[nodiscard]] bool homing() const noexcept { return homing_; }
    [[nodiscard]] bool homed() const noexcept { return homed_; }
    /// At rest, and no move is left to be finished, as after a halt.
    [[nodiscard]] bool arrived() const noexcept { return arrived_ && generator_.at_rest(); }
    [[nodiscard]] const PositionGenerator& reference() const noexcept { return generator_; }
    [[nodiscard]] MotorAxis& shaft() noexcept { return shaft_; }
    [[nodiscard]] const MotorAxis& shaft() const noexcept { return shaft_; }

private:
    void drop() noexcept;

    PositioningAxisParameters parameters_;
    PositionGenerator generator_;
    MotorAxis shaft_;
    AxisPower power_ = AxisPower::off;
    AxisFault fault_ = AxisFault::none;
    bool homing_ = false;
    bool homed_ = false;
    bool arrived_ = true;
};

} // namespace splinefeed::host
