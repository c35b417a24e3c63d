// SPDX-License-Identifier: MIT
//
// What the thread of a ServedTarget does: motions of the port.
#include "host_sim/serve/served_target.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

namespace splinefeed::host {

namespace {

constexpr std::uint64_t poll_every_us = 1000;
constexpr std::uint64_t look_every_us = 40'000; // where it stands

Alarm alarm_of(StopCause cause) {
    switch (cause) {
    case StopCause::none: break;
    case StopCause::drive_fault: return Alarm::drive_fault;
    case StopCause::limit_switch: return Alarm::limit_switch;
    case StopCause::emergency_stop: return Alarm::emergency_stop;
    }
    return Alarm::none;
}

} // namespace

void ServedTarget::work() noexcept {
    for (std::uint64_t next_us = clock_->now_us(); !leaves_.load();
         next_us = std::max(next_us + poll_every_us, clock_->now_us())) {
        clock_->sleep_until_us(next_us);
        try {
            step();
        } catch (const std::exception& error) {
            fail(error.what());
        }
    }
    try {
        leave();
    } catch (const std::exception& error) {
        unconfirmed_ = error.what();
    }
}

// Outputs end as those of a run do; then the drives become what the machine file says.
void ServedTarget::leave() {
    constexpr std::uint64_t every_us = 10 * poll_every_us;
    if (outputs_ != nullptr) {
        outputs_->end();
    }
    const int signals = SignalWatch::interrupts();
    while (outputs_ != nullptr && outputs_->ends() && SignalWatch::interrupts() <= signals) {
        clock_->sleep_us(every_us);
    }
    unconfirmed_ = outputs_ != nullptr ? outputs_->unended() : std::string();
    if (phase_ == Phase::ready || phase_ == Phase::failed || !target_->has_feedback()) {
        const std::string drives = target_->finish();
        unconfirmed_ += drives.empty() || unconfirmed_.empty() ? drives : "; " + drives;
    }
    target_->port().close();
}

ServedTarget::Orders ServedTarget::take_orders() {
    const std::lock_guard lock(mutex_);
    const bool moves = submitted_ != finished_;
    const int signals = std::min(SignalWatch::interrupts(), 2);
    const int asked = target_->halts() || signals > 1 ? signals : 0; // else the plan brakes, as at each reset
    orders_.stops = moves ? std::max(orders_.stops, asked) : 0;
    Orders out = orders_;
    orders_ = {.stops = out.stops};
    busy_ = out.any();
    gives_up_.store(leaves_.load()); // what was given up is over
    return out;
}

void ServedTarget::step() {
    const Orders orders = take_orders();
    if (orders.probe) {
        target_->watch_probe(*orders.probe);
    }
    if (orders.off) {
        switch_off();
    }
    if (orders.opens) {
        recover(orders.resets);
    }
    if (orders.home != 0) {
        find_references(orders.home);
    }
    if (phase_ == Phase::ready) {
        if (const std::optional<MotionEnd> end = feed_.look(orders.stops)) {
            end_motion(*end);
        } else {
            static_cast<void>(look_where(false));
            announce();
        }
        look_at_switches();
        return;
    }
    feed_.tend_outputs();
    if (phase_ != Phase::closed) {
        announce();
    }
    look_at_switches();
    if (phase_ != Phase::failed && !feed_.trouble().empty()) {
        fail(feed_.trouble(), Alarm::spindle_speed);
    } else if (feed_.waits() && (phase_ == Phase::failed || orders.stops > 0)) {
        drop_motion();
    } else if (feed_.waits()) {
        begin_first();
    }
}

// What stops the machine is an alarm at once: where its drives do not halt by themselves the plan brakes.
void ServedTarget::announce() {
    const RunTarget::Stop stop = target_->stopped_by();
    const bool troubled = !feed_.trouble().empty() && !target_->halts();
    const Alarm alarm = troubled ? Alarm::spindle_speed : alarm_of(stop.cause);
    const std::string& why = troubled ? feed_.trouble() : stop.why;
    bool moves = false;
    {
        const std::lock_guard lock(mutex_);
        const bool worse = alarm == Alarm::emergency_stop && known_.alarm != alarm;
        if (alarm == Alarm::none || orders_.opens || !(worse || known_.alarm == Alarm::none)) {
            return;
        }
        moves = submitted_ != finished_ && phase_ == Phase::ready;
        known_.alarm = alarm;
        known_.sentence = why;
    }
    if (!moves) {
        fail(why, alarm);
    }
}

void ServedTarget::look_at_switches() {
    RunTarget::Switches now = target_->switches();
    const std::lock_guard lock(mutex_);
    now.touched_mm = orders_.probe ? std::nullopt : now.touched_mm; // of the one before
    known_.switches = now;
}

std::uint32_t ServedTarget::known_axes() const {
    const std::lock_guard lock(mutex_);
    return known_.axes;
}

FeedSegment ServedTarget::standing() const {
    FeedSegment out{.duration_ticks = segment_ticks_};
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.start[k] =
            std::llround(known_.mm[k] * machine_->settings.axis[k].steps_per_mm * static_cast<double>(units_per_count));
    }
    out.end = out.start;
    return out;
}

// The end of a segment, to the last digit.
void ServedTarget::take_place(const FeedSegment& segment) {
    const std::lock_guard lock(mutex_);
    for (const unsigned k : indices(machine_->settings.axes)) {
        known_.mm[k] = static_cast<double>(segment.end[k]) /
                       (static_cast<double>(units_per_count) * machine_->settings.axis[k].steps_per_mm);
    }
}

void ServedTarget::end_motion(const MotionEnd& end) {
    const FeedSegment last = feed_.last();
    if (end.kind != MotionEnd::Kind::complete || !end.why.empty() || feed_.obeyed() > 0) {
        feed_.drop();
    } // else what waits is the next motion
    if (!feed_.trouble().empty()) {
        fail(feed_.trouble(), Alarm::spindle_speed);
        return;
    }
    if (end.kind == MotionEnd::Kind::fault || target_->stopped_by().cause != StopCause::none) {
        fail_by(end.why);
        return;
    }
    FeedSegment next{.duration_ticks = segment_ticks_, .start = last.end, .end = last.end};
    if (end.kind == MotionEnd::Kind::halted) {
        constexpr int looks = 100; // a drive's answer may be late
        for (int look = 0; look < looks && !look_where(true); ++look) {
            clock_->sleep_us(10 * poll_every_us);
        }
        if (known_axes() != all_axes()) {
            fail(end.why, Alarm::stopped_in_motion);
            return;
        }
        next = standing();
    } else {
        take_place(last);
    }
    if (const hal::PortFailure failure = target_->port().renew(next)) {
        fail_by(target_->sentence(failure));
        return;
    }
    feed_.begin(target_->port().poll().executed);
    if (feed_.outputs_ended()) {
        renew_outputs();
    }
    finish_motion();
}

// As the target says what has stopped it; else its drives have.
void ServedTarget::fail_by(const std::string& sentence) {
    const RunTarget::Stop stop = target_->stopped_by();
    if (stop.cause == StopCause::none) {
        fail(sentence);
    } else {
        fail(stop.why, alarm_of(stop.cause));
    }
}

void ServedTarget::fail(const std::string& sentence, Alarm alarm) {
    if (phase_ == Phase::ready || !target_->has_feedback()) {
        static_cast<void>(look_where(true));
    }
    phase_ = Phase::failed;
    {
        const std::lock_guard lock(mutex_);
        known_.alarm = alarm;
        known_.sentence = sentence;
    }
    drop_motion();
}

void ServedTarget::drop_motion() {
    feed_.drop();
    feed_.begin(0);
    finish_motion();
}

// A stop that comes now is meant for what follows.
void ServedTarget::finish_motion() {
    const std::lock_guard lock(mutex_);
    finished_ = feed_.taken();
    orders_.stops = finished_ == submitted_ ? 0 : orders_.stops;
    known_.speed_mm_s = 0.0;
}

// While it stands, its place is that to the last digit where the motion ended.
bool ServedTarget::look_where(bool at_once) {
    const std::uint64_t now_us = clock_->now_us();
    if (!at_once && now_us < looked_us_ + look_every_us) {
        return true;
    }
    {
        const std::lock_guard lock(mutex_);
        if (submitted_ == finished_ && !at_once) {
            return true;
        }
    }
    const std::vector<RunTarget::AxisPlace> places = target_->places();
    const std::lock_guard lock(mutex_);
    if (places.empty()) { // nothing has moved
        return known_.axes == all_axes();
    }
    double way_sq = 0.0;
    std::uint32_t axes = 0;
    for (const RunTarget::AxisPlace& at : places) {
        const double mm = at.mm.value_or(known_.mm[at.axis]);
        way_sq += (mm - known_.mm[at.axis]) * (mm - known_.mm[at.axis]);
        known_.mm[at.axis] = mm;
        axes |= at.known() ? 1U << at.axis : 0U;
    }
    known_.speed_mm_s =
        std::sqrt(way_sq) * us_per_s / static_cast<double>(std::max<std::uint64_t>(1, now_us - looked_us_));
    looked_us_ = now_us;
    known_.axes = at_once ? known_.axes & axes : known_.axes;
    return axes == all_axes();
}

} // namespace splinefeed::host
