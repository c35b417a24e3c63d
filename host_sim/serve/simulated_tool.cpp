// SPDX-License-Identifier: MIT
#include "host_sim/serve/simulated_tool.hpp"

#include "host_sim/config/decimal_number.hpp"

#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::chrono::milliseconds homing_time{500};

std::chrono::nanoseconds duration_of(const FeedSegment& segment) {
    return std::chrono::nanoseconds(std::int64_t{segment.duration_ticks} * 125);
}

} // namespace

SimulatedTool::SimulatedTool(MachineDescription machine, int segments_per_sample, const PerAxis<double>& position,
                             bool known)
    : description_(std::move(machine)), segments_per_sample_(segments_per_sample), mm_(position), known_(known) {
    for (const unsigned k : indices(max_axes)) {
        position_[k] = position_from_mm(mm_[k]);
    }
    begin_chain();
}

void SimulatedTool::begin_chain() {
    queue_.clear();
    queued_ = {};
    moves_ = false;
    speed_mm_s_ = 0.0;
    machine_.emplace(description_, segments_per_sample_);
}

void SimulatedTool::submit(const FeedSegment& segment) {
    queue_.push_back(segment);
    queued_ += duration_of(segment);
}

void SimulatedTool::advance(Time now) {
    now_ = now;
    if (queue_.empty()) {
        time_ = now;
    }
    while (!queue_.empty() && time_ + duration_of(queue_.front()) <= now) {
        const FeedSegment segment = queue_.front();
        queue_.pop_front();
        queued_ -= duration_of(segment);
        time_ += duration_of(segment);
        execute(segment);
    }
    if (homing_ == HomingPhase::busy && now >= homed_) {
        homing_ = HomingPhase::done;
        known_ = true;
        for (const unsigned k : indices(description_.settings.axes)) {
            const bool homes = (homing_axes_ >> k & 1U) != 0;
            mm_[k] = homes ? 0.0 : mm_[k];
            position_[k] = homes ? Position{} : position_[k];
        }
        begin_chain();
    }
}

// It checks every limit: what breaks one is a fault, as on a machine.
void SimulatedTool::execute(const FeedSegment& segment) {
    if (!fault_.empty()) {
        return;
    }
    if (!machine_->submit(segment) || machine_->poll().phase == hal::PortPhase::fault) {
        fault_ = machine_->failure().what;
        begin_chain();
        return;
    }
    const PerAxis<double> before = mm_;
    double way_sq = 0.0;
    for (const unsigned k : indices(description_.settings.axes)) {
        mm_[k] = static_cast<double>(segment.end[k]) /
                 (static_cast<double>(units_per_count) * description_.settings.axis[k].steps_per_mm);
        position_[k] = position_from_mm(mm_[k]);
        way_sq += (mm_[k] - before[k]) * (mm_[k] - before[k]);
    }
    moves_ = !segment.ends_at_rest();
    speed_mm_s_ = moves_ ? std::sqrt(way_sq) / std::chrono::duration<double>(duration_of(segment)).count() : 0.0;
}

std::vector<RunTarget::AxisPlace> SimulatedTool::places() const {
    std::vector<RunTarget::AxisPlace> out;
    for (const unsigned k : indices(description_.settings.axes)) {
        out.push_back({k, mm_[k]});
    }
    return out;
}

MachineReading SimulatedTool::read() noexcept {
    MachineReading out;
    out.position = position_;
    out.stands = stands();
    out.executes = !queue_.empty();
    out.waypoint = out.executes ? queue_.front().waypoint : 0;
    out.known = known_;
    out.spindle_ready = now_ >= spindle_ready_;
    out.homing = homing_;
    out.alarm = fault_.empty() ? Alarm::none : Alarm::drive_fault;
    out.alarm_sentence = fault_;
    out.feed_mm_min = Decimal{static_cast<std::int64_t>(speed_mm_s_ * 60e9)};
    return out;
}

void SimulatedTool::obey(const ProgramEvent& event) noexcept {
    const bool back = event.kind == EventKind::spindle_counterclockwise;
    if ((back || event.kind == EventKind::spindle_clockwise || event.kind == EventKind::spindle_stop) &&
        description_.spindle) {
        const double rpm = event.kind == EventKind::spindle_stop ? 0.0 : number_of(event.value) * (back ? -1.0 : 1.0);
        const std::chrono::duration<double> takes(description_.spindle->change_s(rpm_, rpm));
        spindle_ready_ = now_ + std::chrono::duration_cast<std::chrono::nanoseconds>(takes);
        rpm_ = rpm;
    }
}

// Nothing is ever touched.
void SimulatedTool::watch_probe(bool /*away*/) noexcept {}

void SimulatedTool::home(std::uint32_t axes) noexcept {
    homing_ = HomingPhase::busy;
    homing_axes_ = axes;
    homed_ = now_ + homing_time;
}

void SimulatedTool::quick_stop() noexcept {
    homing_ = homing_ == HomingPhase::busy ? HomingPhase::failed : homing_;
    begin_chain();
}

void SimulatedTool::reset_faults() noexcept {
    fault_.clear();
}

} // namespace splinefeed::host
