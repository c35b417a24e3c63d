// SPDX-License-Identifier: MIT
//
// What the thread of a LiveMachine does: looks, and motions of the port.
#include "host_sim/live/live_machine.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

namespace splinefeed::host {

namespace {

constexpr std::uint64_t look_every_us = 40'000; // where it stands

} // namespace

void LiveMachine::work() noexcept {
    hal::Clock& clock = *settings_.clock;
    for (std::uint64_t next_us = clock.now_us(); !ends_ && !(serves() && leaves_.load());
         next_us = std::max(next_us + poll_every_us, clock.now_us())) {
        clock.sleep_until_us(next_us);
        try {
            step();
        } catch (const std::exception& error) {
            if (!serves() || phase_ == Phase::ready) {
                target_->port().quick_stop();
            }
            fail(error.what());
        }
    }
    end();
}

LiveMachine::Orders LiveMachine::take_orders() {
    const std::lock_guard lock(mutex_);
    const bool moves = !serves() || submitted_ != finished_;
    const int signals = SignalWatch::interrupts();
    // Of a machine that is served the plan brakes, as at each reset, where the drives do not do so sooner.
    const hal::StopRequest asked = signals > 1                                  ? hal::StopRequest::quick_stop
                                   : signals > 0 && (!serves() || facts_.halts) ? hal::StopRequest::hold
                                                                                : hal::StopRequest::none;
    orders_.stop = moves ? std::max(orders_.stop, asked) : hal::StopRequest::none;
    Orders out = orders_;
    out.home = waits_ ? 0U : out.home;
    orders_ = {.stop = out.stop, .home = orders_.home & ~out.home};
    busy_ = out.any();
    gives_up_.store(serves() && leaves_.load()); // what was given up is over
    if (!stop_why_.empty()) {
        feed_->set_trouble(stop_why_);
    }
    return out;
}

bool LiveMachine::may_move() {
    {
        const std::lock_guard lock(mutex_);
        if (!waits_) {
            return submitted_ != finished_; // what comes within this look is for the next one
        }
    }
    try {
        const bool kept = settings_.state->is_kept();
        const std::lock_guard lock(mutex_);
        waits_ = !kept;
        return kept;
    } catch (const std::exception& error) { // what waits is forgotten
        give_up_homing();
        fail(error.what());
        return false;
    }
}

void LiveMachine::step() {
    const bool moves = may_move();
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
    come_to(feed_->executed());
    if (phase_ == Phase::ready) {
        const std::optional<MotionEnd> end = feed_->look(orders.stop, moves);
        if (end) {
            come_to(feed_->executed());
            end_motion(*end);
        } else {
            static_cast<void>(look_where(false));
        }
        look_at_signs(!end);
        return;
    }
    if (!serves()) {
        if (moves) {
            begin_run();
        }
        return;
    }
    feed_->tend_outputs();
    look_at_signs(phase_ != Phase::closed);
    if (phase_ != Phase::failed && !feed_->trouble().empty()) {
        fail(feed_->trouble(), trouble_alarm());
    } else if (feed_->waits() && (phase_ == Phase::failed || orders.stop != hal::StopRequest::none)) {
        drop_motion();
    } else if (feed_->waits() && moves) {
        begin_first();
    }
}

// What stops the machine is an alarm at once: where its drives do not halt by themselves the plan brakes.
void LiveMachine::announce(const RunTarget::Stop& stop) {
    const bool troubled = !feed_->trouble().empty() && !facts_.halts;
    const Alarm alarm = troubled ? trouble_alarm() : stop.cause;
    const std::string& why = troubled ? feed_->trouble() : stop.why;
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

void LiveMachine::look_at_signs(bool announces) {
    if (!serves()) {
        return;
    }
    RunTarget::Signs now = target_->signs();
    least_ahead_us_.store(now.least_ahead_us);
    {
        const std::lock_guard lock(mutex_);
        now.switches.touched_mm = orders_.probe ? std::nullopt : now.switches.touched_mm; // of the one before
        known_.switches = now.switches;
    }
    if (announces) {
        announce(now.stop);
    }
}

// The machine is in the segment behind those that were executed.
void LiveMachine::come_to(std::uint64_t executed) {
    constexpr std::uint64_t while_it_moves_us = 50'000; // answers of drives may be late
    const std::uint64_t now_us = settings_.clock->now_us();
    moved_us_ = executed != seen_ ? now_us : moved_us_;
    seen_ = executed;
    stalls_.store(now_us - moved_us_ > while_it_moves_us);
    const std::lock_guard lock(mutex_);
    while (labels_.size() > 1 && labels_[1].segment <= executed) {
        labels_.pop_front();
    }
}

// The end of a segment, to the last digit.
void LiveMachine::take_place(const FeedSegment& segment) {
    const std::lock_guard lock(mutex_);
    for (const unsigned k : indices(machine_->settings.axes)) {
        known_.mm[k] = static_cast<double>(segment.end[k]) /
                       (static_cast<double>(units_per_count) * machine_->settings.axis[k].steps_per_mm);
    }
}

void LiveMachine::end_motion(const MotionEnd& end) {
    if (!serves()) {
        reason_ = end.why;
        ends_ = true;
        return;
    }
    const FeedSegment last = feed_->last();
    if (end.phase != hal::PortPhase::idle || !end.why.empty() || feed_->stops()) {
        feed_->drop();
    } // else what waits is the next motion
    if (!feed_->trouble().empty()) {
        fail(feed_->trouble(), trouble_alarm());
        return;
    }
    if (end.phase == hal::PortPhase::fault || target_->signs().stop.cause != Alarm::none) {
        fail_by(end.why);
        return;
    }
    FeedSegment next{.duration_ticks = settings_.segment_ticks, .start = last.end, .end = last.end};
    if (end.phase == hal::PortPhase::halted) {
        constexpr int looks = 100; // a drive's answer may be late
        const std::uint32_t known = known_axes();
        for (int look = 0; look < looks && !look_where(true); ++look) {
            settings_.clock->sleep_us(10 * poll_every_us);
        }
        if ((known & ~known_axes()) != 0) {
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
    feed_->begin(target_->port().poll().executed);
    if (feed_->outputs_ended()) {
        renew_outputs();
    }
    finish_motion();
}

// That of the outputs, or what the target has thrown.
Alarm LiveMachine::trouble_alarm() const {
    return outputs_ != nullptr && !outputs_->trouble().empty() ? Alarm::spindle_speed : Alarm::drive_fault;
}

// As the target says what has stopped it; else its drives have.
void LiveMachine::fail_by(const std::string& sentence) {
    const RunTarget::Stop stop = target_->signs().stop;
    if (stop.cause == Alarm::none) {
        fail(sentence);
    } else {
        fail(stop.why, stop.cause);
    }
}

void LiveMachine::fail(const std::string& sentence, Alarm alarm) {
    if (!serves()) {
        reason_ = sentence;
        ends_ = true;
        return;
    }
    const bool looks = phase_ == Phase::ready || !facts_.has_feedback;
    phase_ = Phase::failed;
    try {
        static_cast<void>(looks && look_where(true));
    } catch (const std::exception&) { // it may be why
        const std::lock_guard lock(mutex_);
        set_known(0);
    }
    {
        const std::lock_guard lock(mutex_);
        known_.alarm = alarm;
        known_.sentence = sentence;
    }
    drop_motion();
}

void LiveMachine::drop_motion() {
    feed_->drop();
    feed_->begin(0);
    finish_motion();
}

// A stop that comes now is meant for what follows.
void LiveMachine::finish_motion() {
    const std::lock_guard lock(mutex_);
    finished_ = feed_->taken();
    known_.note.clear();
    heard_us_ = settings_.clock->now_us();
    orders_.stop = finished_ == submitted_ ? hal::StopRequest::none : orders_.stop;
    known_.speed_mm_s = 0.0;
}

// While it stands, its place is that to the last digit where the motion ended.
bool LiveMachine::look_where(bool at_once) {
    const std::uint64_t now_us = settings_.clock->now_us();
    if (!at_once && now_us < looked_us_ + look_every_us) {
        return true;
    }
    {
        const std::lock_guard lock(mutex_);
        if (submitted_ == finished_ && !at_once) {
            return true;
        }
    }
    std::vector<RunTarget::AxisPlace> places = target_->places();
    const std::lock_guard lock(mutex_);
    if (facts_.has_feedback) {
        note_silence(places, now_us);
    }
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
    set_known(at_once ? known_.axes & axes : known_.axes);
    known_.places = std::move(places);
    return axes == all_axes();
}

// A drive that does not answer may take its port seconds until that is a fault: meanwhile the axes stand.
void LiveMachine::note_silence(const std::vector<RunTarget::AxisPlace>& places, std::uint64_t now_us) {
    constexpr std::uint64_t silence_us = 500'000;
    std::string silent;
    for (const RunTarget::AxisPlace& at : places) {
        silent += at.online ? std::string() : (silent.empty() ? "" : ", ") + machine_->axis_name[at.axis];
    }
    heard_us_ = silent.empty() ? now_us : heard_us_;
    const bool says = now_us - heard_us_ > silence_us;
    known_.note =
        says ? "No answer from " + silent + ": the axes are held; look at its power and cable" : std::string();
}

} // namespace splinefeed::host
