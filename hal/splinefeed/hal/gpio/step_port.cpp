// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/step_port.hpp"

#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::uint64_t claim_us = 100;            // between two checks whether the thread has started
constexpr std::uint64_t claim_most_us = 5'000'000; // for it

std::uint64_t guard_ticks(const StepTiming& timing) noexcept {
    return std::max({timing.high, timing.low, timing.setup, timing.hold});
}

} // namespace

StepPort::StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings)
    : lines_(std::move(chips), settings.axes, settings.timing.step_on_edge), settings_(settings),
      edges_(settings.axes, settings.timing), clock_({.guard_ns = guard_ticks(settings.timing) * ns_per_tick,
                                                      .tolerated_ns = settings.tolerated_ns,
                                                      .reserve_ns = settings.reserve_ms * ns_per_ms}),
      phases_(step_phase_table, StepPhase::off), time_(settings.clock != nullptr ? settings.clock : &system_clock()) {
    phases_.set_bounds(step_phase_bounds(settings.settle_ms * us_per_ms, settings.brake_release_ms * us_per_ms,
                                         settings.reserve_ms * us_per_ms));
}

StepPort::~StepPort() {
    close();
}

std::string StepPort::start() {
    if (phases_.phase() == StepPhase::starved || port_phase(phases_.phase()) != PortPhase::running) {
        reset(); // the motion before is over
    }
    const StepPhase phase = phases_.phase();
    if (was_disabled() && phase == StepPhase::off) {
        take(StepEvent::disable);
    } else if (was_disabled() && !switched_off(phase)) { // between two motions
        switch_off(StepEvent::disable);
    }
    if (!position_known()) {
        return {};
    }
    if (!lines_.enable(true)) {
        fail(errno);
        return {};
    }
    take(StepEvent::start);
    requests_.fetch_and(static_cast<std::uint8_t>(~end_bit));
    claimed_.store(false);
    last_cycle_us_.store(time_->now_us());
    thread_ = time_->start([this] {
        missing_ = claim_real_time(settings_.real_time);
        claimed_.store(true);
        work();
    });
    const char* const late = hal::wait_until(
        *time_, [this] { return claimed_.load(); }, claim_most_us, "the thread that makes steps does not start",
        claim_us);
    if (late != nullptr) {
        ask(silent_bit);
        return late;
    }
    return missing_;
}

PortFailure StepPort::prepare(const FeedSegment& /*first*/) {
    static_cast<void>(start());
    return failure();
}

void StepPort::close() noexcept {
    ask(end_bit);
    if (thread_) {
        thread_->join();
        thread_.reset();
    }
}

void StepPort::power_off() noexcept {
    close();
    const bool was_off = switched_off(phases_.phase());
    const bool is_on = phases_.phase() != StepPhase::off && !was_off;
    if (!is_on && !may_be_on_.load()) {
        return;
    }
    lines_.drop();
    if (is_on && position_known()) {
        may_be_on_.store(!lines_.brake(false));
        static_cast<void>(hal::wait_until(
            *time_, [this] { return was_disabled(); }, settings_.brake_engage_ms * us_per_ms, ""));
    }
    switch_off(was_disabled() && !was_off ? StepEvent::disable : StepEvent::park);
}

void StepPort::reset() noexcept {
    edges_.reset();
    lines_.begin();
    overdue_ns_ = 0;
    submitted_ticks_.store(0);
    ahead_ns_.store(0);
    present_ns_.store(least_reserve_ms * ns_per_ms);
    motion_ns_.store(0);
    at_rest_.store(true);
    refused_ = false;
    requests_.fetch_and(static_cast<std::uint8_t>(~(complete_bit | quick_stop_bit)));
    take(StepEvent::reset);
}

bool StepPort::clear() noexcept {
    if (!position_known() && (!switched_off(phases_.phase()) || may_be_on_.load())) {
        switch_off(StepEvent::error);
    }
    if (may_be_on_.load()) {
        return false;
    }
    requests_.fetch_and(static_cast<std::uint8_t>(~(disable_bit | silent_bit)));
    error_.store(0);
    overdue_.store(nullptr);
    if (switched_off(phases_.phase())) {
        take(StepEvent::clear);
    }
    reset();
    return true;
}

StepPortReport StepPort::report() const noexcept {
    return {made_.load(), buffer_underruns_.load(), schedule_slip_ns_.load()};
}

bool StepPort::may_be_on() const noexcept {
    return may_be_on_.load() || (asked(silent_bit) && !switched_off(phase_.load()));
}

std::string StepPort::trouble() const {
    const int error = error_.load();
    if (asked(silent_bit)) {
        return "the thread that makes steps has not run for " + std::to_string(silent_ms / 1000) +
               " s: a chip does not answer, or the host is too busy";
    }
    if (error == stall_error) {
        return "no step was made for longer than " + std::to_string(settings_.stall_ns / ns_per_ms) +
               " ms while axes moved, because the process or its host was suspended; motors that stop abruptly lose "
               "steps";
    }
    if (error == overdue_error) {
        return overdue_.load();
    }
    if (error != 0) {
        return std::string("a line cannot be set: ") + std::strerror(error); // NOLINT(concurrency-mt-unsafe)
    }
    return refused_    ? "a segment does not begin where the one before it ends"
           : cut_off() ? "the motion ends before the axes are at rest"
                       : "";
}

void StepPort::take(StepEvent event) noexcept {
    if (phases_.take(event, time_->now_us())) {
        phase_.store(phases_.phase());
    }
}

// Drops pending edges and disables the drives. The thread tries again if a line cannot be set.
void StepPort::switch_off(StepEvent why) noexcept {
    lines_.drop();
    const bool set = lines_.enable(false);
    if (int none = 0; !set) {
        error_.compare_exchange_strong(none, errno); // the first one is told
    }
    may_be_on_.store(!set);
    take(why);
}

void StepPort::fail(int error) noexcept {
    error_.store(error);
    switch_off(StepEvent::error);
}

std::uint64_t StepPort::end_ns() const noexcept {
    return submitted_ticks_.load() * ns_per_tick;
}

int StepPort::room() const noexcept {
    const std::uint64_t most = motion_ns_.load() + buffer_ns();
    return end_ns() > most ? 0 : static_cast<int>(std::min<std::size_t>(edges_.room(), 1));
}

bool StepPort::joins(const FeedSegment& segment) const noexcept {
    const auto axes = static_cast<std::size_t>(settings_.axes);
    return segment.duration_ticks > 0 &&
           (submitted_ticks_.load() == 0 ||
            std::equal(segment.start.begin(), segment.start.begin() + axes, last_.end.begin()));
}

// A segment that does not join would be a jump: the axes stop on the path that they have.
bool StepPort::submit(const FeedSegment& segment) noexcept {
    if (port_phase(phase_.load()) == PortPhase::fault || halted() || refused_) {
        return false;
    }
    if (!joins(segment) || !edges_.push(segment)) {
        refused_ = true;
        quick_stop();
        return false;
    }
    last_ = segment;
    ahead_ns_.store(reserve_ns(segment));
    at_rest_.store(segment.ends_at_rest());
    submitted_ticks_.fetch_add(segment.duration_ticks);
    return true;
}

// Looks are counted, too: a process that was suspended has had none.
PortState StepPort::poll() noexcept {
    const std::uint64_t now_us = time_->now_us();
    if (const std::uint64_t cycle_us = last_cycle_us(); cycle_us != seen_us_ || !thread_) {
        seen_us_ = cycle_us;
        first_us_ = now_us;
        looks_ = 0;
    } else if (++looks_ > silent_ms && now_us > first_us_ + silent_ms * us_per_ms) {
        ask(silent_bit);
    }
    return {asked(silent_bit) ? PortPhase::fault : port_phase(phase_.load()), edges_.taken()};
}

} // namespace splinefeed::hal::gpio
