// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_faults.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using EventKind = DriveFaults::EventKind;

constexpr double longest_s = 1e6;
constexpr double longest_ms = 1e6;

enum class Shape { probability, delay, skew, seed, event, event_with_duration };

struct Fault {
    std::string_view name;
    Shape shape = Shape::probability;
    double DriveFaults::*probability = nullptr;
    EventKind event = EventKind::freeze;
};

constexpr std::array<Fault, 12> faults{{{"drop", Shape::probability, &DriveFaults::drop},
                                        {"corrupt", Shape::probability, &DriveFaults::corrupt},
                                        {"exception", Shape::probability, &DriveFaults::exception},
                                        {"duplicate", Shape::probability, &DriveFaults::duplicate},
                                        {"stale", Shape::probability, &DriveFaults::stale},
                                        {"delay", Shape::delay},
                                        {"clock-skew", Shape::skew},
                                        {"seed", Shape::seed},
                                        {"disconnect", Shape::event_with_duration, nullptr, EventKind::disconnect},
                                        {"freeze", Shape::event_with_duration, nullptr, EventKind::freeze},
                                        {"power-cycle", Shape::event, nullptr, EventKind::power_cycle},
                                        {"swap-words", Shape::event, nullptr, EventKind::swap_words}}};

constexpr std::array<std::string_view, faults.size()> names = [] {
    std::array<std::string_view, faults.size()> out{};
    for (std::size_t i = 0; i < faults.size(); ++i) {
        out[i] = faults[i].name;
    }
    return out;
}();

std::string example(const Fault& fault) {
    switch (fault.shape) {
    case Shape::probability: return fmt::format("{}=0.01", fault.name);
    case Shape::delay: return "delay=50:0.1 (50 ms, one exchange in ten)";
    case Shape::skew: return "clock-skew=100 (ppm)";
    case Shape::seed: return "seed=1";
    case Shape::event: return fmt::format("{}@2.5 (seconds)", fault.name);
    case Shape::event_with_duration: break;
    }
    return fmt::format("{}@2.5:300 (at 2.5 s, for 300 ms)", fault.name);
}

[[noreturn]] void refuse(std::string_view item, const Fault& fault, std::string_view why) {
    throw UsageError(fmt::format("--faults {}: {}; write it like {}", in_quotes(item), why, example(fault)));
}

double number(std::string_view item, const Fault& fault, std::string_view text, double low, double high) {
    double value = 0.0;
    if (read_number(text, value) != NumberText::number) {
        refuse(item, fault, fmt::format("{} is not a number", in_quotes(text)));
    }
    if (value < low || value > high) {
        refuse(item, fault, fmt::format("{} does not lie between {} and {}", in_quotes(text), low, high));
    }
    return value;
}

void take_item(std::string_view item, DriveFaults& out) {
    const std::size_t cut = item.find_first_of("=@");
    const std::string_view name = item.substr(0, cut);
    const auto* const found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        throw UsageError(
            fmt::format("--faults {}: there is no such fault{}", in_quotes(item), suggestion(name, names)));
    }
    const Fault& fault = faults[static_cast<std::size_t>(found - names.begin())];
    const bool event = fault.shape == Shape::event || fault.shape == Shape::event_with_duration;
    const char sign = event ? '@' : '=';
    if (cut == std::string_view::npos || item[cut] != sign) {
        refuse(item, fault, fmt::format("behind the name there must be {}", sign));
    }
    const std::string_view value = item.substr(cut + 1);
    const std::size_t colon = value.find(':');
    const bool two = fault.shape == Shape::delay || fault.shape == Shape::event_with_duration;
    if (two != (colon != std::string_view::npos)) {
        refuse(item, fault, two ? "it takes two numbers" : "it takes one number");
    }
    const std::string_view first = value.substr(0, colon);
    const std::string_view second = two ? value.substr(colon + 1) : std::string_view{};
    switch (fault.shape) {
    case Shape::probability: out.*fault.probability = number(item, fault, value, 0.0, 1.0); break;
    case Shape::delay:
        out.delays.push_back({number(item, fault, first, 0.0, longest_ms), number(item, fault, second, 0.0, 1.0)});
        break;
    case Shape::skew: out.clock_skew_ppm = number(item, fault, value, -1e5, 1e5); break;
    case Shape::seed: {
        const auto seed = read_whole<std::uint64_t>(value, 0, UINT64_MAX);
        if (!seed) {
            refuse(item, fault, "it must be a whole number from 0 on");
        }
        out.seed = *seed;
        break;
    }
    case Shape::event:
    case Shape::event_with_duration:
        out.events.push_back({fault.event, number(item, fault, first, 0.0, longest_s),
                              two ? number(item, fault, second, 0.0, longest_ms) : 0.0});
        break;
    }
}

} // namespace

bool DriveFaults::random() const noexcept {
    return drop > 0.0 || corrupt > 0.0 || exception > 0.0 || duplicate > 0.0 || stale > 0.0 || !delays.empty();
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
    std::stable_sort(out.events.begin(), out.events.end(),
                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
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
    for (const DriveFaults::Delay& delay : faults_.delays) {
        out.delay_ms += happens(delay.probability) ? delay.duration_ms : 0.0;
    }
    out.bits = random_();
    return out;
}

} // namespace splinefeed::host
