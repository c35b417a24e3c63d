// SPDX-License-Identifier: MIT
#include "host_sim/live/live_machine.hpp"

#include "host_sim/config/decimal_number.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/number/vector.hpp"

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

std::atomic<bool> LiveMachine::gives_up_{false};

LiveMachine::LiveMachine(RunTarget& target, const MachineDescription& machine, const Settings& settings,
                         MakeOutputs outputs)
    : target_(&target), machine_(&machine), settings_(settings), make_outputs_(std::move(outputs)),
      outputs_(make_outputs_().release()) {
    facts_ = target.facts();
    feed_.emplace(target, outputs_.get(), settings.record, *settings.clock);
    gives_up_.store(false);
    known_.mm = settings.told_mm;
    unlocked_axes_ = all_axes() & (facts_.has_feedback ? UINT32_MAX : ~facts_.switches.homes);
    if (serves()) {
        find_place();
        known_.axes |= facts_.has_feedback ? 0U : settings.told & all_axes();
        kept_places_ = places();
        start();
    }
}

LiveMachine::~LiveMachine() {
    if (runs() && !serves()) {
        stop();
    }
    leave();
    if (settings_.signals != nullptr) {
        settings_.signals->at_once({});
    }
}

void LiveMachine::start() {
    thread_ = settings_.clock->start([this] { work(); });
}

// The thread is over behind it; each step of its end is bounded.
void LiveMachine::leave() noexcept {
    {
        const std::lock_guard lock(mutex_);
        leaves_.store(true);
        gives_up_.store(gives_up_.load() || (is_real() && serves()));
    }
    if (thread_ != nullptr) {
        thread_->join();
    }
}

const std::string& LiveMachine::finish() {
    if (serves()) {
        leave();
        return ending_;
    }
    rest();
    while (runs()) {
        settings_.clock->sleep_us(poll_every_us);
    }
    return ending_;
}

// A port begins when it has enough, or all: a plan that waits for lines, and a port that waits for the plan, would wait
// for ever.
bool LiveMachine::is_dry() const {
    const std::uint64_t left = submitted() - std::min(submitted(), executed());
    return stalls_.load() ||
           left * settings_.segment_ticks < least_ahead_us_.load() * static_cast<std::uint64_t>(ticks_per_us);
}

bool LiveMachine::submit(const FeedSegment& segment, std::uint64_t line, std::uint64_t moves) {
    if (!is_real()) {
        return true;
    }
    while (!over() && !has_room()) {
        settings_.clock->sleep_us(poll_every_us);
    }
    if (over()) {
        return false;
    }
    const bool first = thread_ == nullptr;
    if (first) {
        settings_.signals->supervise(); // from here on a signal is obeyed by the one end
    }
    begin_to_move();
    begin_label(line, moves);
    at_rest_ = segment.ends_at_rest();
    rests_ = false;
    feed_->push(segment);
    if (first) {
        start();
    }
    return true;
}

void LiveMachine::begin_to_move() {
    {
        const std::lock_guard lock(mutex_);
        if (settings_.state == nullptr || std::exchange(moves_, true)) {
            return;
        }
    }
    settings_.state->moves();
    const std::lock_guard lock(mutex_);
    waits_ = true; // behind that, and before anything is there that could move
}

void LiveMachine::keep() {
    std::vector<RunTarget::AxisPlace> now = places(); // homing, an e-stop and sleep change them, too
    {
        const std::lock_guard lock(mutex_);
        if (settings_.state == nullptr || (!std::exchange(moves_, false) && now == kept_places_)) {
            return;
        }
        kept_places_ = now;
    }
    settings_.state->ends(now);
}

// An axis whose place was lost is found by a search, or by a drive that knows it, not by who unlocks the machine: what
// he is told is where it stood before. @pre the mutex is held
void LiveMachine::set_known(std::uint32_t axes) noexcept {
    unlocked_axes_ &= ~(known_.axes & ~axes);
    known_.axes = axes;
}

// Those of segments that are executed are forgotten by come_to().
void LiveMachine::begin_label(std::uint64_t line, std::uint64_t moves) {
    const std::lock_guard lock(mutex_);
    ++submitted_;
    known_.axes |= unlocked_axes_;
    if (labels_.empty() || labels_.back().line != line || labels_.back().moves != moves) {
        labels_.push_back({line, moves, feed_->pushed()});
    }
}

void LiveMachine::rest() {
    if (std::exchange(rests_, true)) {
        return;
    }
    if (at_rest_ || serves()) { // a controller rests behind a motion that was halted, too
        feed_->complete();
    } else {
        stop("the plan ended while the axes moved");
    }
}

void LiveMachine::stop(const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (!(rests_ && at_rest_)) {
        stop_why_ = stop_why_.empty() ? why : stop_why_;
        orders_.stop = std::max(orders_.stop, hal::StopRequest::hold);
    }
}

void LiveMachine::order(const ProgramAction& action, bool standing) {
    if (is_real()) {
        feed_->order(action, standing);
    }
}

bool LiveMachine::spindle_stands() const {
    return !is_real() || (feed_->spindle_stands() && settings_.clock->now_us() >= stands_from_us_.load());
}

LiveMachine::Reached LiveMachine::reached() const {
    const std::lock_guard lock(mutex_);
    return labels_.empty() ? Reached{} : Reached{labels_.front().line, labels_.front().moves};
}

bool LiveMachine::stands() const {
    const std::lock_guard lock(mutex_);
    return submitted_ == finished_ && !busy_ && !orders_.any();
}

std::vector<RunTarget::AxisPlace> LiveMachine::places() const {
    const std::lock_guard lock(mutex_);
    if (!is_real() || !serves()) {
        return known_.places;
    }
    std::vector<RunTarget::AxisPlace> out;
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.push_back({k, (known_.axes >> k & 1U) != 0 ? std::optional(known_.mm[k]) : std::nullopt});
    }
    return out;
}

void LiveMachine::describe(Summary& summary) const {
    if (is_real()) {
        target_->describe(summary);
    }
}

MachineReading LiveMachine::read() noexcept {
    MachineReading out;
    out.stands = stands();
    out.spindle_ready = feed_->carried_out();
    out.spindle_stands = spindle_stands();
    out.input = feed_->answer();
    const std::lock_guard lock(mutex_);
    out.executes = !out.stands && feed_->executed() < feed_->pushed();
    out.waypoint = out.executes ? static_cast<std::uint32_t>(labels_.front().moves) : 0;
    const int axes = machine_->settings.axes;
    out.position = position_from_mm(known_.mm, axes);
    out.known = known_.axes == all_axes();
    out.homing = known_.homing;
    out.alarm = known_.alarm;
    out.inputs = known_.switches.limits | (known_.switches.probe ? InputBits::probe : 0U) |
                 (known_.switches.e_stop ? InputBits::emergency_stop : 0U);
    out.touched = known_.switches.touched_mm.has_value();
    out.touched_at = out.touched ? position_from_mm(*known_.switches.touched_mm, axes) : PerAxis<Position>{};
    out.feed_mm_min = out.stands ? Decimal{} : Decimal{std::llround(known_.speed_mm_s * 60e9)};
    sentence_ = known_.sentence;
    out.alarm_sentence = sentence_;
    note_ = known_.note;
    out.note = note_;
    return out;
}

// The controller lets the machine stand before what has to wait for that.
void LiveMachine::obey(const ProgramEvent& event) noexcept {
    feed_->order(action_of(event), false);
}

bool LiveMachine::has_output(EventKind kind, std::int32_t number) const noexcept {
    return settings_.simulates ? kind != EventKind::input_wait : machine_->lines.has(kind, number);
}

void LiveMachine::forget_input() noexcept {
    feed_->order({.kind = EventKind::input_wait, .number = ProgramOutputs::none, .text = {}}, false);
}

void LiveMachine::watch_probe(bool away) noexcept {
    const std::lock_guard lock(mutex_);
    orders_.probe = away;
    known_.switches.touched_mm.reset();
}

void LiveMachine::home(std::uint32_t axes) noexcept {
    begin_to_move();
    const std::lock_guard lock(mutex_);
    orders_.home = axes;
    known_.homing = HomingPhase::busy;
}

bool LiveMachine::halt() noexcept {
    const std::lock_guard lock(mutex_);
    const bool halts = submitted_ != finished_ && (facts_.halts || waits_);
    orders_.stop = halts ? std::max(orders_.stop, hal::StopRequest::hold) : orders_.stop;
    return halts;
}

// That has not begun.
void LiveMachine::give_up_homing() noexcept {
    const std::lock_guard lock(mutex_);
    if (std::exchange(orders_.home, 0U) != 0) {
        known_.homing = HomingPhase::failed;
    }
}

void LiveMachine::quick_stop() noexcept {
    give_up_homing();
    const std::lock_guard lock(mutex_);
    orders_.stop = submitted_ != finished_ ? hal::StopRequest::quick_stop : orders_.stop;
    gives_up_.store(true);
}

void LiveMachine::enable(bool on) noexcept {
    const std::lock_guard lock(mutex_);
    (on ? orders_.opens : orders_.off) = true;
}

void LiveMachine::reset_faults() noexcept {
    const std::lock_guard lock(mutex_);
    orders_.opens = orders_.resets = true;
    known_.alarm = Alarm::none;
    known_.sentence.clear();
}

} // namespace splinefeed::host
