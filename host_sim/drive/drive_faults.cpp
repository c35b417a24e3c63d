// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_faults.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using Kind = DriveFaults::EventKind;
using Spells = std::vector<DriveFaults::Spell>;

constexpr double longest_s = 1e6;
constexpr double longest_ms = 1e6;
constexpr double most_requests = 1e9;

/// A number behind the name of a fault.
struct Range {
    double low = 0.0;
    double high = 0.0;
    bool whole = false;
};
constexpr Range share_range{0.0, 1.0};
constexpr Range ms_range{0.0, longest_ms};
constexpr Range s_range{0.0, longest_s};

/// How a fault is written.
struct Form {
    char sign = '=';
    std::string_view letters; ///< for the list of all
    std::string_view example; ///< behind the sign
    Range first;
    std::optional<Range> second{};
};
constexpr Form by_probability{'=', "P", "0.01", share_range};
constexpr Form by_spell{'=', "MS:P", "50:0.1 (50 ms, one exchange in ten)", ms_range, share_range};
constexpr Form by_request{
    '=', "N:MS", "3:150 (from the third request on, for 150 ms)", {1.0, most_requests, true}, ms_range};
constexpr Form by_counts{'=', "N", "3 (counts)", {0.0, 1e6, true}};
constexpr Form by_ppm{'=', "PPM", "100 (ppm)", {-1e5, 1e5}};
constexpr Form by_seed{'=', "N", "1", {}};
constexpr Form at_once{'@', "S", "2.5 (seconds)", s_range};
constexpr Form at_for{'@', "S:MS", "2.5:300 (at 2.5 s, for 300 ms)", s_range, ms_range};
constexpr Form at_state{'@', "S:N", "2.5:99 (at 2.5 s, the state)", s_range, Range{0.0, 65535.0, true}};

struct FaultWord {
    std::string_view name;
    const Form* form = nullptr;
    double DriveFaults::*value = nullptr;
    Spells DriveFaults::*spells = nullptr;
    Kind event = Kind::freeze;
};

constexpr std::array<FaultWord, 27> faults{{{"drop", &by_probability, &DriveFaults::drop},
                                            {"corrupt", &by_probability, &DriveFaults::corrupt},
                                            {"exception", &by_probability, &DriveFaults::exception},
                                            {"duplicate", &by_probability, &DriveFaults::duplicate},
                                            {"stale", &by_probability, &DriveFaults::stale},
                                            {"short", &by_probability, &DriveFaults::short_reply},
                                            {"foreign", &by_probability, &DriveFaults::foreign},
                                            {"echo", &by_probability, &DriveFaults::echo},
                                            {"delay", &by_spell, nullptr, &DriveFaults::delays},
                                            {"late", &by_spell, nullptr, &DriveFaults::late},
                                            {"drip", &by_spell, nullptr, &DriveFaults::drips},
                                            {"mute", &by_spell, nullptr, &DriveFaults::mutes},
                                            {"mute-at", &by_request},
                                            {"dither", &by_counts, &DriveFaults::dither_counts},
                                            {"clock-skew", &by_ppm, &DriveFaults::clock_skew_ppm},
                                            {"seed", &by_seed},
                                            {"disconnect", &at_for, nullptr, nullptr, Kind::disconnect},
                                            {"freeze", &at_for, nullptr, nullptr, Kind::freeze},
                                            {"flood", &at_for, nullptr, nullptr, Kind::flood},
                                            {"refuse-stop", &at_for, nullptr, nullptr, Kind::refuse_stop},
                                            {"stuck-state", &at_for, nullptr, nullptr, Kind::stuck_state},
                                            {"stuck-place", &at_for, nullptr, nullptr, Kind::stuck_place},
                                            {"no-room", &at_for, nullptr, nullptr, Kind::no_room},
                                            {"state", &at_state, nullptr, nullptr, Kind::told_state},
                                            {"second-master", &at_once, nullptr, nullptr, Kind::second_master},
                                            {"power-cycle", &at_once, nullptr, nullptr, Kind::power_cycle},
                                            {"swap-words", &at_once, nullptr, nullptr, Kind::swap_words}}};

constexpr std::array<std::string_view, faults.size()> names = [] {
    std::array<std::string_view, faults.size()> out{};
    for (std::size_t i = 0; i < faults.size(); ++i) {
        out[i] = faults[i].name;
    }
    return out;
}();

[[noreturn]] void refuse(std::string_view item, const FaultWord& fault, std::string_view why) {
    throw UsageError("--faults {}: {}; write it like {}{}{}", in_quotes(item), why, fault.name, fault.form->sign,
                     fault.form->example);
}

double number(std::string_view item, const FaultWord& fault, std::string_view text, const Range& range) {
    double value = 0.0;
    if (read_number(text, value) != NumberText::number) {
        refuse(item, fault, fmt::format("{} is not a number", in_quotes(text)));
    }
    if (range.whole && value != std::floor(value)) {
        refuse(item, fault, fmt::format("{} is not a whole number", in_quotes(text)));
    }
    if (value < range.low || value > range.high) {
        refuse(item, fault, fmt::format("{} does not lie between {} and {}", in_quotes(text), range.low, range.high));
    }
    return value;
}

void take_seed(std::string_view item, const FaultWord& fault, std::string_view text, DriveFaults& out) {
    out.seed = read_whole<std::uint64_t>(text, 0, UINT64_MAX);
    if (!out.seed) {
        refuse(item, fault, "it must be a whole number from 0 on");
    }
}

void take_item(std::string_view item, DriveFaults& out) {
    const std::size_t cut = item.find_first_of("=@");
    const std::string_view name = item.substr(0, cut);
    const auto* const found = std::ranges::find(names, name);
    if (found == names.end()) {
        throw UsageError("--faults {}: there is no such fault{}", in_quotes(item), suggestion(name, names));
    }
    const FaultWord& fault = faults[static_cast<std::size_t>(found - names.begin())];
    const Form& form = *fault.form;
    if (cut == std::string_view::npos || item[cut] != form.sign) {
        refuse(item, fault, fmt::format("behind the name there must be {}", form.sign));
    }
    const std::string_view text = item.substr(cut + 1);
    const std::size_t colon = text.find(':');
    if (form.second.has_value() != (colon != std::string_view::npos)) {
        refuse(item, fault, form.second ? "it takes two numbers" : "it takes one number");
    }
    if (fault.form == &by_seed) {
        take_seed(item, fault, text, out);
        return;
    }
    const double first = number(item, fault, text.substr(0, colon), form.first);
    const double second = form.second ? number(item, fault, text.substr(colon + 1), *form.second) : 0.0;
    if (fault.value != nullptr) {
        out.*fault.value = first;
    } else if (fault.spells != nullptr) {
        (out.*fault.spells).push_back({first, second});
    } else if (fault.form == &by_request) {
        out.silences.push_back({first, second});
    } else {
        out.events.push_back({fault.event, first, second});
    }
}

} // namespace

bool DriveFaults::random() const noexcept {
    return std::ranges::any_of(faults, [this](const FaultWord& fault) {
        return (fault.form == &by_probability && this->*fault.value > 0.0) ||
               (fault.spells != nullptr && !(this->*fault.spells).empty());
    });
}

bool DriveFaults::lasts(EventKind kind, double time_s) const noexcept {
    constexpr double ms_per_s = 1000.0;
    return std::ranges::any_of(events, [&](const Event& event) {
        return event.kind == kind && event.time_s <= time_s && time_s < event.time_s + event.amount / ms_per_s;
    });
}

ModelFaults DriveFaults::of_model(double time_s) const noexcept {
    ModelFaults out{.refuses_stops = lasts(EventKind::refuse_stop, time_s),
                    .stuck_state = lasts(EventKind::stuck_state, time_s),
                    .stuck_place = lasts(EventKind::stuck_place, time_s),
                    .no_room = lasts(EventKind::no_room, time_s),
                    .dither_counts = static_cast<int>(dither_counts)};
    for (const Event& event : events) {
        if (event.kind == EventKind::told_state && event.time_s <= time_s) {
            out.state = static_cast<std::uint16_t>(event.amount);
        }
    }
    return out;
}

DriveFaults parse_drive_faults(std::string_view text) {
    DriveFaults out;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        take_item(text.substr(0, comma), out);
        if (comma != std::string_view::npos && comma + 1 == text.size()) {
            throw UsageError("--faults ends with a comma; a fault must follow, or leave it out");
        }
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    std::ranges::stable_sort(out.events, [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
    return out;
}

std::string list_drive_faults() {
    std::string out;
    for (const FaultWord& fault : faults) {
        out += fmt::format("{}{}{}{}", out.empty() ? "" : ", ", fault.name, fault.form->sign, fault.form->letters);
    }
    return out;
}

double FaultDice::sum_ms(const Spells& spells, bool up_to) {
    double out = 0.0;
    for (const DriveFaults::Spell& spell : spells) {
        const bool happens = uniform() < spell.probability;
        const double share = up_to ? uniform() : 1.0;
        out += happens ? share * spell.duration_ms : 0.0;
    }
    return out;
}

ExchangeFaults FaultDice::next() {
    // Every exchange draws equally often, whatever came of it: a seed tells the same story with fewer faults.
    ExchangeFaults out;
    const auto happens = [this](double probability) {
        return uniform() < probability;
    };
    const bool dropped = happens(faults_.drop);
    out.drop_request = dropped && happens(0.5);
    out.drop_reply = dropped && !out.drop_request;
    if (!dropped) {
        static_cast<void>(uniform());
    }
    out.corrupt = happens(faults_.corrupt);
    out.exception = happens(faults_.exception);
    const bool doubled = happens(faults_.duplicate);
    const bool request = happens(0.5);
    out.repeat_request = doubled && request;
    out.repeat_reply = doubled && !request;
    out.stale = happens(faults_.stale);
    out.short_reply = happens(faults_.short_reply);
    out.foreign = happens(faults_.foreign);
    out.echo = happens(faults_.echo);
    out.delay_ms = sum_ms(faults_.delays, false) + sum_ms(faults_.late, true);
    out.drip_ms = sum_ms(faults_.drips, false);
    out.mute_ms = sum_ms(faults_.mutes, false);
    requests_ += 1.0;
    for (const DriveFaults::Silence& silence : faults_.silences) {
        out.mute_ms = silence.request == requests_ ? silence.duration_ms : out.mute_ms;
    }
    out.bits = random_();
    return out;
}

} // namespace splinefeed::host
