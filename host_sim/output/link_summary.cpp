// SPDX-License-Identifier: MIT
#include "host_sim/output/link_summary.hpp"

#include "host_sim/output/written_key.hpp"

#include <array>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

using hal::modbus::LinkCounts;

/// What may go wrong on a wire: the key in JSON and the words for people.
struct Loss {
    const char* key;
    const char* text;
    std::uint64_t LinkCounts::*count;
};
constexpr std::array<Loss, 7> losses{{{"timeouts", "without an answer in time", &LinkCounts::timeouts},
                                      {"disconnects", "broken connections", &LinkCounts::disconnects},
                                      {"corrupt", "corrupt", &LinkCounts::corrupt},
                                      {"stale", "answers to an earlier request", &LinkCounts::stale},
                                      {"misfits", "answers of another unit or length", &LinkCounts::misfits},
                                      {"exceptions", "exceptions", &LinkCounts::exceptions},
                                      {"resent", "blocks sent again", &LinkCounts::resent}}};

Json drive_of(const LinkSummary::Drive& drive, bool targets) {
    Json object{{"address", drive.address},
                {"exchanges", drive.counts.exchanges},
                {targets ? "targets" : "segments", drive.counts.segments}};
    for (const Loss& loss : losses) {
        object[loss.key] = drive.counts.*loss.count;
    }
    return object;
}

Json drive_schema() {
    Json properties{{"address", schema_of(text_key("address", "Of the drive."))}};
    Json required{"address", "exchanges"};
    const auto add = [&properties](const char* key, std::string_view sentence) {
        properties[key] = schema_of(count_row(key, sentence));
    };
    add("exchanges", "Requests with their answers.");
    add("segments", "Segments that it got.");
    add("targets", "Of a drive that does not interpolate: targets that it got.");
    for (const Loss& loss : losses) {
        add(loss.key, fmt::format("How often: {}.", loss.text));
        required.push_back(loss.key);
    }
    return object_schema(std::move(properties), std::move(required));
}

using Links = LinkSummary;
bool has_targets(const Links& link) {
    return link.target_period_us > 0;
}
Json drives_of(const Links& link) {
    Json drives = Json::array();
    for (const Links::Drive& drive : link.drives) {
        drives.push_back(drive_of(drive, has_targets(link)));
    }
    return drives;
}
Json drives_schema() {
    return list_schema(drive_schema());
}
double period_of(const Links& link) {
    return link.target_period_us * 1e-6;
}
std::optional<double> between_of(const Links& link) {
    return has_targets(link) ? std::optional(link.between_targets_mm) : std::nullopt;
}
std::optional<double> latest_of(const Links& link) {
    return has_targets(link) ? std::optional(static_cast<double>(link.late_us) * 1e-6) : std::nullopt;
}
constexpr WrittenKey<Links> summary_link_keys[] = {
    composed<drives_of, drives_schema>("drives", "Each drive."),
    count<&Links::resumes>("resumes", "How often all drives stopped together and went on."),
    quantity<&Links::clocks_s>("clocks_known_to_s", "s", "Largest difference of the start times of two drives."),
    quantity<&Links::bus_s>("bus_time_s", "s", "Processor time of the buses."),
    if_any(quantity<period_of>("target_period_s", "s", "Between two targets.")),
    if_any(quantity<between_of>("between_targets_mm", "mm", "Largest path error between two targets.")),
    if_any(quantity<latest_of>("latest_target_s", "s", "How late the latest target came.")),
};

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

Json to_json(const LinkSummary& link) {
    return written(link, summary_link_keys);
}

Json link_schema() {
    return written_schema(summary_link_keys);
}

std::string to_text(const LinkSummary& link) {
    std::string text;
    for (const LinkSummary::Drive& drive : link.drives) {
        text += fmt::format("{}: {} {} in {} exchanges", drive.address, drive.counts.segments,
                            link.target_period_us > 0 ? "targets" : "segments", drive.counts.exchanges);
        for (const Loss& loss : losses) {
            if (drive.counts.*loss.count > 0) {
                text += fmt::format(", {} {}", drive.counts.*loss.count, loss.text);
            }
        }
        text += '\n';
    }
    if (link.target_period_us > 0) {
        text += fmt::format(
            "A target every {:.2f} ms: between two of them at most {:.1f} um off the path; the worst came "
            "{:.1f} ms late.\n",
            link.target_period_us * 1e-3, link.between_targets_mm * 1e3, static_cast<double>(link.late_us) * 1e-3);
    }
    if (link.target_period_us == 0 && link.drives.size() > 1) {
        text += fmt::format("The drives' clocks were known to {:.0f} us from each other when they were started.\n",
                            link.clocks_s * 1e6);
    }
    if (link.resumes > 0) {
        text +=
            fmt::format("All drives stopped together {} time{}, on the path, and went on: look at the links above.\n",
                        link.resumes, link.resumes == 1 ? "" : "s");
    }
    return text;
}

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
