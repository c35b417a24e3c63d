// SPDX-License-Identifier: MIT
//
// What the thread of a LiveMachine does before motions and between them: drives that are made ready, homed, reset,
// switched off.
#include "host_sim/live/live_machine.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

// The drives say where they stand; what they do not know has been told. Of those that cannot be asked it stays known.
void LiveMachine::find_place() {
    std::vector<RunTarget::AxisPlace> places;
    try {
        places = target_->standing();
    } catch (const TargetError& error) {
        fail_by(error.what());
        return;
    }
    phase_ = Phase::open;
    const std::lock_guard lock(mutex_);
    std::uint32_t known = facts_.has_feedback ? 0U : known_.axes;
    for (const RunTarget::AxisPlace& at : places) {
        known_.mm[at.axis] = at.mm.value_or(known_.mm[at.axis]);
        known |= at.mm ? 1U << at.axis : 0U;
    }
    set_known(known);
}

// Where the motion begins the machine has to stand: else a position would get another name.
void LiveMachine::begin_first() {
    if (phase_ == Phase::closed) {
        reopen();
    }
    if (phase_ != Phase::open) {
        return;
    }
    const FeedSegment first = feed_->front();
    for (const unsigned k : indices(machine_->settings.axes)) {
        const double counts = static_cast<double>(first.start[k]) / static_cast<double>(units_per_count);
        const double off = std::fabs(counts - known_.mm[k] * machine_->settings.axis[k].steps_per_mm);
        if (off > standstill_window_counts(*machine_, k)) {
            fail(fmt::format("axis {} stands elsewhere than where the motion begins: reset", machine_->axis_name[k]));
            return;
        }
    }
    const hal::PortFailure failure = make_ready(first);
    if (failure && gives_up()) {
        reopen();
        drop_motion();
    } else if (failure) {
        fail_by(failure.what);
    }
}

// Where the first segment begins is where the machine stands: RunStart has seen to that.
void LiveMachine::begin_run() {
    if (SignalWatch::interrupted()) {
        fail("interrupted before anything was moved; the drives were not enabled");
        return;
    }
    phase_ = Phase::failed;
    if (const hal::PortFailure failure = target_->port().prepare(feed_->front())) {
        fail(target_->sentence(failure));
        return;
    }
    phase_ = Phase::ready;
    feed_->begin(target_->port().poll().executed);
}

// Returns why it is not.
hal::PortFailure LiveMachine::make_ready(const FeedSegment& first) {
    target_->port().order(ready_);
    hal::MotionPort& port = target_->port();
    if (hal::PortFailure failure = port.prepare(first)) {
        failure.what = target_->sentence(failure);
        return failure;
    }
    ready_.reset = ready_.home = false;
    heard_us_ = settings_.clock->now_us();
    phase_ = Phase::ready;
    feed_->begin(port.poll().executed);
    return {};
}

std::uint32_t LiveMachine::known_axes() const {
    const std::lock_guard lock(mutex_);
    return known_.axes;
}

FeedSegment LiveMachine::standing() const {
    FeedSegment out{.duration_ticks = settings_.segment_ticks};
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.start[k] =
            std::llround(known_.mm[k] * machine_->settings.axis[k].steps_per_mm * static_cast<double>(units_per_count));
    }
    out.end = out.start;
    return out;
}

void LiveMachine::close() {
    if (facts_.has_feedback) {
        target_->port().close();
    }
    phase_ = Phase::closed;
}

void LiveMachine::switch_off() {
    if (phase_ == Phase::ready || !facts_.has_feedback) {
        if (const std::string what = target_->leave(true); !what.empty()) {
            fail(what);
            return;
        }
    }
    if (!facts_.has_feedback) {
        static_cast<void>(look_where(true)); // motors that hold no axis
    }
    close();
}

// Behind a fault, or with drives that were off: everything anew, and their faults are reset. What was on is on again.
void LiveMachine::recover(bool resets) {
    if (outputs_ == nullptr || feed_->outputs_ended() || !feed_->trouble().empty()) {
        renew_outputs();
    }
    if (phase_ == Phase::ready) {
        return;
    }
    ready_.reset = resets;
    if (phase_ != Phase::open) { // as it may be already, behind drives that were off
        reopen();
    }
    // Drives that were on and cannot be asked still are; those that an e-stop has switched off wait for a motion.
    if (phase_ != Phase::open || !resets || known_axes() != all_axes() || !facts_.has_feedback) {
        return;
    }
    if (const hal::PortFailure failure = make_ready(standing())) {
        fail_by(failure.what);
    }
}

// Once they have ended they take no order any more. What they had not confirmed by then is said at the end, if nobody
// can be connected to any more.
// Those that are made do not know what turned before them.
void LiveMachine::renew_outputs() {
    feed_->set_outputs(nullptr);
    if (outputs_ != nullptr) {
        outputs_->end();
        lost_outputs_ = outputs_->unended();
        coasts_until_us_ = settings_.clock->now_us() + outputs_->coasts_us();
    }
    stands_from_us_.store(lost_outputs_.empty() ? coasts_until_us_ : UINT64_MAX);
    outputs_.reset();
    outputs_.reset(make_outputs_().release());
    lost_outputs_.clear();
    stands_from_us_.store(coasts_until_us_);
    feed_->set_outputs(outputs_.get());
}

void LiveMachine::reopen() {
    if (!facts_.has_feedback) {
        static_cast<void>(look_where(true)); // what was lost meanwhile stays so
    }
    close();
    target_->port().order(ready_);
    if (const hal::PortFailure failure = target_->port().open()) {
        fail_by(target_->sentence(failure));
    } else {
        find_place();
    }
}

// The axes that search stand at 0 behind it, the others where they are. One that does not find its reference may stand
// anywhere.
void LiveMachine::find_references(std::uint32_t axes) {
    const std::uint32_t known = known_axes();
    const std::uint32_t search = facts_.search_of(axes);
    if (phase_ == Phase::ready || phase_ == Phase::closed) {
        reopen();
    }
    hal::PortFailure failure;
    FeedSegment found = standing();
    if (phase_ == Phase::open && !gives_up()) {
        ready_.home = true;
        ready_.home_axes = search;
        ready_.placed = known;
        {
            const std::lock_guard lock(mutex_);
            set_known(known_.axes & ~search);
            unlocked_axes_ &= ~search;
        }
        for (const unsigned k : indices(machine_->settings.axes)) {
            found.start[k] = (search >> k & 1U) != 0 ? 0 : found.start[k];
        }
        found.end = found.start;
        failure = make_ready(found);
        ready_.home = false;
        ready_.placed = UINT32_MAX;
    }
    const bool homed = phase_ == Phase::ready;
    if (homed) {
        take_place(found);
        static_cast<void>(facts_.has_feedback || look_where(true)); // where they stand behind their switches
    } else if (phase_ == Phase::open) {
        reopen(); // where it stands now
    }
    const std::lock_guard lock(mutex_);
    set_known(homed ? known | search : known_.axes | (known & ~search));
    known_.homing = homed                                         ? HomingPhase::done
                    : failure.remedy == hal::Remedy::clear_switch ? HomingPhase::not_cleared
                                                                  : HomingPhase::failed;
    known_.sentence = known_.alarm == Alarm::none ? failure.what : known_.sentence; // the controller says it
}

} // namespace splinefeed::host
