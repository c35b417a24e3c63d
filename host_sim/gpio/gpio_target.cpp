// SPDX-License-Identifier: MIT
#include "gpio_target.hpp"

#include "host_sim/gpio_map.hpp"
#include "host_sim/input_error.hpp"
#include "host_sim/signal_watch.hpp"
#include "host_sim/step_lines.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <thread>

namespace splinefeed::host {

using hal::gpio::InputRole;

namespace {

constexpr double ns_per_s = 1e9;
constexpr double us_per_s = 1e6;
constexpr int calls = 500;    // to measure one by
constexpr double share = 0.5; // of the time that calls may take
constexpr std::uint32_t ns_per_us = 1000;

GpioChips taken(const hal::gpio::LineMap& map, const MachineDescription& machine) try {
    return {map, machine};
} catch (const hal::gpio::GpioError& error) {
    throw TargetError(error.what());
}

std::vector<GpioSummary::Octave> octaves(const hal::gpio::LateHistogram& late) {
    std::vector<GpioSummary::Octave> some;
    for (std::size_t i = 0; i < hal::gpio::LateHistogram::octaves; ++i) {
        if (late.count(i) > 0) {
            some.push_back({static_cast<double>(std::uint64_t{1} << i) / us_per_s, late.count(i)});
        }
    }
    return some;
}

/// What the thread of a port will lack.
std::string lacking(const hal::gpio::RealTimeSettings& settings) {
    std::string missing;
    std::thread([&] { missing = claim_real_time(settings); }).join();
    return missing;
}

} // namespace

double most_edges_per_s(double call_ns) noexcept {
    return share * ns_per_s / call_ns;
}

// Along a path at a feed f the axes make at most |steps_per_mm| f steps a second in all (Cauchy-Schwarz).
double asked_edges_per_s(const MachineDescription& machine) noexcept {
    double of_axes = 0.0;
    double squares = 0.0;
    double rotary = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(machine.settings.axes); ++k) {
        const AxisSettings& axis = machine.settings.axis[k];
        const double rate = axis.max_velocity_mm_s * axis.steps_per_mm;
        (axis.rotary ? rotary : of_axes) += rate;
        squares += axis.rotary ? 0.0 : axis.steps_per_mm * axis.steps_per_mm;
    }
    const double steps = rotary + std::min(of_axes, std::sqrt(squares) * machine.settings.max_feed_mm_s);
    return steps * (machine.step.step_on_edge ? 1.0 : 2.0);
}

hal::gpio::StepPortSettings port_settings(const MachineDescription& machine, const hal::gpio::LineMap& map) {
    return {.axes = machine.settings.axes,
            .timing = checked_step_timing(machine),
            .real_time = {.priority = map.thread.priority,
                          .cpu = map.thread.cpu,
                          .spin_ns = map.thread.spin_us * ns_per_us},
            .tolerated_ns = std::uint64_t{map.thread.tolerated_late_us} * ns_per_us,
            .settle_ms = map.enable ? map.enable->settle_ms : 0};
}

GpioTarget::GpioTarget(const GpioAddress& address, const MachineDescription& machine, const RunWishes& wishes)
    : machine_(&machine), wishes_(wishes), map_(read_gpio_map(address.map, machine, address.chip)),
      chips_(taken(map_, machine)), port_(chips_.outputs(), port_settings(machine, map_)),
      inputs_(map_, machine, chips_, port_),
      mover_(machine, map_, inputs_, port_, &SignalWatch::interrupts, [this] { quick_stop(); }),
      missing_(awake_.missing() + lacking(port_settings(machine, map_).real_time)),
      began_ns_(hal::gpio::monotonic_ns()) {
    const std::vector<std::uint64_t> times = chips_.set_times_ns(calls);
    const double mean_ns = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
    if (asked_edges_per_s(machine) > most_edges_per_s(mean_ns)) {
        throw UsageError(
            fmt::format("--target: a call that sets lines takes {:.1f} us on this chip, so that they can be "
                        "set {:.0f} times a second, and the machine's limits may ask for {:.0f}; lower its "
                        "velocities, max_feed_mm_s or steps_per_mm",
                        mean_ns / ns_per_us, most_edges_per_s(mean_ns), asked_edges_per_s(machine)));
    }
    const auto has = [&](InputRole role) {
        return std::any_of(map_.inputs.begin(), map_.inputs.end(),
                           [&](const auto& input) { return input.role == role; });
    };
    if (wishes.probe && !has(InputRole::probe)) {
        throw UsageError(fmt::format("--probe: {} has no input with the role probe", address.map));
    }
    if (wishes.home &&
        std::none_of(map_.home.begin(), map_.home.end(), [](const auto& home) { return home.has_value(); })) {
        throw UsageError(fmt::format("--home: {} has no axis with a home switch ([home.x] and an input)", address.map));
    }
}

std::string GpioTarget::note() const {
    return missing_.empty() ? missing_
                            : "edges may come late: " + missing_.substr(0, missing_.size() - 2) + " (docs/gpio.md)";
}

std::string GpioTarget::prepare(const FeedSegment& first) {
    if (std::string what = inputs_.in_the_way(!wishes_.home); !what.empty()) {
        return what;
    }
    began_ = true;
    PerAxis<double> begin_mm{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        mover_.stands_at(k, nearest_step(first.start[axis]));
        begin_mm[axis] = static_cast<double>(first.start[axis]) / static_cast<double>(units_per_count) /
                         machine_->settings.axis[axis].steps_per_mm;
    }
    if (wishes_.home) {
        if (std::string what = mover_.home(); !what.empty()) {
            return port_.was_cut() ? fault() : what;
        }
        if (std::string what = inputs_.in_the_way(true); !what.empty()) {
            return what;
        }
        if (std::string what = mover_.go_to(begin_mm); !what.empty()) {
            return port_.was_cut() ? fault() : what;
        }
    }
    while (inputs_.take()) { // what homing told is no news
    }
    port_.stop();
    port_.reset();
    static_cast<void>(port_.start());
    began_ns_ = hal::gpio::monotonic_ns();
    return {};
}

void GpioTarget::look() {
    while (const auto change = inputs_.take()) {
        const hal::gpio::MappedInput& input = map_.inputs[change->input];
        GpioSummary::Change told{
            .role = role_name(input.role),
            .axis = input.axis >= 0 ? machine_->axis_name[static_cast<unsigned>(input.axis)] : std::string(),
            .active = change->active,
            .time_s = (static_cast<double>(change->time_ns) - static_cast<double>(began_ns_)) / ns_per_s,
            .position_mm = std::nullopt};
        if (change->counts) {
            told.position_mm.emplace();
            for (int k = 0; k < machine_->settings.axes; ++k) {
                told.position_mm->push_back(mover_.position_at(k, (*change->counts)[static_cast<unsigned>(k)]));
            }
        }
        changes_.push_back(std::move(told));
        const bool stops = input.role == InputRole::limit || input.role == InputRole::drive_fault;
        if (!change->active || !holds_.empty()) {
            continue;
        }
        if (stops) {
            holds_ = fmt::format("the {} acts: held on the path", inputs_.name(change->input));
        } else if (input.role == InputRole::probe && wishes_.probe) {
            holds_ = fmt::format("the {} touched: held on the path", inputs_.name(change->input));
            probed_ = true;
        }
    }
}

void GpioTarget::complete() {
    if (wishes_.probe && !probed_ && holds_.empty()) {
        holds_ = "the probe did not touch anything on the way";
    }
    port_.complete();
}

void GpioTarget::quick_stop() {
    quick_ = true;
    port_.cut();
}

void GpioTarget::release() noexcept {
    port_.stop();
    chips_.make_safe();
}

std::string GpioTarget::fault() const {
    if (const std::string what = inputs_.trouble(); !what.empty()) {
        return what + ": cut off";
    }
    if (!port_.was_cut()) {
        return port_.trouble();
    }
    return quick_ ? "interrupted twice: cut off" : "the e-stop was pressed: cut off";
}

std::string GpioTarget::where() const {
    if (!began_) {
        return "; nothing was moved";
    }
    std::string text = port_.was_cut() ? "; drives are off, and where the machine stands is not known (find the "
                                         "references again); the last steps were those to"
                                       : "; the machine stands at";
    for (int k = 0; k < machine_->settings.axes; ++k) {
        text += fmt::format(" {}={:.4f}", machine_->axis_name[static_cast<unsigned>(k)], mover_.position(k));
    }
    return text + " mm";
}

void GpioTarget::describe(Summary& summary) const {
    const hal::gpio::LateHistogram& late = port_.late();
    const hal::gpio::StepPortReport report = port_.report();
    summary.gpio = GpioSummary{.edges = report.edges,
                               .median_late_s = static_cast<double>(late.below_us(0.5)) / us_per_s,
                               .percent_late_s = static_cast<double>(late.below_us(0.99)) / us_per_s,
                               .most_late_s = static_cast<double>(late.most_ns()) / ns_per_s,
                               .late = octaves(late),
                               .stretched_s = static_cast<double>(report.stretched_ns) / ns_per_s,
                               .slowdowns = report.slowdowns,
                               .began_monotonic_s = static_cast<double>(began_ns_) / ns_per_s,
                               .missed = inputs_.missed(),
                               .changes = changes_};
}

} // namespace splinefeed::host
