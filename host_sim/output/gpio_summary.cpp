// SPDX-License-Identifier: MIT
#include "host_sim/output/gpio_summary.hpp"

#include "host_sim/output/written_key.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

template <class Of, class Each, std::size_t n>
Json list_of(const Of& all, const WrittenKey<Each> (&keys)[n]) {
    Json list = Json::array();
    for (const Each& each : all) {
        list.push_back(written(each, keys));
    }
    return list;
}

using Change = GpioSummary::Change;
constexpr WrittenKey<Change> change_keys[] = {
    {text_row("role", "As in the map file."),
     [](const Change& change) {
         return Json(change.role);
     }},
    {not_always(text_row("axis", "Of limit and home.")),
     [](const Change& change) {
         return change.axis.empty() ? left_out() : Json(change.axis);
     }},
    {flag_row("active", "Whether it acts now."),
     [](const Change& change) {
         return Json(change.active);
     }},
    {number_row("time_s", "s", "Since the run began."),
     [](const Change& change) {
         return Json(change.time_s);
     }},
    {nullable(needed(form_key("position_mm", R"({"type": "array", "items": {"type": "number"}})",
                              "[mm] Of each axis at that time; null: not known."))),
     [](const Change& change) {
         return or_null(change.position_mm);
     }},
};

using Octave = GpioSummary::Octave;
constexpr WrittenKey<Octave> octave_keys[] = {
    {number_row("below_s", "s", "They came later than the octave before, and not later than this."),
     [](const Octave& octave) {
         return Json(octave.below_s);
     }},
    {count_row("edges", "How many."),
     [](const Octave& octave) {
         return Json(octave.edges);
     }},
};

constexpr WrittenKey<GpioSummary> gpio_keys[] = {
    {count_row("edges", "Instants at which lines changed."),
     [](const GpioSummary& g) {
         return Json(g.edges);
     }},
    {number_row("median_late_s", "s", "Half of the edges came sooner."),
     [](const GpioSummary& g) {
         return Json(g.median_late_s);
     }},
    {number_row("p99_late_s", "s", "99 % of the edges came sooner."),
     [](const GpioSummary& g) {
         return Json(g.p99_late_s);
     }},
    {number_row("most_late_s", "s", "The latest edge."),
     [](const GpioSummary& g) {
         return Json(g.most_late_s);
     }},
    {inside_row("late", "A histogram by octaves."), [](const GpioSummary& g) { return list_of(g.late, octave_keys); },
     [] {
         return list_schema(written_schema(octave_keys));
     }},
    {number_row("schedule_slip_s", "s", "The motion took longer than planned, because edges came too late."),
     [](const GpioSummary& g) {
         return Json(g.schedule_slip_s);
     }},
    {count_row("buffer_underruns", "The plan was not ready in time: all axes slowed down."),
     [](const GpioSummary& g) {
         return Json(g.buffer_underruns);
     }},
    {number_row("began_monotonic_s", "s", "Time of the start, by CLOCK_MONOTONIC."),
     [](const GpioSummary& g) {
         return Json(g.began_monotonic_s);
     }},
    {count_row("missed", "Edges of inputs that the system lost."),
     [](const GpioSummary& g) {
         return Json(g.missed);
     }},
    {count_row("changes_left_out", "Older changes."),
     [](const GpioSummary& g) {
         return Json(g.changes_left_out);
     }},
    {inside_row("changes", "The last changes of inputs."),
     [](const GpioSummary& g) { return list_of(g.changes, change_keys); },
     [] {
         return list_schema(written_schema(change_keys));
     }},
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
