// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_target.hpp"

#include "splinefeed/base/units.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/signal_watch.hpp"
#include "host_sim/config/gpio_map.hpp"
#include "host_sim/output/place_text.hpp"
#include "host_sim/ports/gpio/gpio_settings.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <thread>

namespace splinefeed::host {

using hal::gpio::InputRole;

namespace {

constexpr int measured_calls = 500; // to measure one by

std::vector<GpioSummary::Octave> octaves(const hal::TimeHistogram& late) {
    std::vector<GpioSummary::Octave> some;
    for (std::size_t i = 0; i < hal::TimeHistogram::octaves; ++i) {
        if (late.in_octave(i) > 0) {
            some.push_back({static_cast<double>(std::uint64_t{1} << i) / us_per_s, late.in_octave(i)});
        }
    }
    return some;
}

/// What the thread of a port will lack.
std::string lacking(const hal::RealTimeSettings& settings) {
    std::string missing;
    std::thread([&] { missing = claim_real_time(settings); }).join();
    return missing;
}

} // namespace

GpioTarget::GpioTarget(std::unique_ptr<hal::gpio::LineMap> map, std::unique_ptr<GpioLines> lines,
                       const MachineDescription& machine, const RunOptions& options, hal::Clock* clock)
    : machine_(&machine), options_(options), time_(clock != nullptr ? clock : &hal::system_clock()),
      map_(std::move(map)), chips_(std::move(lines)), port_(chips_->outputs(), port_settings(machine, *map_, clock)),
      // Above the thread that makes edges, which may spin: an e-stop must not wait for it.
      inputs_(*map_, machine, *chips_, port_,
              {.priority = clock == nullptr ? map_->thread.priority + 1 : 0, .clock = clock}),
      mover_(
          machine, *map_, inputs_, port_,
          [this] { return !options_.serves         ? SignalWatch::interrupts()
                          : options_.interrupted() ? 2
                                                   : 0; },
          [this] { quick_stop(); }, *time_),
      stops_(machine, *map_, inputs_), stop_(1, stop_times(machine)), began_ns_(time_->now_ns()) {
    if (clock == nullptr) {
        awake_.emplace();
        missing_ = awake_->missing() + lacking(port_settings(machine, *map_).real_time);
    }
    const std::vector<std::uint64_t> times = chips_->set_times_ns(measured_calls);
    const double mean_ns = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
    if (asked_edges_per_s(machine) > most_edges_per_s(mean_ns)) {
        throw UsageError("--target: a call that sets lines takes {:.1f} us on this chip, so that they can be "
                         "set {:.0f} times a second, and the machine's limits may ask for {:.0f}; lower its "
                         "velocities, max_feed_mm_s or steps_per_mm",
                         mean_ns / ns_per_us, most_edges_per_s(mean_ns), asked_edges_per_s(machine));
    }
    if (options.probe && !has(InputRole::probe)) {
        throw UsageError("--probe: the map has no input with the role probe");
    }
    if (options.home && std::ranges::none_of(map_->home, [](const auto& home) { return home.has_value(); })) {
        throw UsageError("--home: the map has no axis with a home switch ([home.x] and an input)");
    }
}

std::unique_ptr<GpioTarget> make_gpio_target(const GpioAddress& address, const MachineDescription& machine,
                                             const RunOptions& options) {
    auto map = std::make_unique<hal::gpio::LineMap>(read_gpio_map(address.map, machine, address.chip));
    std::unique_ptr<GpioLines> lines;
    try {
        lines = std::make_unique<GpioChips>(*map, machine);
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
    return std::make_unique<GpioTarget>(std::move(map), std::move(lines), machine, options);
}

bool GpioTarget::has(InputRole role) const noexcept {
    return std::ranges::any_of(map_->inputs, [&](const auto& input) { return input.role == role; });
}

// The lines become safe when nobody sets any more.
GpioTarget::~GpioTarget() {
    port_.close();
}

std::string GpioTarget::note() const {
    return missing_.empty()
               ? missing_
               : "edges may come late: " + missing_.substr(0, missing_.size() - 2) + " (docs/reference/gpio.md)";
}

hal::PortFailure GpioTarget::prepare(const FeedSegment& first) {
    return {make_ready(first)};
}

// Where axes stand whose place is not known is what the motion says. The others keep their counts.
std::string GpioTarget::make_ready(const FeedSegment& first) {
    const auto limit = options_.serves && !options_.home ? stops_.acting() : std::nullopt;
    if (limit) {
        return fmt::format("the {} acts", inputs_.name(*limit));
    }
    if (std::string what = inputs_.in_the_way(!options_.home && !options_.serves); !what.empty()) {
        return what;
    }
    forget_stop();
    began_ = true;
    PerAxis<double> begin_mm{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        if ((options_.placed >> axis & 1U) != 0) {
            place_unknown(k, first);
        }
        begin_mm[axis] = static_cast<double>(first.start[axis]) / static_cast<double>(units_per_count) /
                         machine_->settings.axis[axis].steps_per_mm;
    }
    if (options_.home) {
        if (std::string what = home(begin_mm); !what.empty()) {
            return port_.was_disabled() ? fault() : what;
        }
    }
    while (options_.home || !options_.serves ? inputs_.take().has_value() : false) { // changes during homing
    }
    port_.close();
    port_.reset();
    static_cast<void>(port_.start());
    begins_ = true;
    began_ns_ = options_.serves ? began_ns_ : time_->now_ns();
    return {};
}

void GpioTarget::place_unknown(int axis, const FeedSegment& first) noexcept {
    if (!mover_.referenced(axis)) {
        mover_.preset_position(axis, nearest_step(first.start[static_cast<unsigned>(axis)]));
    }
}

std::string GpioTarget::home(const PerAxis<double>& begin_mm) {
    const std::uint32_t axes = homes_with(options_.home_axes);
    for (int k = 0; k < machine_->settings.axes; ++k) {
        if ((axes >> static_cast<unsigned>(k) & 1U) != 0) {
            mover_.forget_position(k);
        }
    }
    std::string what = mover_.home(axes);
    what = what.empty() ? inputs_.in_the_way(true) : what;
    return !what.empty() || options_.serves ? what : mover_.go_to(begin_mm);
}

hal::PortState GpioTarget::poll() noexcept {
    take_changes();
    // Levels, too: a change may have been taken before the run.
    if (const auto input = stops_.acting()) {
        hold_by(*input);
    }
    if (inputs_.pressed() && !port_.was_disabled()) {
        port_.disable();
    }
    follow_stop();
    return port_.poll();
}

// What all axes do about it, as one: the plan holds; where it does not, the port stops; where that does not, it is cut.
void GpioTarget::follow_stop() {
    const std::uint64_t now_us = time_->now_us();
    if (!holds_.empty()) { // a controller brakes no plan behind the fault of a drive
        const bool alone = options_.serves && cause_ == StopCause::drive_fault;
        stop_.request(alone ? hal::StopRequest::quick_stop : hal::StopRequest::hold, now_us);
    }
    const hal::PortPhase phase = port_.poll().phase;
    const hal::StopRequest executed = port_.was_disabled() && phase == hal::PortPhase::fault ? hal::StopRequest::disable
                                      : port_.halted()                              ? hal::StopRequest::quick_stop
                                      : completed_ && phase == hal::PortPhase::idle ? hal::StopRequest::hold
                                                                                    : hal::StopRequest::none;
    executed_us_ = executed == hal::StopRequest::none ? 0 : executed_us_ == 0 ? now_us : executed_us_;
    const hal::StopFacts facts{.status_us = port_.last_cycle_us(),
                               .standstill = port_.at_standstill(),
                               .executed = executed,
                               .executed_us = executed_us_};
    stop_.update(now_us, {&facts, 1});
    if (stop_.to_send(0) == hal::StopRequest::quick_stop) {
        port_.quick_stop();
    } else if (stop_.to_send(0) == hal::StopRequest::disable) {
        port_.disable();
    }
}

PerAxis<double> GpioTarget::positions_at(const std::optional<PerAxis<std::int64_t>>& counts) const {
    PerAxis<double> out{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        out[axis] = counts ? mover_.position_at(k, (*counts)[axis]) : mover_.position(k);
    }
    return out;
}

// For the summary.
void GpioTarget::note(const SwitchChange& change) {
    const hal::gpio::MappedInput& input = map_->inputs[change.input];
    GpioSummary::Change entry{
        .role = role_name(input.role),
        .axis = input.axis >= 0 ? machine_->axis_name[static_cast<unsigned>(input.axis)] : std::string(),
        .active = change.active,
        .time_s = static_cast<double>(static_cast<std::int64_t>(change.time_ns - began_ns_)) / ns_per_s,
        .position_mm = std::nullopt};
    if (change.counts) {
        const PerAxis<double> at = positions_at(change.counts);
        entry.position_mm.emplace(at.begin(), at.begin() + machine_->settings.axes);
    }
    input_summary_.add(std::move(entry));
}

// Behind an alarm, too, where nobody polls: an axis that has stood for a while runs into nothing.
void GpioTarget::take_changes() {
    PerAxis<std::int64_t> counts{};
    for (const unsigned k : indices(machine_->settings.axes)) {
        counts[k] = port_.counts(static_cast<int>(k));
    }
    stops_.follow(counts, time_->now_us());
    while (const auto change = inputs_.take()) {
        note(*change);
        const bool probe = map_->inputs[change->input].role == InputRole::probe;
        if (probe && probe_away_ && change->active != *probe_away_) {
            touched_mm_ = positions_at(change->counts);
            probe_away_.reset();
        }
        if (stops_.stops(*change)) {
            hold_by(change->input);
        } else if (probe && change->active && options_.probe && holds_.empty()) {
            holds_ = fmt::format("the {} touched: held on the path", inputs_.name(change->input));
            probed_ = true;
        }
    }
}

void GpioTarget::complete() noexcept {
    if (options_.probe && !probed_ && holds_.empty()) {
        holds_ = "the probe did not touch anything on the way";
    }
    completed_ = true;
    port_.complete();
}

void GpioTarget::quick_stop() noexcept {
    quick_ = true;
    holds_ = "interrupted twice: stopped on the path";
    stop_.request(hal::StopRequest::quick_stop, time_->now_us());
    port_.quick_stop();
}

std::string GpioTarget::halted(bool /*quick*/) const {
    if (const std::string what = port_.failure().what; !quick_ && !what.empty()) {
        return (holds_.empty() ? holds_ : holds_ + "; ") + what + ": stopped on the path by the port";
    }
    return quick_ ? holds_ : holds_ + " (by the port: the plan did not bring the way to standstill in time)";
}

std::string GpioTarget::finish() {
    port_.close();
    if (machine_->drives_on_at_end.value_or(false) && port_.position_known()) {
        chips_->keep_drives_on();
    } else {
        port_.power_off();
    }
    finished_ = true;
    return port_.may_be_on() && port_.position_known()
               ? "the drives could not be disabled and may still be on: " + port_.failure().what
               : std::string();
}

void GpioTarget::close() noexcept {
    port_.close();
    if (!finished_) {
        chips_->make_safe();
    }
}

std::string GpioTarget::fault() const {
    const char* const drives = port_.may_be_on() ? "the drives could not be disabled" : "the drives were disabled";
    if (const std::string what = inputs_.trouble(); !what.empty()) {
        return what + ": " + drives;
    }
    if (!port_.was_disabled()) {
        return port_.failure().what;
    }
    // Asked of the port as the last means, or of the switch.
    return stop_.report(0).request == hal::StopRequest::disable ? holds_ + ", but the port did not stop: " + drives
                                                                : std::string("the e-stop was pressed: ") + drives;
}

// By the steps that were made from a reference on.
std::optional<double> GpioTarget::place(int axis) const {
    return mover_.referenced(axis) ? std::optional(mover_.position(axis)) : std::nullopt;
}

// Nothing on step lines knows it but the steps that were made; behind homing they are moved.
std::vector<RunTarget::AxisPlace> GpioTarget::standing() {
    std::vector<AxisPlace> out;
    for (int k = 0; !options_.home && k < machine_->settings.axes; ++k) {
        out.push_back({static_cast<unsigned>(k), port_.position_known() ? place(k) : std::nullopt});
    }
    return out;
}

// An axis that is asked to stop is at its place once it stands.
std::vector<RunTarget::AxisPlace> GpioTarget::places() const {
    std::vector<AxisPlace> out;
    for (int k = 0; began_ && k < machine_->settings.axes; ++k) {
        out.push_back({.axis = static_cast<unsigned>(k),
                       .mm = port_.position_known() ? place(k) : std::nullopt,
                       .online = holds_.empty() || port_.at_standstill()});
    }
    return out;
}

std::string GpioTarget::where() const {
    if (!began_) {
        return "; nothing was moved";
    }
    constexpr const char* unknown = "where the machine stands is not known (find the references again); the last steps "
                                    "were those to";
    PlaceText text(port_.position_known() ? std::string("; the machine stands at")
                   : port_.may_be_on()    ? std::string("; drives may still be on, and ") + unknown
                                          : std::string("; drives are off, and ") + unknown);
    for (int k = 0; k < machine_->settings.axes; ++k) {
        text.add(machine_->axis_name[static_cast<unsigned>(k)], place(k));
    }
    return text.text();
}

void GpioTarget::describe(Summary& summary) const {
    const hal::TimeHistogram& late = port_.late();
    const hal::gpio::StepPortReport report = port_.report();
    summary.gpio = GpioSummary{.edges = report.edges,
                               .median_late_s = late.below_us(0.5) / us_per_s,
                               .p99_late_s = late.below_us(0.99) / us_per_s,
                               .most_late_s = static_cast<double>(late.most_ns()) / ns_per_s,
                               .late = octaves(late),
                               .schedule_slip_s = static_cast<double>(report.schedule_slip_ns) / ns_per_s,
                               .buffer_underruns = report.buffer_underruns,
                               .began_monotonic_s = static_cast<double>(began_ns_) / ns_per_s,
                               .missed = inputs_.missed(),
                               .changes = input_summary_.changes,
                               .changes_left_out = input_summary_.changes_left_out};
}

} // namespace splinefeed::host
