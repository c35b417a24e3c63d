// SPDX-License-Identifier: MIT
//
// One thread writes all edges:
//
//     segment ring ──► PulseTrain ──► edges of one tick ──► EdgeClock: wait until due ──► one write a chip
//
// It sleeps in slices, so disable() takes effect within one slice.
#include "splinefeed/hal/gpio/step_port.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::int64_t ns_per_tick = 125;
constexpr std::uint64_t ns_per_ms = 1'000'000;
constexpr std::size_t ring_segments = 4096;
constexpr std::uint64_t lead_ns = 5 * ns_per_ms;   // longer than any set-up time
constexpr std::uint64_t supply_ns = ns_per_ms / 5; // between two checks for more segments
constexpr std::uint64_t claim_ns = ns_per_ms / 10; // between two checks whether the thread has started
constexpr std::int64_t slow_ns = 10'000'000;       // with steps further apart than this, any motor stops between them
constexpr std::uint64_t ns_per_us = 1000;
constexpr int stall_error = -1; // no errno

std::uint64_t guard_of(const StepTiming& timing) noexcept {
    return std::max({timing.high, timing.low, timing.setup, timing.hold}) * std::uint64_t{ns_per_tick};
}

} // namespace

// The buffer is more than twice the reserve, so a motion that has just begun does not slow down.
StepPort::StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings)
    : lines_(std::move(chips), settings.axes, settings.timing.step_on_edge), settings_(settings),
      train_(make_pulse_train(settings.axes, settings.timing)),
      clock_({.guard_ns = guard_of(settings.timing),
              .tolerated_ns = settings.tolerated_ns,
              .reserve_ns = settings.buffer_ms * ns_per_ms * 2 / 5}),
      segments_(ring_segments), ring_(segments_), time_(settings.clock != nullptr ? settings.clock : &system_clock()) {}

StepPort::~StepPort() {
    stop();
}

std::string StepPort::start() {
    if (was_disabled()) {
        state_.store(State::disabled);
    }
    if (!position_known()) {
        return {};
    }
    if (!lines_.enable(true)) {
        fail(errno);
        return {};
    }
    if (!drives_on_) {
        drives_on_ = true;
        drives_ready_ns_ = time_->now_ns() + settings_.settle_ms * ns_per_ms;
    }
    std::string missing;
    ends_.store(false);
    claimed_.store(false);
    thread_ = time_->start([this, &missing] {
        missing = claim_real_time(settings_.real_time);
        claimed_.store(true);
        work();
    });
    while (!claimed_.load()) {
        time_->sleep_until_ns(time_->now_ns() + claim_ns);
    }
    return missing;
}

void StepPort::stop() noexcept {
    ends_.store(true);
    if (thread_) {
        thread_->join();
        thread_.reset();
    }
}

void StepPort::park() noexcept {
    if (!drives_on_ || !position_known()) {
        return; // never enabled, or disabled already
    }
    if (!lines_.brake(false)) {
        may_be_on_.store(true);
    }
    time_->sleep_until_ns(time_->now_ns() + settings_.brake_engage_ms * ns_per_ms);
    if (!lines_.enable(false)) {
        may_be_on_.store(true);
    }
    drives_on_ = false;
    brake_released_ = false;
}

void StepPort::reset() noexcept {
    train_ = make_pulse_train(settings_.axes, settings_.timing);
    ring_.clear();
    lines_.begin();
    have_ = false;
    gathered_ = false;
    overdue_ns_ = 0;
    finished_ = false;
    submitted_ticks_.store(0);
    motion_ns_.store(0);
    complete_.store(false);
    clock_stopped_.store(false);
    quick_stop_.store(false);
    if (position_known()) {
        state_.store(State::idle);
    }
}

StepPortReport StepPort::report() const noexcept {
    return {edges_.load(), buffer_underruns_.load(), schedule_slip_ns_.load()};
}

std::string StepPort::trouble() const {
    const int error = error_.load();
    if (error == stall_error) {
        return "no step was made for longer than " + std::to_string(settings_.stall_ns / ns_per_ms) +
               " ms while axes moved, because the process or its host was suspended; motors that stop abruptly lose "
               "steps";
    }
    return error == 0 ? std::string("the drives were disabled")
                      : std::string("a line cannot be set: ") + std::strerror(error); // NOLINT(concurrency-mt-unsafe)
}

// Drops pending edges and disables the drives. The thread tries again if a line cannot be set.
void StepPort::switch_off() noexcept {
    lines_.drop();
    switched_off_ = lines_.enable(false);
    may_be_on_.store(!switched_off_);
}

void StepPort::fail(int error) noexcept {
    error_.store(error);
    switch_off();
    state_.store(State::failed);
}

bool StepPort::buffer_filled() const noexcept {
    const std::uint64_t held = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    return complete_.load(std::memory_order_acquire) || ring_.room() == 0 ||
           held >= motion_ns_.load(std::memory_order_relaxed) + settings_.buffer_ms * ns_per_ms;
}

// Slows the clock down before the segments run out, and resumes it when there are enough. The clock never runs ahead of
// edges that are still to be written: after a pause of the process the motion resumes where it was.
void StepPort::check_supply(std::uint64_t now_ns) noexcept {
    const std::int64_t to_be_made =
        gathered_ ? gathered_tick_ * ns_per_tick
                  : static_cast<std::int64_t>(submitted_ticks_.load(std::memory_order_relaxed)) * ns_per_tick;
    if (const std::uint64_t late = clock_.absorb_delay(to_be_made, now_ns); late > 0) {
        if (stalled(late)) {
            fail(stall_error);
            return;
        }
        overdue_ns_ += late;
        schedule_slip_ns_.store(clock_.schedule_slip_ns(), std::memory_order_relaxed);
    }
    const auto motion = static_cast<std::uint64_t>(std::max<std::int64_t>(clock_.motion_ns(now_ns), 0));
    motion_ns_.store(motion, std::memory_order_relaxed);
    if (clock_.stopping()) {
        const bool resumes =
            clock_.at_standstill(now_ns) && buffer_filled() && !quick_stop_.load(std::memory_order_relaxed);
        if (resumes) {
            clock_.resume(now_ns);
        }
        clock_stopped_.store(!resumes && clock_.at_standstill(now_ns), std::memory_order_relaxed);
        return;
    }
    const std::uint64_t end = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    const std::uint64_t reserve = settings_.buffer_ms * ns_per_ms * 2 / 5 + slice_ns;
    if (!complete_.load(std::memory_order_acquire) && end < motion + reserve) {
        clock_.stop(now_ns);
        buffer_underruns_.fetch_add(at_rest_.load(std::memory_order_relaxed) ? 0 : 1, std::memory_order_relaxed);
    }
}

// Edges of axes at rest, or nearly at rest, may be arbitrarily late.
bool StepPort::stalled(std::uint64_t late_ns) const noexcept {
    if (late_ns <= settings_.stall_ns || !clock_.has_made()) {
        return false;
    }
    return gathered_ ? gathered_tick_ * ns_per_tick - clock_.last_motion_ns() < slow_ns
                     : !at_rest_.load(std::memory_order_relaxed);
}

void StepPort::wait_until(std::uint64_t instant_ns, std::uint32_t spin_ns) const noexcept {
    time_->sleep_until_ns(instant_ns - std::min<std::uint64_t>(spin_ns, instant_ns));
    while (time_->now_ns() < instant_ns) {
    }
}

template <class Engine>
bool StepPort::next_of(PulseTrain<Engine>& train, Edge& edge) noexcept {
    while (!train.next(edge)) {
        FeedSegment segment;
        // Read in this order, so that segments submitted before complete() are not missed.
        const bool complete = complete_.load(std::memory_order_acquire);
        if (ring_.pop(segment)) {
            train.take(segment);
            taken_.fetch_add(1, std::memory_order_relaxed);
        } else if (complete && !finished_) {
            train.finish();
            finished_ = true;
        } else {
            return false;
        }
    }
    return true;
}

// The next edge of the motion; false: none yet.
bool StepPort::next(Edge& edge) noexcept {
    if (auto* const train = std::get_if<PulseTrain<StepIntervals>>(&train_)) {
        return next_of(*train, edge);
    }
    return next_of(*std::get_if<PulseTrain<FixedRate>>(&train_), edge);
}

// Collects all edges of the next instant before the wait, so that the lines change at its end without computation.
bool StepPort::gather() noexcept {
    if (!have_ && !(have_ = next(edge_))) {
        return false;
    }
    gathered_ = true;
    gathered_tick_ = edge_.tick;
    stepped_ = {};
    do {
        lines_.add(edge_);
        stepped_[edge_.axis] = stepped_[edge_.axis] || steps(edge_);
    } while ((have_ = next(edge_)) && edge_.tick == gathered_tick_);
    return true;
}

void StepPort::make() noexcept {
    if (!lines_.write()) {
        fail(errno);
        return;
    }
    const std::uint64_t at_ns = time_->now_ns();
    for (unsigned k = 0; k < static_cast<unsigned>(settings_.axes); ++k) {
        if (stepped_[k]) {
            counts_[k].fetch_add(lines_.up(k) ? 1 : -1, std::memory_order_relaxed);
            log_.add(at_ns, k, lines_.up(k));
        }
    }
    const std::int64_t motion_ns = gathered_tick_ * ns_per_tick;
    const bool late_for_good = stalled(clock_.late_ns(motion_ns, at_ns));
    late_.add(clock_.made(motion_ns, at_ns) + overdue_ns_);
    gathered_ = false;
    overdue_ns_ = 0;
    edges_.fetch_add(1, std::memory_order_relaxed);
    schedule_slip_ns_.store(clock_.schedule_slip_ns(), std::memory_order_relaxed);
    if (late_for_good) {
        fail(stall_error);
    }
}

bool StepPort::steps(const Edge& edge) const noexcept {
    return edge.line == Line::step && (edge.level || settings_.timing.step_on_edge);
}

// Applies disable() and quick_stop(). Returns false if no further edge may be written.
bool StepPort::apply_requests(std::uint64_t now_ns) noexcept {
    State state = state_.load(std::memory_order_relaxed);
    if (disable_requested_.load(std::memory_order_acquire) && state != State::disabled) {
        switch_off();
        state_.store(state = State::disabled);
    }
    if (state == State::disabled || state == State::failed) {
        if (!switched_off_) {
            switch_off();
        }
        return false;
    }
    if (quick_stop_.load(std::memory_order_acquire)) {
        if (state == State::running && !clock_.stopping()) {
            clock_.stop(now_ns);
        } else if (state == State::idle || (state == State::running && clock_.at_standstill(now_ns))) {
            state_.store(state = State::halted);
        }
    }
    return state == State::idle || state == State::running;
}

// Releases the brake when the drives hold the axes. Returns true when the brake is open.
bool StepPort::drives_ready(std::uint64_t now_ns) noexcept {
    if (now_ns < drives_ready_ns_) {
        return false;
    }
    if (!brake_released_) {
        if (!lines_.brake(true)) {
            fail(errno);
            return false;
        }
        brake_released_ = true;
        brake_open_ns_ = now_ns + settings_.brake_release_ms * ns_per_ms;
    }
    return now_ns >= brake_open_ns_;
}

void StepPort::advance(std::uint64_t now_ns) noexcept {
    const bool idle = state_.load(std::memory_order_relaxed) == State::idle;
    const bool ready = !(idle && (!drives_ready(now_ns) || !buffer_filled())) && (gathered_ || gather());
    if (!idle) {
        check_supply(now_ns);
        if (state_.load(std::memory_order_relaxed) == State::failed) {
            return;
        }
    }
    if (!ready) {
        if (finished_) {
            state_.store(State::done);
            return;
        }
        wait_until(now_ns + supply_ns, 0);
        return;
    }
    if (idle) {
        clock_.start(now_ns + lead_ns, 0);
        state_.store(State::running);
    }
    const std::uint64_t due = clock_.due_ns(gathered_tick_ * ns_per_tick);
    if (due > now_ns + slice_ns) {
        wait_until(now_ns + slice_ns, 0);
        return;
    }
    wait_until(due, settings_.real_time.spin_ns);
    make();
}

void StepPort::work() noexcept {
    while (!ends_.load(std::memory_order_relaxed)) {
        const std::uint64_t now_ns = time_->now_ns();
        last_cycle_us_.store(now_ns / ns_per_us, std::memory_order_relaxed);
        if (apply_requests(now_ns)) {
            advance(now_ns);
        } else {
            wait_until(now_ns + slice_ns, 0);
        }
    }
}

bool StepPort::at_standstill() const noexcept {
    switch (state_.load()) {
    case State::running: return clock_stopped_.load(std::memory_order_relaxed);
    case State::failed:
    case State::idle:
    case State::done:
    case State::halted:
    case State::disabled: break;
    }
    return true;
}

int StepPort::do_room() const noexcept {
    const std::uint64_t held = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    const std::uint64_t most = motion_ns_.load(std::memory_order_relaxed) + settings_.buffer_ms * ns_per_ms;
    return held > most ? 0 : static_cast<int>(std::min<std::size_t>(ring_.room(), 1));
}

bool StepPort::do_submit(const FeedSegment& segment) noexcept {
    const State state = state_.load();
    if (state == State::halted || state == State::disabled || state == State::failed) {
        return false;
    }
    const auto moving = std::span(segment.end_velocity).first(static_cast<std::size_t>(settings_.axes));
    at_rest_.store(std::all_of(moving.begin(), moving.end(), [](std::int64_t v) { return v == 0; }));
    ring_.push(segment);
    submitted_ticks_.fetch_add(segment.duration_ticks);
    return true;
}

PortState StepPort::do_poll() noexcept {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    switch (state_.load()) {
    case State::disabled:
    case State::failed: return {PortPhase::fault, taken};
    case State::done: return {PortPhase::idle, taken};
    case State::halted: return {PortPhase::halted, taken};
    case State::idle:
    case State::running: break;
    }
    return {PortPhase::running, taken};
}

} // namespace splinefeed::hal::gpio
