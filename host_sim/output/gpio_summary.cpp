// SPDX-License-Identifier: MIT
#include "host_sim/output/gpio_summary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

Json to_json(const GpioSummary& gpio) {
    Json changes = Json::array();
    for (const GpioSummary::Change& change : gpio.changes) {
        Json object{{"role", change.role}};
        if (!change.axis.empty()) {
            object["axis"] = change.axis;
        }
        object["active"] = change.active;
        object["time_s"] = change.time_s;
        object["position_mm"] = change.position_mm ? Json(*change.position_mm) : nullptr;
        changes.push_back(std::move(object));
    }
    Json late = Json::array();
    for (const GpioSummary::Octave& octave : gpio.late) {
        late.push_back({{"below_s", octave.below_s}, {"edges", octave.edges}});
    }
    return {{"edges", gpio.edges},
            {"median_late_s", gpio.median_late_s},
            {"p99_late_s", gpio.p99_late_s},
            {"most_late_s", gpio.most_late_s},
            {"late", std::move(late)},
            {"schedule_slip_s", gpio.schedule_slip_s},
            {"buffer_underruns", gpio.buffer_underruns},
            {"began_monotonic_s", gpio.began_monotonic_s},
            {"missed", gpio.missed},
            {"changes_left_out", gpio.changes_left_out},
            {"changes", std::move(changes)}};
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
