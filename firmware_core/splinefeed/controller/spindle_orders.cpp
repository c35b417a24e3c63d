// SPDX-License-Identifier: MIT
#include "splinefeed/controller/spindle_orders.hpp"

#include <utility>

namespace splinefeed {

void SpindleOrders::tell(EventKind kind, Decimal value) noexcept {
    ProgramEvent event;
    event.kind = kind;
    event.value = value;
    machine_->obey(event);
}

Decimal SpindleOrders::told_rpm() const noexcept {
    if (!turns() || rpm_.raw == 0) {
        return {};
    }
    const Decimal rpm{product_quotient(rpm_.raw, percent_, 100).raw};
    return rpm > settings_->max_rpm ? settings_->max_rpm : rpm < settings_->min_rpm ? settings_->min_rpm : rpm;
}

bool SpindleOrders::settles() noexcept {
    if (awaited_) {
        const MachineReading reading = machine_->read();
        awaited_ = !reading.spindle_ready || !(turns() || reading.spindle_stands);
    }
    return !awaited_;
}

void SpindleOrders::order_spindle() noexcept {
    tell_spindle();
    awaited_ = true;
}

void SpindleOrders::tell_spindle() noexcept {
    tell(!turns()                            ? EventKind::spindle_stop
         : state_ == SpindleState::clockwise ? EventKind::spindle_clockwise
                                             : EventKind::spindle_counterclockwise,
         told_rpm());
}

void SpindleOrders::tell_coolant() noexcept {
    tell(EventKind::coolant_off);
    if (flood_ && !suspended_) {
        tell(EventKind::flood_on);
    }
    if (mist_ && !suspended_) {
        tell(EventKind::mist_on);
    }
}

bool SpindleOrders::obey(const ProgramEvent& event) noexcept {
    switch (event.kind) {
    case EventKind::spindle_speed:
    case EventKind::surface_speed: {
        const bool stood = told_rpm().raw == 0;
        rpm_ = event.value;
        if (state_ != SpindleState::stopped) { // from S0, and to it, motion waits
            stood == (told_rpm().raw == 0) ? tell_spindle() : order_spindle();
        }
        return true;
    }
    case EventKind::spindle_clockwise: state_ = SpindleState::clockwise; break;
    case EventKind::spindle_counterclockwise: state_ = SpindleState::counterclockwise; break;
    case EventKind::spindle_stop: state_ = SpindleState::stopped; break;
    case EventKind::flood_on:
        flood_ = true;
        tell(EventKind::flood_on);
        return true;
    case EventKind::mist_on:
        mist_ = true;
        tell(EventKind::mist_on);
        return true;
    case EventKind::coolant_off:
        flood_ = mist_ = false;
        tell(EventKind::coolant_off);
        return true;
    default: return false;
    }
    rpm_ = state_ == SpindleState::stopped ? rpm_ : event.value;
    spindle_suspended_ = false;
    order_spindle();
    return true;
}

void SpindleOrders::set_override(int percent) noexcept {
    percent_ = percent;
    if (state_ != SpindleState::stopped) {
        tell_spindle();
    }
}

void SpindleOrders::toggle(EventKind coolant) noexcept {
    bool& on = coolant == EventKind::flood_on ? flood_ : mist_;
    on = !on;
    tell_coolant();
}

void SpindleOrders::toggle_spindle() noexcept {
    spindle_suspended_ = !spindle_suspended_ && state_ != SpindleState::stopped;
    order_spindle();
}

void SpindleOrders::suspend() noexcept {
    suspended_ = true;
    if (state_ != SpindleState::stopped) {
        order_spindle();
    }
    tell_coolant();
}

void SpindleOrders::restore() noexcept {
    const bool coolant = std::exchange(suspended_, false);
    const bool spindle = std::exchange(spindle_suspended_, false) || coolant;
    if (spindle && state_ != SpindleState::stopped) {
        order_spindle();
    }
    if (coolant) {
        tell_coolant();
    }
}

void SpindleOrders::stop_all() noexcept {
    state_ = SpindleState::stopped;
    flood_ = mist_ = suspended_ = spindle_suspended_ = false;
    order_spindle();
    tell_coolant();
}

} // namespace splinefeed
