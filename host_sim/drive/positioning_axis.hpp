// SPDX-License-Identifier: MIT
// PositioningAxis: power stage, reference and shaft of one axis of a drive that is controlled by registers.
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
    double stop_counts_s2 = 2e6; ///< deceleration of a quick stop and of a fault
    double homing_counts_s = 2e4;
    double homing_counts_s2 = 2e5;
    double following_window_counts = 0.0; ///< a larger following error is a fault; 0: none
};

class PositioningAxis {
public:
    explicit PositioningAxis(const PositioningAxisParameters& parameters) noexcept;

    void enable() noexcept; ///< does nothing in a fault
    void disable() noexcept;
    void reset_fault() noexcept; ///< then the power is off
    /// The functions that move the axis do nothing unless the power is on.
    void move(double target_counts, const MoveLimits& limits) noexcept;
    void follow(double target_counts, double duration_s) noexcept;
    void home() noexcept;
    void halt(double deceleration_counts_s2) noexcept;
    void quick_stop() noexcept; ///< also ends the move
    /// Stops hard, then switches the power off.
    void trip(AxisFault fault) noexcept;
    void power_cycle() noexcept;
    void set_following_window(double counts) noexcept { parameters_.following_window_counts = counts; }
    void advance(double duration_s) noexcept;
    /// Whether time changes nothing.
    [[nodiscard]] bool idle() const noexcept;

    [[nodiscard]] AxisPower power() const noexcept { return power_; }
    [[nodiscard]] AxisFault fault() const noexcept { return fault_; }
    [[nodiscard]] bool moving() const noexcept { return !generator_.at_rest(); }
    [[nodiscard]] bool homing() const noexcept { return homing_; }
    [[nodiscard]] bool homed() const noexcept { return homed_; }
    /// At standstill with no move left to finish (a halt leaves one).
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
