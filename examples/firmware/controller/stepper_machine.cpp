// SPDX-License-Identifier: MIT
#include "controller/stepper_machine.hpp"

namespace firmware {

using splinefeed::Alarm;
using splinefeed::Decimal;
using splinefeed::FeedSegment;
using splinefeed::InputBits;
using splinefeed::MachineReading;
using splinefeed::Position;

namespace {

constexpr std::uint32_t all_limits = (1U << axes) - 1U; // they are in series

/// Where so many steps are.
Position position_of(std::int32_t count, unsigned axis) noexcept {
    constexpr std::int64_t part = std::int64_t{1} << 62; // of 2^72, of which counts take the rest
    constexpr int rest = 72 - 62;
    return {splinefeed::product_quotient(std::int64_t{count} << rest, part, limits->steps_per_mm_q32[axis]).raw};
}

/// Of a segment: its way by its time.
std::uint16_t feed_of(const FeedSegment& segment) noexcept {
    constexpr int digits = 18; // of a position unit that are left out
    constexpr int scale = 24;
    constexpr auto sixteenths = [](unsigned axis) { // of mm/min, in 2^-scale
        constexpr double units_per_step = splinefeed::units_per_count >> digits;
        const double mm = 1.0 / (units_per_step * machine.axis[axis].steps_per_mm);
        return static_cast<std::int64_t>(16.0 * mm * 60e6 / board::segment_us * (1 << scale));
    };
    constexpr std::array<std::int64_t, axes> factors = {sixteenths(0), sixteenths(1), sixteenths(2)};
    std::uint64_t square = 0;
    for (unsigned k = 0; k < axes; ++k) {
        const std::int64_t speed = ((segment.end[k] - segment.start[k]) >> digits) * factors[k] >> scale;
        square += static_cast<std::uint64_t>(speed * speed);
    }
    std::uint32_t root = 0;
    for (std::uint32_t bit = 1U << 19; bit != 0; bit >>= 1U) {
        const std::uint64_t next = root | bit;
        root |= next * next <= square ? bit : 0U;
    }
    return static_cast<std::uint16_t>((root + 8) / 16);
}

} // namespace

void StepperMachine::look(Inputs inputs, bool bytes_lost) noexcept {
    inputs_ = inputs;
    has_stopped_ = false;
    alarm_ = bytes_lost ? Alarm::lines_lost : Alarm::none;
    const Stop stop = steps_.stopped();
    if (stop != Stop::none && !steps_.active()) {
        has_stopped_ = stop == Stop::limit || stop == Stop::halted;
        alarm_ = stop == Stop::limit ? Alarm::limit_switch : alarm_;
        steps_.restart();
        loader_ = first_loader;
        steps_.forgive();
    }
    alarm_ = stop == Stop::estop || inputs.estop ? Alarm::emergency_stop : alarm_;
}

void StepperMachine::submit(const FeedSegment& segment) noexcept {
    if (steps_.stands()) {
        energise_drives();
    }
    submitted_ = steps_.ticks();
    loader_.take(segment);
    if (loader_.next(part_.ticks)) {
        part_.rest = segment.ends_at_rest();
        part_.end = loader_.end_count();
        part_.feed_mm_min = feed_of(segment);
        waypoint_ = segment.waypoint;
        part_.waypoint = static_cast<std::uint8_t>(waypoint_);
        steps_.push(part_);
    }
}

MachineReading StepperMachine::read() noexcept {
    MachineReading out;
    for (unsigned k = 0; k < axes; ++k) {
        out.position[k] = position_of(steps_.count(k), k);
    }
    const Stop stop = steps_.stopped(); // an emergency stop as long as it is pressed
    out.stands = !has_stopped_ && (stop == Stop::none || stop == Stop::estop) && steps_.stands();
    out.inputs = (inputs_.limit ? all_limits : 0U) | (inputs_.estop ? InputBits::emergency_stop : 0U);
    out.known = known_;
    out.alarm = alarm_;
    if (alarm_ == Alarm::lines_lost) {
        out.alarm_sentence = "A byte from the sender was damaged or lost: look at the cable and its rate";
    }
    out.executes = steps_.active();
    out.waypoint = waypoint_ - static_cast<std::uint8_t>(waypoint_ - steps_.waypoint());
    out.feed_mm_min = Decimal::from_integer(static_cast<std::int32_t>(steps_.feed_mm_min()));
    return out;
}

/// Sooner than the plan could brake, which comes behind all that the ring has.
bool StepperMachine::halt() noexcept {
    if (!has_stopped_ && steps_.stopped() == Stop::none) {
        steps_.order(Stop::halted);
    }
    return true;
}

void StepperMachine::enable(bool on) noexcept {
    if (on) {
        energise_drives();
    } else {
        board::enable_drives(false);
    }
}

} // namespace firmware
