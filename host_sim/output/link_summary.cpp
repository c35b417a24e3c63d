// SPDX-License-Identifier: MIT
#include "host_sim/output/link_summary.hpp"

#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
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

} // namespace

Json to_json(const LinkSummary& link) {
    Json drives = Json::array();
    const bool targets = link.target_period_us > 0;
    for (const LinkSummary::Drive& drive : link.drives) {
        Json object{{"address", drive.address},
                    {"exchanges", drive.counts.exchanges},
                    {targets ? "targets" : "segments", drive.counts.segments}};
        for (const Loss& loss : losses) {
            object[loss.key] = drive.counts.*loss.count;
        }
        drives.push_back(std::move(object));
    }
    Json object{{"drives", std::move(drives)},
                {"resumes", link.resumes},
                {"clocks_known_to_s", link.clocks_s},
                {"bus_time_s", link.bus_s}};
    if (targets) {
        object["target_period_s"] = link.target_period_us * 1e-6;
        object["between_targets_mm"] = link.between_targets_mm;
        object["latest_target_s"] = static_cast<double>(link.late_us) * 1e-6;
    }
    return object;
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

} // namespace splinefeed::host
