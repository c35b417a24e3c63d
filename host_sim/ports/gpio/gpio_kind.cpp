// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_address.hpp"
#include "host_sim/config/gpio_map.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/gpio/gpio_chips.hpp"
#include "host_sim/ports/gpio/gpio_settings.hpp"
#include "host_sim/ports/gpio/gpio_target.hpp"
#include "host_sim/ports/gpio/gpio_words.hpp"
#include "host_sim/ports/histogram_picture.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/ports/target_table.hpp"
#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <string>
#include <thread>

namespace splinefeed::host {

namespace {

constexpr int calls = 5000;

std::string lines_text(const hal::gpio::PinMap& map) {
    std::string text;
    for (const hal::gpio::ChipPins& chip : map.chips) {
        text += fmt::format("{}: {} outputs, {} inputs, as \"{}\"\n", chip.chip, chip.outputs.size(),
                            chip.inputs.size(), map.consumer);
    }
    return text;
}

std::string inputs_text(const hal::gpio::PinMap& map, GpioChips& chips) {
    std::string text;
    for (const GpioChips::Inputs& inputs : chips.inputs()) {
        const std::optional<std::uint64_t> levels = inputs.source->levels();
        for (const std::size_t i : inputs.input) {
            const hal::gpio::MappedInput& input = map.inputs[i];
            const bool high = levels && (*levels >> input.line.bit & 1U) != 0;
            text += fmt::format("  {}, {}: {}\n", role_name(input.role), chips.name(input.line),
                                !levels                      ? "cannot be read"
                                : high == input.active_level ? (high ? "high, it acts" : "low, it acts")
                                                             : (high ? "high" : "low"));
        }
    }
    return text;
}

/// How late a thread of the map's settings is woken, a thousand times a second.
void wake_ups(const hal::RealTimeSettings& settings, double seconds, hal::TimeHistogram& late, std::string& missing) {
    std::thread([&] {
        missing = claim_real_time(settings);
        constexpr std::uint64_t period_ns = 1'000'000;
        const std::uint64_t begin = hal::system_clock().now_ns();
        const auto rounds = static_cast<std::uint64_t>(seconds * 1e3);
        for (std::uint64_t i = 1; i <= rounds; ++i) {
            const std::uint64_t due = begin + i * period_ns;
            const std::uint64_t woken = hal::wait_until_ns(due, settings.spin_ns);
            late.add(woken > due ? woken - due : 0);
        }
    }).join();
}

/// Requests the lines, with the drives off, measures for the given time, and reports what that means for the machine.
/// Throws InputError and TargetError.
LinkReport gpio_report(const std::string& target, const MachineDescription& machine, bool /*any_machine*/,
                       double seconds) {
    const GpioAddress address = parse_gpio_address(target);
    const hal::gpio::PinMap map = read_gpio_map(address.map, machine, address.chip);
    const hal::gpio::StepPortSettings settings = port_settings(machine, map);
    std::string text = lines_text(map);
    const hal::AwakeHost awake;
    std::string missing;
    std::vector<std::uint64_t> times;
    try {
        GpioChips chips(map, machine);
        text += inputs_text(map, chips);
        times = chips.set_times_ns(calls);
    } catch (const hal::gpio::GpioError& error) {
        throw TargetError(error.what());
    }
    hal::TimeHistogram late;
    wake_ups(settings.real_time, seconds, late, missing);
    std::ranges::sort(times);
    const double mean_ns = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
    const auto at = [&](double share) {
        return static_cast<double>(times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))]) /
               static_cast<double>(ns_per_us);
    };
    text += fmt::format("a call that sets all lines: half below {:.1f} us, 99 % below {:.1f} us, worst {:.1f} us\n",
                        at(median_share), at(nearly_all), at(1.0));
    text += fmt::format("wake-ups, 1000 a second, {} us of each wait spent spinning: half below {:.0f} us late, 99 % "
                        "below {:.0f} us, worst {} us\n{}",
                        settings.real_time.spin_ns / ns_per_us, late.below_us(median_share), late.below_us(nearly_all),
                        late.most_ns() / ns_per_us, histogram_picture(late));
    text += "what that means:\n";
    missing = awake.missing() + missing;
    if (!missing.empty()) {
        text += fmt::format("  not in real time: {}\n", missing.substr(0, missing.size() - 2));
    }
    const double steps = most_edges_per_s(mean_ns) / (machine.step.step_on_edge ? 1.0 : 2.0);
    text += fmt::format("  at most {:.0f} steps/s, all axes together: half of the time is for setting lines\n", steps);
    const double asked = asked_edges_per_s(machine) / (machine.step.step_on_edge ? 1.0 : 2.0);
    text += asked <= steps ? fmt::format("  the machine's limits may ask for {:.0f} steps/s: that goes\n", asked)
                           : fmt::format("  the machine's limits may ask for {:.0f} steps/s: refused; lower its "
                                         "velocities, max_feed_mm_s or steps_per_mm\n",
                                         asked);
    text +=
        fmt::format("  an edge that comes more than {} us late stretches the motion by as much (tolerated_late_us)\n",
                    map.thread.tolerated_late_us);
    return {text, {}};
}

std::unique_ptr<RunTarget> make_gpio(const std::string& target, const MachineDescription& machine,
                                     const RunOptions& options) {
    return make_gpio_target(parse_gpio_address(target), machine, options);
}

} // namespace

extern const TargetKind gpio_kind{
    .names = gpio_names,
    .help = gpio_help,
    .is = is_gpio_address,
    .check = [](const std::string& target) { static_cast<void>(parse_gpio_address(target)); },
    .make = make_gpio,
    .report = gpio_report,
};

} // namespace splinefeed::host
