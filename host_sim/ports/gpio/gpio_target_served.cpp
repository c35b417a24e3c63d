// SPDX-License-Identifier: MIT
//
// What a GpioTarget does for many motions: each begins where the one before has ended, whatever has ended it; and for a
// machine that is served: its switches, sleep, the ways back from a stop.
#include "host_sim/ports/gpio/gpio_target.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

using hal::gpio::InputRole;

// A motion that begins a little beside the middle between two counts begins at the count where its axis stands, which
// may be the other one: no step is lost however often that happens.
bool GpioTarget::align(const FeedSegment& first) {
    constexpr std::int64_t half = units_per_count / 2;
    constexpr std::int64_t most = units_per_count / 100;
    for (const unsigned k : indices(machine_->settings.axes)) {
        place_unknown(static_cast<int>(k), first); // behind a search of others
        const std::int64_t at = mover_.count(static_cast<int>(k)) * units_per_count;
        shift_[k] = std::clamp(first.start[k], at - half, at + half - 1) - first.start[k];
        if (shift_[k] > most || shift_[k] < -most) {
            hold(StopCause::drive_fault,
                 fmt::format("axis {} stands at {:.4f} mm, and its motion begins at {:.4f} mm", machine_->axis_name[k],
                             mover_.position(static_cast<int>(k)),
                             static_cast<double>(first.start[k]) / static_cast<double>(units_per_count) /
                                 machine_->settings.axis[k].steps_per_mm));
            return false;
        }
    }
    return true;
}

bool GpioTarget::submit(const FeedSegment& segment) noexcept {
    const auto limit = stops_.led_into(segment);
    if (limit) {
        hold(StopCause::limit_switch, fmt::format("the {} still acts: move away from it", inputs_.name(*limit)));
    }
    if (limit || (std::exchange(begins_, false) && !align(segment))) {
        port_.quick_stop();
        return false;
    }
    FeedSegment own = segment;
    for (const unsigned k : indices(machine_->settings.axes)) {
        own.start[k] += shift_[k];
        own.end[k] += shift_[k];
    }
    return port_.submit(own);
}

void GpioTarget::hold(StopCause cause, const std::string& why) {
    if (holds_.empty()) {
        holds_ = why;
        cause_ = cause;
    }
}

void GpioTarget::hold_by(std::size_t input) {
    const bool limit = map_->inputs[input].role == InputRole::limit;
    const char* const what = !options_.serves ? "held on the path"
                             : limit          ? "reset, unlock by $X, and jog away from it"
                                              : "see what the drive shows, and reset";
    hold(limit ? StopCause::limit_switch : StopCause::drive_fault,
         fmt::format("the {} acts: {}", inputs_.name(input), what));
}

void GpioTarget::forget_stop() noexcept {
    holds_.clear();
    cause_ = StopCause::none;
    stop_.reset();
    executed_us_ = 0;
    quick_ = completed_ = false;
}

void GpioTarget::set_ready(const RunOptions& options) {
    options_.home = options.home;
    options_.reset = options.reset;
    options_.home_axes = options.home_axes;
    options_.placed = options.placed;
}

// The drives were off, or are on and stand. What has stopped them stays until a reset; so does a limit on which a
// search was given up, which is a reset.
hal::PortFailure GpioTarget::open() {
    if (std::string what = inputs_.trouble().empty() ? inputs_.in_the_way(false) : fault(); !what.empty()) {
        return {what};
    }
    const Stop stop = stopped_by();
    const bool stands_well =
        stop.cause == StopCause::none || (stop.cause == StopCause::limit_switch && options_.interrupted());
    if (!options_.reset && !stands_well) {
        return {stop.why};
    }
    if (port_.was_disabled() || !port_.position_known()) {
        port_.close();
        if (!port_.clear()) {
            return {fault()};
        }
        forget_places();
    }
    forget_stop();
    stops_.let_leave();
    return {};
}

hal::PortFailure GpioTarget::renew(const FeedSegment& first) {
    options_.home = options_.reset = false;
    return prepare(first);
}

RunTarget::Stop GpioTarget::stopped_by() {
    const bool pressed = inputs_.pressed().has_value();
    if (port_.was_disabled() || !port_.position_known()) {
        const bool e_stop = pressed || (port_.was_disabled() && inputs_.trouble().empty() &&
                                        stop_.report(0).request != hal::StopRequest::disable);
        return {e_stop ? StopCause::emergency_stop : StopCause::drive_fault,
                fault() + (e_stop ? "; release it, and reset" : "")};
    }
    if (pressed) {
        return {StopCause::emergency_stop, inputs_.in_the_way(false)};
    }
    if (const auto input = stops_.acting()) {
        hold_by(*input);
    }
    return {cause_, holds_};
}

std::uint32_t GpioTarget::homes_with(std::uint32_t axes) const {
    std::uint32_t out = 0;
    for (const unsigned k : indices(machine_->settings.axes)) {
        out |= map_->home[k] ? axes & (1U << k) : 0U;
    }
    return out;
}

std::vector<RunTarget::AxisPlace> GpioTarget::references() const {
    std::vector<AxisPlace> out;
    out.reserve(static_cast<std::size_t>(machine_->settings.axes));
    for (int k = 0; k < machine_->settings.axes; ++k) {
        out.push_back({static_cast<unsigned>(k), place(k)});
    }
    return out;
}

SwitchFacts GpioTarget::switch_facts() const {
    SwitchFacts out;
    out.homes = homes_with(UINT32_MAX);
    out.probe = has(InputRole::probe);
    for (const hal::gpio::MappedInput& input : map_->inputs) {
        if (input.role == InputRole::limit) {
            out.limits |= 1U << static_cast<unsigned>(input.axis);
            out.debounce_us = std::max(out.debounce_us, input.debounce_us);
        }
    }
    for (const unsigned k : indices(machine_->settings.axes)) {
        if (const auto& home = map_->home[k]) {
            const auto slower = [](double so_far, double mm_s) {
                return so_far > 0.0 ? std::min(so_far, mm_s) : mm_s;
            };
            out.homes_low |= home->towards_high ? 0U : 1U << k;
            out.pull_off_mm = std::max(out.pull_off_mm, home->pull_off_mm);
            out.seek_mm_s = slower(out.seek_mm_s, home->seek_mm_s);
            out.latch_mm_s = slower(out.latch_mm_s, home->latch_mm_s);
        }
    }
    out.no_home = fmt::format("add [home.AXIS] to {}, and an [[input]] with role = \"home\"", map_->file);
    return out;
}

RunTarget::Switches GpioTarget::switches() {
    take_changes();
    Switches out;
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const hal::gpio::MappedInput& input = map_->inputs[i];
        if (inputs_.active(i)) {
            out.limits |= input.role == InputRole::limit ? 1U << static_cast<unsigned>(input.axis) : 0U;
            out.probe = out.probe || input.role == InputRole::probe;
            out.e_stop = out.e_stop || input.role == InputRole::e_stop;
        }
    }
    out.touched_mm = touched_mm_;
    return out;
}

void GpioTarget::watch_probe(bool away) {
    take_changes(); // those before do not count
    probe_away_ = away;
    touched_mm_.reset();
}

std::uint64_t GpioTarget::least_ahead_us() const noexcept {
    constexpr std::uint64_t on_its_way_us = 8'000; // from the plan to the port, by two threads
    return port_.reserve_us() + on_its_way_us;
}

void GpioTarget::forget_places() noexcept {
    for (int k = 0; k < machine_->settings.axes; ++k) {
        mover_.forget_position(k);
    }
}

// Motors that hold no axis know no place.
std::string GpioTarget::switch_off() {
    port_.power_off();
    forget_places();
    return port_.may_be_on() ? "the drives could not be disabled and may still be on: " + port_.failure().what
                             : std::string();
}

} // namespace splinefeed::host
