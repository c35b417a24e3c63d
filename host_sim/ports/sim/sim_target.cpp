// SPDX-License-Identifier: MIT
#include "host_sim/ports/sim/sim_target.hpp"

#include "host_sim/output/place_text.hpp"
#include "host_sim/ports/target_table.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr std::string_view sim_name = "sim";
constexpr std::uint64_t homing_us = 500'000;
constexpr std::uint64_t give_up_every_us = 1000;

} // namespace

TargetFacts SimTarget::facts() const {
    TargetFacts out{.has_feedback = false, .switches = {.probe = true, .no_home = {}}};
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.homes_with[k] = 1U << k;
    }
    return out;
}

hal::PortFailure SimTarget::prepare(const FeedSegment& first) {
    for (const std::uint64_t end_us = clock_->now_us() + homing_us; orders().home && clock_->now_us() < end_us;) {
        if (interrupted_()) {
            return {"interrupted"};
        }
        clock_->sleep_us(give_up_every_us);
    }
    return renew(first);
}

hal::PortFailure SimTarget::renew(const FeedSegment& first) {
    queue_.clear();
    queued_ticks_ = 0;
    checks_.emplace(*machine_, 1);
    mm_ = mm_of(first.start);
    phase_ = hal::PortPhase::running;
    completed_ = false;
    return {};
}

PerAxis<double> SimTarget::mm_of(const PerAxis<std::int64_t>& units) const noexcept {
    const MachineSettings& settings = machine_->settings;
    return each(settings.axes, [&](unsigned k) {
        return static_cast<double>(units[k]) / (static_cast<double>(units_per_count) * settings.axis[k].steps_per_mm);
    });
}

// Within the segment under way, evenly.
PerAxis<double> SimTarget::now_mm() const noexcept {
    PerAxis<double> out = mm_;
    if (!queue_.empty() && phase_ == hal::PortPhase::running) {
        const PerAxis<double> end = mm_of(queue_.front().end);
        const auto passed = static_cast<double>(now_ticks() - time_ticks_);
        const double part = std::min(1.0, passed / static_cast<double>(queue_.front().duration_ticks));
        add(out, part, difference(end, out, machine_->settings.axes), machine_->settings.axes);
    }
    return out;
}

int SimTarget::room() const noexcept {
    return queued_ticks_ < ahead_us * static_cast<std::uint64_t>(ticks_per_us) ? 1 : 0;
}

bool SimTarget::submit(const FeedSegment& segment) noexcept {
    if (phase_ != hal::PortPhase::running) {
        return false;
    }
    queue_.push_back(segment);
    queued_ticks_ += segment.duration_ticks;
    return true;
}

hal::PortState SimTarget::poll() noexcept {
    const std::uint64_t now = now_ticks();
    if (queue_.empty()) {
        time_ticks_ = now;
    }
    while (!queue_.empty() && phase_ == hal::PortPhase::running && time_ticks_ + queue_.front().duration_ticks <= now) {
        const FeedSegment segment = queue_.front();
        queue_.pop_front();
        queued_ticks_ -= segment.duration_ticks;
        time_ticks_ += segment.duration_ticks;
        if (!checks_->submit(segment) || checks_->poll().phase == hal::PortPhase::fault) {
            stop(hal::PortPhase::fault);
        } else {
            mm_ = mm_of(segment.end);
            ++executed_;
        }
    }
    const bool done = completed_ && queue_.empty() && phase_ == hal::PortPhase::running;
    return {done ? hal::PortPhase::idle : phase_, executed_};
}

void SimTarget::stop(hal::PortPhase phase) noexcept {
    mm_ = now_mm();
    queue_.clear();
    queued_ticks_ = 0;
    phase_ = phase;
}

hal::PortFailure SimTarget::failure() const {
    return checks_ ? checks_->failure() : hal::PortFailure{};
}

std::string SimTarget::halted(bool quick) const {
    return quick ? "interrupted twice: all axes stopped, each for itself" : "interrupted: all axes stopped";
}

std::vector<RunTarget::AxisPlace> SimTarget::places() const {
    std::vector<AxisPlace> out;
    const PerAxis<double> mm = now_mm();
    for (const unsigned k : indices(checks_ ? machine_->settings.axes : 0)) { // else nothing has moved
        out.push_back({k, mm[k]});
    }
    return out;
}

std::string SimTarget::where() const {
    PlaceText text;
    for (const AxisPlace& at : places()) {
        text.add(machine_->axis_name[at.axis], at.mm, at.online);
    }
    return places().empty() ? "; nothing was moved" : text.text();
}

void SimSpindle::act(const ProgramAction& action) {
    if (action.spindle) {
        turn(*action.spindle);
    }
}

void SimSpindle::turn(const SpindleTurn& turn) noexcept {
    const double wanted = turn.direction * turn.rpm;
    if (wanted == rpm_.load()) {
        return;
    }
    const double takes_us = machine_->change_s(rpm_.load(), wanted) * static_cast<double>(us_per_s);
    ready_us_.store(clock_->now_us() + static_cast<std::uint64_t>(std::llround(takes_us)));
    rpm_.store(wanted);
}

OutputPart::Progress SimSpindle::progress() const {
    const bool ready = clock_->now_us() >= ready_us_.load();
    const double stops_s = machine_->change_s(machine_->max_rpm, 0.0);
    return {ready, ready && rpm_.load() == 0.0, stops_s, stops_s};
}

extern const TargetKind sim_kind{
    .names = sim_name,
    .help = "sim: the simulated machine in this process (default)",
    .is_real = false,
    .is = [](const std::string& target) { return target == sim_name; },
    .check = [](const std::string& /*target*/) {},
    .make = [](const std::string& /*target*/, const MachineDescription& machine, const RunOptions& options)
        -> std::unique_ptr<RunTarget> { return std::make_unique<SimTarget>(machine, options); },
    .report = nullptr,
};

} // namespace splinefeed::host
