// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_target.hpp"

#include "splinefeed/base/units.hpp"

#include "host_sim/config/gpio_map.hpp"
#include "host_sim/output/place_text.hpp"
#include "host_sim/ports/gpio/gpio_chips.hpp"
#include "host_sim/ports/gpio/gpio_settings.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <thread>

namespace splinefeed::host {

using hal::gpio::GpioCause;
using hal::gpio::InputRole;
using hal::gpio::Origin;

namespace {

constexpr int measured_calls = 500; // to measure one by

/// What the user is told of a stop, behind what the port says.
struct CauseWords {
    GpioCause cause;
    Alarm stop;              // what it is for a controller,
    const char* when_served; // and what to do there
    const char* in_a_run;
};

const CauseWords& words_of(GpioCause cause) {
    static constexpr std::array words{
        CauseWords{GpioCause::none, Alarm::none, "", ""},
        CauseWords{GpioCause::asked, Alarm::none, "", ": held on the path"},
        CauseWords{GpioCause::asked_twice, Alarm::none, "", ": stopped on the path"},
        CauseWords{GpioCause::untouched, Alarm::none, "", ""},
        CauseWords{GpioCause::touched, Alarm::none, "", ": held on the path"},
        CauseWords{GpioCause::limit, Alarm::limit_switch, ": reset, unlock by $X, and jog away from it",
                   ": held on the path"},
        CauseWords{GpioCause::led_further, Alarm::limit_switch, "", ""},
        CauseWords{GpioCause::drive_fault, Alarm::drive_fault, ": see what the drive shows, and reset",
                   ": held on the path"},
        CauseWords{GpioCause::misplaced, Alarm::drive_fault, "", ""},
        CauseWords{GpioCause::e_stop, Alarm::emergency_stop, "", ""},
        CauseWords{GpioCause::disabled, Alarm::drive_fault, "", ""},
    };
    return *std::ranges::find(words, cause, &CauseWords::cause);
}

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

/// Throws UsageError where the machine cannot do what is asked of it.
void require_fit(const hal::gpio::PinMap& map, const MachineDescription& machine, hal::gpio::MachinePins& lines,
                 const RunOptions& options) {
    const std::vector<std::uint64_t> times = lines.set_times_ns(measured_calls);
    const double mean_ns = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
    if (asked_edges_per_s(machine) > most_edges_per_s(mean_ns)) {
        throw UsageError("--target: a call that sets lines takes {:.1f} us on this chip, so that they can be "
                         "set {:.0f} times a second, and the machine's limits may ask for {:.0f}; lower its "
                         "velocities, max_feed_mm_s or steps_per_mm",
                         mean_ns / ns_per_us, most_edges_per_s(mean_ns), asked_edges_per_s(machine));
    }
    if (options.probe &&
        std::ranges::find(map.inputs, InputRole::probe, &hal::gpio::MappedInput::role) == map.inputs.end()) {
        throw UsageError("--probe: the map has no input with the role probe");
    }
    if (options.orders.home && std::ranges::none_of(map.home, [](const auto& home) { return home.has_value(); })) {
        throw UsageError("--home: the map has no axis with a home switch ([home.x] and an input)");
    }
}

} // namespace

GpioTarget::GpioTarget(std::unique_ptr<hal::gpio::PinMap> map, std::unique_ptr<hal::gpio::MachinePins> lines,
                       const MachineDescription& machine, const RunOptions& options, hal::Clock* clock)
    : machine_(&machine), map_(std::move(map)), lines_(std::move(lines)),
      port_(*map_, gpio_port_settings(machine, *map_, options, clock), *lines_,
            [this](const auto& change, const auto& mm) { note(change, mm); }) {
    if (clock == nullptr) {
        awake_.emplace();
        missing_ = awake_->missing() + lacking(port_settings(machine, *map_).real_time);
    }
    require_fit(*map_, machine, *lines_, options);
    port_.order(options.orders);
}

std::unique_ptr<GpioTarget> make_gpio_target(const GpioAddress& address, const MachineDescription& machine,
                                             const RunOptions& options) {
    auto map = std::make_unique<hal::gpio::PinMap>(read_gpio_map(address.map, machine, address.chip));
    try {
        auto lines = std::make_unique<GpioChips>(*map, machine);
        return std::make_unique<GpioTarget>(std::move(map), std::move(lines), machine, options);
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
}

TargetFacts GpioTarget::facts() const {
    TargetFacts out{.has_feedback = false};
    for (const unsigned k : indices(machine_->settings.axes)) {
        out.homes_with[k] = map_->home[k] ? 1U << k : 0U;
    }
    out.switches = switch_facts();
    out.switches.homes = out.search_of(UINT32_MAX);
    if (!missing_.empty()) {
        out.note = "edges may come late: " + missing_.substr(0, missing_.size() - 2) + " (docs/reference/gpio.md)";
    }
    return out;
}

std::string GpioTarget::holds() const {
    return port_.hold().what + words_of(port_.hold().cause).in_a_run;
}

std::string GpioTarget::halted(bool quick) const {
    const GpioCause cause = port_.hold().cause;
    const std::string what = port_.steps().failure().what;
    const bool asked = quick || cause == GpioCause::asked_twice;
    if (!asked && !what.empty()) {
        return (cause == GpioCause::none ? "" : holds() + "; ") + what + ": stopped on the path by the port";
    }
    return holds() + (asked || cause == GpioCause::drive_fault
                          ? ""
                          : " (by the port: the plan did not bring the way to standstill in time)");
}

// For the summary.
void GpioTarget::note(const hal::gpio::InputChange& change, const std::optional<PerAxis<double>>& mm) {
    const hal::gpio::MappedInput& input = map_->inputs[change.input];
    GpioSummary::Change entry{
        .role = role_name(input.role),
        .axis = input.axis >= 0 ? machine_->axis_name[static_cast<unsigned>(input.axis)] : std::string(),
        .active = change.active,
        .time_s = static_cast<double>(static_cast<std::int64_t>(change.time_ns - port_.began_ns())) / ns_per_s,
        .position_mm = std::nullopt};
    if (mm) {
        entry.position_mm.emplace(mm->begin(), mm->begin() + machine_->settings.axes);
    }
    input_summary_.add(std::move(entry));
}

// By the steps that were made from a reference on.
std::optional<double> GpioTarget::place(int axis) const {
    return port_.places().origin(axis) == Origin::known ? std::optional(port_.places().position(axis)) : std::nullopt;
}

// Nothing on step lines knows it but the steps that were made; behind homing they are moved.
std::vector<RunTarget::AxisPlace> GpioTarget::standing() {
    std::vector<AxisPlace> out;
    for (int k = 0; !port_.orders().home && k < machine_->settings.axes; ++k) {
        out.push_back({static_cast<unsigned>(k), port_.position_known() ? place(k) : std::nullopt});
    }
    return out;
}

// The last steps are the place, known or not. An axis that is asked to stop is there once it stands.
std::vector<RunTarget::AxisPlace> GpioTarget::places() const {
    std::vector<AxisPlace> out;
    const bool stands = port_.hold().cause == GpioCause::none || port_.steps().at_standstill();
    for (int k = 0; port_.began() && k < machine_->settings.axes; ++k) {
        const Origin origin = port_.places().origin(k);
        out.push_back({.axis = static_cast<unsigned>(k),
                       .mm = origin != Origin::none ? std::optional(port_.places().position(k)) : std::nullopt,
                       .online = stands && port_.position_known() && origin == Origin::known});
    }
    return out;
}

std::string GpioTarget::where() const {
    if (!port_.began()) {
        return "; nothing was moved";
    }
    constexpr const char* unknown = "where the machine stands is not known (find the references again); the last steps "
                                    "were those to";
    PlaceText text(port_.position_known()      ? std::string("; the machine stands at")
                   : port_.steps().may_be_on() ? std::string("; drives may still be on, and ") + unknown
                                               : std::string("; drives are off, and ") + unknown);
    for (int k = 0; k < machine_->settings.axes; ++k) {
        text.add(machine_->axis_name[static_cast<unsigned>(k)], place(k));
    }
    return text.text();
}

SwitchFacts GpioTarget::switch_facts() const {
    SwitchFacts out;
    for (const hal::gpio::MappedInput& input : map_->inputs) {
        out.probe = out.probe || input.role == InputRole::probe;
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

RunTarget::Signs GpioTarget::signs() {
    constexpr std::uint64_t on_its_way_us = 8'000; // from the plan to the port, by two threads
    const hal::gpio::GpioHold stop = port_.stopped_by();
    port_.take_changes();
    const CauseWords& words = words_of(stop.cause);
    Signs out{.holds = holds(),
              .achieved = port_.hold().cause == GpioCause::touched,
              .stop = {words.stop, stop.what + words.when_served},
              .switches = {.touched_mm = port_.touched_mm()},
              .least_ahead_us = port_.steps().reserve_us() + on_its_way_us};
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const hal::gpio::MappedInput& input = map_->inputs[i];
        if (port_.inputs().active(i)) {
            out.switches.limits |= input.role == InputRole::limit ? 1U << static_cast<unsigned>(input.axis) : 0U;
            out.switches.probe = out.switches.probe || input.role == InputRole::probe;
            out.switches.e_stop = out.switches.e_stop || input.role == InputRole::e_stop;
        }
    }
    return out;
}

void GpioTarget::describe(Summary& summary) const {
    const hal::TimeHistogram& late = port_.steps().late();
    const hal::gpio::StepPortReport report = port_.steps().report();
    summary.gpio = GpioSummary{.edges = report.edges,
                               .median_late_s = late.below_us(0.5) / us_per_s,
                               .p99_late_s = late.below_us(0.99) / us_per_s,
                               .most_late_s = static_cast<double>(late.most_ns()) / ns_per_s,
                               .late = octaves(late),
                               .schedule_slip_s = static_cast<double>(report.schedule_slip_ns) / ns_per_s,
                               .buffer_underruns = report.buffer_underruns,
                               .began_monotonic_s = static_cast<double>(port_.began_ns()) / ns_per_s,
                               .missed = port_.inputs().missed(),
                               .changes = input_summary_.changes,
                               .changes_left_out = input_summary_.changes_left_out};
}

} // namespace splinefeed::host
