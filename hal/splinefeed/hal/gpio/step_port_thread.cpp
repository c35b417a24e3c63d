// SPDX-License-Identifier: MIT
//
// What the thread of a StepPort does. Each cycle it obeys requests, then advances by its phase (step_phases.cpp):
//
//     segment ring ──► PulseTrain ──► edges of one tick ──► EdgeClock: wait until due ──► one write a chip
//
// It sleeps in slices, so disable() takes effect within one slice.
#include "splinefeed/hal/gpio/step_port.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::uint64_t lead_ns = 5'000'000; // longer than any set-up time
constexpr std::uint64_t supply_ns = 200'000; // between two checks for more segments
constexpr std::int64_t slow_ns = 10'000'000; // with steps further apart than this, any motor stops between them

} // namespace

bool StepPort::buffer_filled() const noexcept {
    return asked(complete_bit) || edges_.room() == 0 || end_ns() >= motion_ns_.load() + buffer_ns();
}

// From v with a: v / a, in which half of it passes of the motion.
std::uint64_t StepPort::reserve_ns(const FeedSegment& segment) const noexcept {
    const double unit_s = static_cast<double>(units_per_count) * segment.duration_ticks * ns_per_tick * 1e-9;
    double least_s = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(settings_.axes) && segment.duration_ticks > 0; ++k) {
        const auto most =
            static_cast<double>(std::max(std::llabs(segment.start_velocity[k]), std::llabs(segment.end_velocity[k])));
        least_s =
            settings_.acceleration[k] > 0.0 ? std::max(least_s, most / unit_s / settings_.acceleration[k]) : least_s;
    }
    const auto asked = static_cast<std::uint64_t>(std::min(least_s * 0.5e9, 1e9));
    return std::clamp(asked, least_reserve_ms * ns_per_ms, settings_.reserve_ms * ns_per_ms);
}

// Edges of axes at rest, or nearly at rest, may be arbitrarily late.
bool StepPort::stalled(std::uint64_t late_ns) const noexcept {
    if (late_ns <= settings_.stall_ns || !clock_.has_made()) {
        return false;
    }
    return edges_.gathered() ? edges_.tick() * ns_per_tick - clock_.last_motion_ns() < slow_ns : !at_rest_.load();
}

void StepPort::wait_until(std::uint64_t instant_ns, std::uint32_t spin_ns) const noexcept {
    time_->sleep_until_ns(instant_ns - std::min<std::uint64_t>(spin_ns, instant_ns));
    while (time_->now_ns() < instant_ns) {
    }
}

// The end of the thread waits for axes that move. A phase is overdue only where a cycle did not end it.
void StepPort::work() noexcept {
    while (!asked(end_bit) || axes_move(phases_.phase())) {
        const std::uint64_t now_ns = time_->now_ns();
        last_cycle_us_.store(now_ns / ns_per_us);
        obey(now_ns);
        advance(now_ns);
        if (const char* const why = phases_.overdue(now_ns / ns_per_us); why != nullptr) {
            overdue_.store(why);
            error_.store(overdue_error);
            switch_off(StepEvent::overdue);
        }
    }
}

void StepPort::obey(std::uint64_t now_ns) noexcept {
    const StepPhase phase = phases_.phase();
    if (switched_off(phase)) {
        return;
    }
    if (asked(disable_bit)) {
        switch_off(StepEvent::disable);
    } else if (asked(silent_bit)) {
        switch_off(StepEvent::error);
    } else if (asked(quick_stop_bit) || (asked(end_bit) && axes_move(phase))) {
        if (phase == StepPhase::running) {
            slow_down(now_ns);
        }
        take(StepEvent::quick_stop);
    }
}

void StepPort::advance(std::uint64_t now_ns) noexcept {
    const std::uint64_t lasted_us = now_ns / ns_per_us - std::min(phases_.entered_us(), now_ns / ns_per_us);
    switch (phases_.phase()) {
    case StepPhase::settling:
        if (lasted_us > settings_.settle_ms * us_per_ms) {
            if (!lines_.brake(true)) {
                fail(errno);
                return;
            }
            take(StepEvent::ready);
        }
        break;
    case StepPhase::opening:
        if (lasted_us > settings_.brake_release_ms * us_per_ms) {
            take(StepEvent::opened);
        }
        break;
    case StepPhase::filling: begin(now_ns); break;
    case StepPhase::running:
    case StepPhase::slowing:
    case StepPhase::starved:
    case StepPhase::stopping: pursue(now_ns); return;
    case StepPhase::disabled:
    case StepPhase::failed:
        if (may_be_on_.load()) {
            switch_off(StepEvent::error);
        }
        break;
    case StepPhase::off:
    case StepPhase::done:
    case StepPhase::halted:
    case StepPhase::count: break;
    }
    wait_until(now_ns + supply_ns, 0);
}

// More is buffered than the reserve, so a motion that has just begun does not slow down.
void StepPort::begin(std::uint64_t now_ns) noexcept {
    if (cut_off()) {
        take(StepEvent::cut_off);
    } else if (buffer_filled() && edges_.gather(lines_, asked(complete_bit))) {
        clock_.start(now_ns + lead_ns, 0);
        take(StepEvent::filled);
    } else if (edges_.exhausted()) {
        take(StepEvent::exhausted);
    }
}

// As the speed asks for, with what is known.
void StepPort::slow_down(std::uint64_t now_ns) noexcept {
    const std::int64_t left = static_cast<std::int64_t>(end_ns()) - clock_.motion_ns(now_ns);
    const auto known = static_cast<std::uint64_t>(std::max<std::int64_t>(left, ns_per_ms));
    clock_.stop(now_ns, std::min(present_ns_.load(), known));
}

// Slows the clock down before the segments run out, and resumes it when there are enough. The clock never runs ahead of
// edges that are still to be written: after a pause of the process the motion resumes where it was.
void StepPort::follow_clock(std::uint64_t now_ns) noexcept {
    const std::uint64_t end = end_ns();
    const std::int64_t to_be_made = edges_.gathered() ? edges_.tick() * ns_per_tick : static_cast<std::int64_t>(end);
    if (const std::uint64_t late = clock_.absorb_delay(to_be_made, now_ns); late > 0) {
        if (stalled(late)) {
            fail(stall_error);
            return;
        }
        overdue_ns_ += late;
        schedule_slip_ns_.store(clock_.schedule_slip_ns());
    }
    const auto motion = static_cast<std::uint64_t>(std::max<std::int64_t>(clock_.motion_ns(now_ns), 0));
    if (motion_ns_.exchange(motion) != motion) {
        phases_.progress(now_ns / ns_per_us);
    }
    present_ns_.store(reserve_ns(edges_.current()));
    switch (phases_.phase()) {
    case StepPhase::running:
        if (!whole() && end < motion + present_ns_.load() + slice_ns) {
            slow_down(now_ns);
            buffer_underruns_.fetch_add(at_rest_.load() ? 0 : 1);
            take(StepEvent::late);
        }
        break;
    case StepPhase::starved:
        if (cut_off()) {
            take(StepEvent::cut_off);
        } else if (buffer_filled()) {
            clock_.resume(now_ns);
            take(StepEvent::refilled);
        }
        break;
    default: // the clock waits for edges that are not known
        if (clock_.at_standstill(now_ns) || (!edges_.gathered() && motion >= end)) {
            take(StepEvent::stands);
        }
    }
}

// Makes the next edges of the motion when they are due.
void StepPort::pursue(std::uint64_t now_ns) noexcept {
    const bool some = edges_.gather(lines_, asked(complete_bit));
    follow_clock(now_ns);
    if (axes_move(phases_.phase()) && !some && edges_.exhausted() && whole()) {
        take(StepEvent::exhausted);
    }
    const bool moves = axes_move(phases_.phase());
    const std::uint64_t due = some && moves ? clock_.due_ns(edges_.tick() * ns_per_tick) : EdgeClock::never;
    if (due > now_ns + slice_ns) {
        wait_until(now_ns + (some && moves ? slice_ns : supply_ns), 0);
        return;
    }
    wait_until(due, settings_.real_time.spin_ns);
    make();
}

void StepPort::make() noexcept {
    if (!lines_.write()) {
        fail(errno);
        return;
    }
    const std::uint64_t at_ns = time_->now_ns();
    for (const unsigned k : indices(settings_.axes)) {
        if (edges_.steps(k)) {
            counts_[k].fetch_add(lines_.up(k) ? 1 : -1, std::memory_order_relaxed);
            log_.add(at_ns, k, lines_.up(k));
        }
    }
    const std::int64_t motion_ns = edges_.tick() * ns_per_tick;
    const bool late_for_good = stalled(clock_.late_ns(motion_ns, at_ns));
    late_.add(clock_.made(motion_ns, at_ns) + overdue_ns_);
    edges_.made();
    overdue_ns_ = 0;
    made_.fetch_add(1, std::memory_order_relaxed);
    schedule_slip_ns_.store(clock_.schedule_slip_ns(), std::memory_order_relaxed);
    if (late_for_good) {
        fail(stall_error);
    }
}

} // namespace splinefeed::hal::gpio
