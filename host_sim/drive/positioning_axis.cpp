// SPDX-License-Identifier: MIT
#include "host_sim/drive/positioning_axis.hpp"

#include <cmath>

namespace splinefeed::host {

PositioningAxis::PositioningAxis(const PositioningAxisParameters& parameters) noexcept
    : parameters_(parameters), shaft_(parameters.shaft) {
    generator_.preset_position(parameters.start_counts);
    shaft_.preset_position(parameters.start_counts);
}

void PositioningAxis::enable() noexcept {
    if (power_ == AxisPower::off) {
        power_ = AxisPower::on;
    }
}

// Nothing drives the shaft: it stands where it is, and the reference with it.
void PositioningAxis::drop() noexcept {
    shaft_.let_go();
    generator_.preset_position(shaft_.position_counts());
    homing_ = false;
}

void PositioningAxis::disable() noexcept {
    if (power_ == AxisPower::on) {
        power_ = AxisPower::off;
        drop();
    }
}

void PositioningAxis::reset_fault() noexcept {
    if (power_ == AxisPower::fault) {
        power_ = AxisPower::off;
        fault_ = AxisFault::none;
        arrived_ = true;
    }
}

void PositioningAxis::move(double target_counts, const MoveLimits& limits) noexcept {
    if (power_ == AxisPower::on) {
        generator_.move(target_counts, limits);
        homing_ = false;
        arrived_ = true;
    }
}

void PositioningAxis::follow(double target_counts, double duration_s) noexcept {
    if (power_ == AxisPower::on) {
        generator_.follow(target_counts, duration_s);
        homing_ = false;
        arrived_ = true;
    }
}

void PositioningAxis::home() noexcept {
    move(0.0, {parameters_.homing_counts_s, parameters_.homing_counts_s2, parameters_.homing_counts_s2});
    homing_ = power_ == AxisPower::on;
    homed_ = false;
}

void PositioningAxis::halt(double deceleration_counts_s2) noexcept {
    arrived_ = arrived_ && generator_.at_rest();
    generator_.stop(deceleration_counts_s2);
    homing_ = false;
}

void PositioningAxis::quick_stop() noexcept {
    halt(parameters_.stop_counts_s2);
    arrived_ = true;
}

void PositioningAxis::trip(AxisFault fault) noexcept {
    if (power_ == AxisPower::stopping_fault || power_ == AxisPower::fault) {
        return;
    }
    const bool stops = power_ == AxisPower::on && moving();
    power_ = stops ? AxisPower::stopping_fault : AxisPower::fault;
    fault_ = fault;
    if (stops) {
        quick_stop();
    } else {
        drop();
    }
}

void PositioningAxis::power_cycle() noexcept {
    drop();
    power_ = AxisPower::off;
    fault_ = AxisFault::none;
    homed_ = false;
    arrived_ = true;
}

bool PositioningAxis::idle() const noexcept {
    return generator_.at_rest() && (power_ == AxisPower::off || power_ == AxisPower::fault || shaft_.settled());
}

void PositioningAxis::advance(double duration_s) noexcept {
    const double before = generator_.velocity_counts_s();
    generator_.advance(duration_s);
    if (power_ == AxisPower::off || power_ == AxisPower::fault) {
        return;
    }
    shaft_.step(duration_s, generator_.position_counts(), (generator_.velocity_counts_s() - before) / duration_s);
    if (homing_ && generator_.at_rest()) {
        homing_ = false;
        homed_ = true;
    }
    if (power_ == AxisPower::stopping_fault && generator_.at_rest()) {
        power_ = AxisPower::fault;
        drop();
    } else if (parameters_.following_window_counts > 0.0 &&
               std::fabs(shaft_.following_error_counts()) > parameters_.following_window_counts) {
        trip(AxisFault::following_error);
    }
}

} // namespace splinefeed::host
