// SPDX-License-Identifier: MIT
#include "host_sim/output/gpio_summary.hpp"

#include "host_sim/output/written_key.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

using Change = GpioSummary::Change;
constexpr WrittenKey<Change> change_keys[] = {
    text<&Change::role>("role", "As in the map file."),
    if_any(text<&Change::axis>("axis", "Of limit and home.")),
    flag<&Change::active>("active", "Whether it acts now."),
    quantity<&Change::time_s>("time_s", "s", "Since the run began."),
    or_null(formed<&Change::position_mm>("position_mm", R"({"type": "array", "items": {"type": "number"}})",
                                         "[mm] Of each axis at that time; null: not known.")),
};

using Octave = GpioSummary::Octave;
constexpr WrittenKey<Octave> octave_keys[] = {
    quantity<&Octave::below_s>("below_s", "s", "They came later than the octave before, and not later than this."),
    count<&Octave::edges>("edges", "How many."),
};

using Gpio = GpioSummary;
constexpr WrittenKey<Gpio> gpio_keys[] = {
    count<&Gpio::edges>("edges", "Instants at which lines changed."),
    quantity<&Gpio::median_late_s>("median_late_s", "s", "Half of the edges came sooner."),
    quantity<&Gpio::p99_late_s>("p99_late_s", "s", "99 % of the edges came sooner."),
    quantity<&Gpio::most_late_s>("most_late_s", "s", "The latest edge."),
    objects<&Gpio::late, octave_keys>("late", "A histogram by octaves."),
    quantity<&Gpio::schedule_slip_s>("schedule_slip_s", "s",
                                     "The motion took longer than planned, because edges came too late."),
    count<&Gpio::buffer_underruns>("buffer_underruns", "The plan was not ready in time: all axes slowed down."),
    quantity<&Gpio::began_monotonic_s>("began_monotonic_s", "s", "Time of the start, by CLOCK_MONOTONIC."),
    count<&Gpio::missed>("missed", "Edges of inputs that the system lost."),
    count<&Gpio::changes_left_out>("changes_left_out", "Older changes."),
    objects<&Gpio::changes, change_keys>("changes", "The last changes of inputs."),
};

} // namespace

Json to_json(const GpioSummary& gpio) {
    return written(gpio, gpio_keys);
}

Json gpio_schema() {
    return written_schema(gpio_keys);
}

std::string to_text(const GpioSummary& gpio) {
    std::string text = fmt::format("{} edges; half of them within {:.0f} us of their instant, 99 % within {:.0f} us, "
                                   "the latest {:.0f} us late\n",
                                   gpio.edges, gpio.median_late_s * 1e6, gpio.p99_late_s * 1e6, gpio.most_late_s * 1e6);
    if (gpio.schedule_slip_s > 0.0) {
        text += fmt::format("The motion took {:.6f} s longer than planned, since edges came too late.\n",
                            gpio.schedule_slip_s);
    }
    if (gpio.buffer_underruns > 0) {
        text += fmt::format("All axes slowed down {} time{}, on the path: the plan was not ready.\n",
                            gpio.buffer_underruns, gpio.buffer_underruns == 1 ? "" : "s");
    }
    if (gpio.missed > 0) {
        text += fmt::format("{} edges of inputs were lost.\n", gpio.missed);
    }
    if (gpio.changes_left_out > 0) {
        text += fmt::format("{} older changes of inputs are left out.\n", gpio.changes_left_out);
    }
    for (const GpioSummary::Change& change : gpio.changes) {
        text += fmt::format("{:.6f} s: {}{}{} {}", change.time_s, change.role, change.axis.empty() ? "" : " of axis ",
                            change.axis, change.active ? "acts" : "acts no more");
        if (change.position_mm) {
            text += ", at";
            for (const double mm : *change.position_mm) {
                text += fmt::format(" {:.4f}", mm);
            }
            text += " mm";
        }
        text += '\n';
    }
    return text;
}

} // namespace splinefeed::host
