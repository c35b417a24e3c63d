// SPDX-License-Identifier: MIT
#include "host_sim/serve/served_target.hpp"

#include "host_sim/config/decimal_number.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

ProgramAction action_of(const ProgramEvent& event) {
    ProgramAction out{.kind = event.kind, .number = event.number, .value = number_of(event.value), .text = {}};
    out.wait = event.wait;
    switch (event.kind) {
    case EventKind::spindle_clockwise: out.spindle = SpindleTurn{1, out.value}; break;
    case EventKind::spindle_counterclockwise: out.spindle = SpindleTurn{-1, out.value}; break;
    case EventKind::spindle_stop: out.spindle = SpindleTurn{}; break;
    default: break;
    }
    return out;
}

} // namespace

std::atomic<bool> ServedTarget::gives_up_{false};

ServedTarget::ServedTarget(std::unique_ptr<RunTarget> target, const MachineDescription& machine,
                           const Settings& settings, MakeOutputs outputs)
    : machine_(&machine), target_(std::move(target)), make_outputs_(std::move(outputs)), outputs_(make_outputs_()),
      clock_(settings.clock), feed_(*target_, outputs_.get(), nullptr, {}, *clock_),
      segment_ticks_(settings.segment_ticks) {
    gives_up_.store(false);
    known_.mm = settings.told_mm;
    find_place();
    known_.axes |= target_->has_feedback() ? 0U : settings.told & all_axes();
    thread_ = clock_->start([this] { work(); });
}

ServedTarget::~ServedTarget() {
    static_cast<void>(finish());
}

std::string ServedTarget::finish() {
    {
        const std::lock_guard lock(mutex_);
        leaves_.store(true);
        gives_up_.store(true);
    }
    if (thread_) {
        thread_->join();
        thread_.reset();
    }
    return unconfirmed_;
}

void ServedTarget::advance(Time now) {
    constexpr std::chrono::milliseconds while_it_moves{50}; // answers of drives may be late
    const std::uint64_t executed = feed_.executed();
    moved_ = executed != seen_ ? now : moved_;
    seen_ = executed;
    stalls_ = now - moved_ > while_it_moves;
}

// A port begins when it has enough, or all: a plan that waits for lines, and a port that waits for the plan, would wait
// for ever.
bool ServedTarget::is_dry() const {
    const std::uint64_t left_ticks = (feed_.pushed() - std::min(feed_.pushed(), feed_.executed())) * segment_ticks_;
    return stalls_ || left_ticks < target_->least_ahead_us() * static_cast<std::uint64_t>(ticks_per_us);
}

void ServedTarget::submit(const FeedSegment& segment) {
    {
        const std::lock_guard lock(mutex_);
        ++submitted_;
        known_.axes = all_axes(); // the operator has unlocked what the drives did not know
    }
    rests_ = false;
    waypoints_.push_back(segment.waypoint);
    feed_.push(segment);
}

void ServedTarget::rest() {
    if (!std::exchange(rests_, true)) {
        feed_.complete();
    }
}

bool ServedTarget::stands() const {
    const std::lock_guard lock(mutex_);
    return submitted_ == finished_ && !busy_ && !orders_.any();
}

std::vector<RunTarget::AxisPlace> ServedTarget::places() const {
    std::vector<RunTarget::AxisPlace> out;
    const std::lock_guard lock(mutex_);
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.push_back({k, (known_.axes >> k & 1U) != 0 ? std::optional(known_.mm[k]) : std::nullopt});
    }
    return out;
}

MachineReading ServedTarget::read() noexcept {
    MachineReading out;
    out.stands = stands();
    const std::uint64_t left = feed_.pushed() - std::min(feed_.pushed(), feed_.executed());
    while (waypoints_.size() > left) {
        waypoints_.pop_front();
    }
    out.executes = !out.stands && !waypoints_.empty();
    out.waypoint = out.executes ? waypoints_.front() : 0;
    out.spindle_ready = feed_.carried_out();
    out.spindle_stands = feed_.spindle_stands();
    out.input = feed_.answer();
    const std::lock_guard lock(mutex_);
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.position[k] = position_from_mm(known_.mm[k]);
    }
    out.known = known_.axes == all_axes();
    out.homing = known_.homing;
    out.alarm = known_.alarm;
    out.inputs = known_.switches.limits | (known_.switches.probe ? InputBits::probe : 0U) |
                 (known_.switches.e_stop ? InputBits::emergency_stop : 0U);
    out.touched = known_.switches.touched_mm.has_value();
    for (const unsigned k : indices(out.touched ? machine_->settings.axes : 0)) {
        out.touched_at[k] = position_from_mm((*known_.switches.touched_mm)[k]);
    }
    out.feed_mm_min = out.stands ? Decimal{} : Decimal{std::llround(known_.speed_mm_s * 60e9)};
    sentence_ = known_.sentence;
    out.alarm_sentence = sentence_;
    return out;
}

// The controller lets the machine stand before what has to wait for that.
void ServedTarget::obey(const ProgramEvent& event) noexcept {
    feed_.order(action_of(event), false);
}

bool ServedTarget::has_output(EventKind kind, std::int32_t number) const noexcept {
    const ProgramLines& lines = machine_->lines;
    switch (kind) {
    case EventKind::mist_on: return lines.mist.has_value();
    case EventKind::flood_on: return lines.flood.has_value();
    case EventKind::output_on_with_motion:
    case EventKind::output_off_with_motion:
    case EventKind::output_on:
    case EventKind::output_off: return lines.output(number) != nullptr;
    default: return false;
    }
}

void ServedTarget::forget_input() noexcept {
    constexpr std::int32_t none = -1;
    feed_.order({.kind = EventKind::input_wait, .number = none, .text = {}}, false);
}

void ServedTarget::watch_probe(bool away) noexcept {
    const std::lock_guard lock(mutex_);
    orders_.probe = away;
    known_.switches.touched_mm.reset();
}

void ServedTarget::home(std::uint32_t axes) noexcept {
    const std::lock_guard lock(mutex_);
    orders_.home = axes;
    known_.homing = HomingPhase::busy;
}

bool ServedTarget::halt() noexcept {
    const std::lock_guard lock(mutex_);
    const bool halts = submitted_ != finished_ && target_->halts();
    orders_.stops = halts ? std::max(orders_.stops, 1) : orders_.stops;
    return halts;
}

void ServedTarget::quick_stop() noexcept {
    const std::lock_guard lock(mutex_);
    if (std::exchange(orders_.home, 0U) != 0) { // not begun
        known_.homing = HomingPhase::failed;
    }
    orders_.stops = submitted_ != finished_ ? 2 : orders_.stops;
    gives_up_.store(true);
}

void ServedTarget::enable(bool on) noexcept {
    const std::lock_guard lock(mutex_);
    (on ? orders_.opens : orders_.off) = true;
}

void ServedTarget::reset_faults() noexcept {
    const std::lock_guard lock(mutex_);
    orders_.opens = orders_.resets = true;
    known_.alarm = Alarm::none;
    known_.sentence.clear();
}

} // namespace splinefeed::host
