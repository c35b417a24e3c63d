// SPDX-License-Identifier: MIT
// The JSON of a summary, and its schema: both are made of the rows below.
#include "host_sim/output/summary.hpp"
#include "host_sim/output/written_key.hpp"

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

/// Values of axes below their names; those that have none are left out.
template <class Value>
Json by_axis(const Summary& summary, Value value) {
    Json object = Json::object();
    for (std::size_t k = 0; k < summary.limit_use.size(); ++k) {
        if (const std::optional<double> number = value(k)) {
            object[summary.limit_use[k].axis] = *number;
        }
    }
    return object;
}

using Sum = Summary;

template <auto member>
Json use_of(const Sum& s) {
    return by_axis(s, [&](std::size_t k) { return std::optional<double>(s.limit_use[k].*member); });
}
constexpr WrittenKey<Sum> use_keys[] = {
    axes<use_of<&Sum::AxisUse::velocity>>("velocity", "1 is the limit."),
    axes<use_of<&Sum::AxisUse::acceleration>>("acceleration", "1 is the limit."),
    axes<use_of<&Sum::AxisUse::jerk>>("jerk", "Of axes with a jerk limit."),
};

template <auto member>
Json share_of(const Sum& s) {
    return by_axis(s, [&](std::size_t k) { return std::optional<double>(s.limit_share->axis[k].*member); });
}
template <auto member>
double path_share(const Sum& s) {
    return std::optional<double>((*s.limit_share).*member).value_or(0.0);
}
constexpr WrittenKey<Sum> share_keys[] = {
    axes<share_of<&LimitShares::Axis::velocity>>("velocity", "Of each axis."),
    axes<share_of<&LimitShares::Axis::acceleration>>("acceleration", "Of each axis."),
    axes<share_of<&LimitShares::Axis::jerk>>("jerk", "Of axes with a jerk limit."),
    quantity<path_share<&LimitShares::feed>>("feed", "", "The feed of the waypoint, else the machine's."),
    quantity<path_share<&LimitShares::programmed_feed>>("programmed_feed", "", "Of that the program's, as it is."),
    quantity<path_share<&LimitShares::override_feed>>("override", "", "Of that the feed that an override changed."),
    quantity<path_share<&LimitShares::centripetal>>("centripetal", "", "The acceleration across the path."),
    quantity<path_share<&LimitShares::chord>>("chord", "", "The chord error."),
    quantity<path_share<&LimitShares::hold>>("hold", "", "The operator brakes the machine, or keeps it at rest."),
    quantity<path_share<&LimitShares::dwell>>("dwell", "", "The program keeps it at rest."),
    quantity<path_share<&LimitShares::none>>("none", "", "No limit."),
};

using Raised = RaisedLimit;
constexpr WrittenKey<Raised> help_keys[] = {
    text<&Raised::limit>("limit", "Its name."),
    or_null(text<&Raised::setting>("set", "That limit for --set; null: it is a feed of the program, or the window.")),
    if_any(count<&Raised::window>("window", "It is the planning window: that for --window.")),
    quantity<&Raised::cycle_time_s>("cycle_time_s", "s", "If it alone were 10 % higher, or the window so long."),
    quantity<&Raised::gain>("gain", "", "That part of the cycle time."),
};

using Place = ToleranceSummary::Place;
constexpr WrittenKey<Place> place_keys[] = {
    quantity<&Place::distance>("distance", "mm or degrees", "The largest one, both ways."),
    or_null(count<&Place::number>("at", "The element, waypoint or move, from 1; null where the distance is 0.")),
    or_null(count<&Place::line>("line", "Its line in the input; null where it is not known.")),
};

using Within = ToleranceSummary;
bool is_kept(const Within& t) {
    return t.excess.empty();
}
constexpr WrittenKey<Within> tolerance_keys[] = {
    flag<is_kept>("kept", "Whether each tolerance was."),
    object<&Within::deviation, place_keys>("deviation_mm", "Distance between the path and the program."),
    if_any(object<&Within::rotary_deviation, place_keys>("deviation_deg", "The same of rotary axes.")),
    count<&Within::blended>("blended", "Joints that are rounded."),
    count<&Within::stopped>("stopped", "Joints with a stop, with the end."),
    count<&Within::through>("through", "Joints that are passed straight on."),
    count<&Within::chains>("chains", "Chains of short lines."),
    count<&Within::elements>("elements", "All elements."),
    count<&Within::pieces>("pieces", "What they became."),
    quantity<&Within::exact_stop_s>("exact_stop_time_s", "s", "Estimate of the time with a stop at each element."),
};

using Bytes = Summary::MemoryBytes;
constexpr WrittenKey<Bytes> memory_keys[] = {
    count<&Bytes::curve>("curve", "Of the curve."),
    count<&Bytes::feed_plan>("feed_plan", "Of the feed plan."),
    count<&Bytes::stream>("stream", "Of the segment stream."),
};

const Sum& all_of(const Sum& s) {
    return s;
}
const Sum* shares_of(const Sum& s) {
    return s.limit_share ? &s : nullptr;
}
const std::vector<Raised>* helps_of(const Sum& s) {
    return s.what_would_help ? &s.what_would_help->limits : nullptr;
}
std::uint64_t moves_of(const Sum& s) {
    return s.what_would_help ? s.what_would_help->moves : 0;
}
/// Of a run that was steered.
template <auto member>
std::optional<std::uint64_t> events_of(const Sum& s) {
    return s.events + s.events_not_reached > 0 ? std::optional(s.*member) : std::nullopt;
}
/// Below the names of the axes that have it.
template <auto member>
std::optional<Json> places_of(const Sum& s) {
    Json object = Json::object();
    for (const Sum::AxisPlace& place : s.places) {
        if (const auto& value = place.*member) {
            if constexpr (requires { value->low; }) {
                object[place.axis] = {value->low, value->high};
            } else {
                object[place.axis] = *value;
            }
        }
    }
    return object.empty() ? std::nullopt : std::optional(std::move(object));
}
std::optional<Json> reserves_of(const Sum& s) {
    Json reserves = use_of<&Sum::AxisUse::jerk_reserved>(s);
    return reserves.empty() ? std::nullopt : std::optional(std::move(reserves));
}
constexpr WrittenKey<Sum> summary_keys[] = {
    quantity<&Sum::cycle_time_s>("cycle_time_s", "s", "Duration of the motion."),
    quantity<&Sum::length_mm>("length_mm", "mm", "Length of the path, along the linear axes."),
    count<&Sum::waypoints>("waypoints", "Points or moves of the input."),
    count<&Sum::curve_segments>("curve_segments", "Bezier segments."),
    count<&Sum::feed_segments>("feed_segments", "Segments of the output."),
    text<&Sum::scalar>("scalar", "Number type of the computation."),
    or_null(text<&Sum::jerk_scalar>("jerk_scalar", "Number type of the plan with a jerk limit; null: there is none.")),
    text<&Sum::curve>("curve", "The method."),
    quantity<&Sum::max_speed_mm_s>("max_speed_mm_s", "mm/s", "The largest one."),
    object<all_of, use_keys>("limit_use", "Largest use of each axis limit, measured on the emitted motion."),
    if_any(axes<reserves_of>("jerk_reserved", "The part of each jerk limit that the plan keeps for rounding.")),
    or_null(quantity<&Sum::waypoint_error_mm>("waypoint_error_mm", "mm",
                                              "Largest distance; null: the curve need not pass them.")),
    or_null(quantity<&Sum::optimum_time_s>("optimum_time_s", "s",
                                           "A lower bound of the cycle time; null: stopped or steered.")),
    quantity<&Sum::planning_time_s>("planning_time_s", "s",
                                    "From the start to the summary; on a real target how long it computed."),
    object<&Sum::memory_bytes, memory_keys>("memory_bytes", "Memory of the planner."),
    flag<&Sum::stopped>("stopped", "The run ended before its program."),
    count<&Sum::window_limited>("window_limited", "How often the planning window was too short."),
    or_null(count<&Sum::searched_legs>("searched_legs",
                                       "Searches for a plan with a jerk limit; null: the jerk is not limited.")),
    or_null(count<&Sum::slow_legs>("slow_legs", "Those that found none: the machine went on by the plan before.")),
    count<&Sum::stops>("stops", "Corners where the machine stops, without the ends."),
    quantity<&Sum::smoothing_bound_mm>("smoothing_bound_mm", "mm",
                                       "Largest distance of the emitted motion from the curve."),
    count<&Sum::peak_rss_bytes>("peak_rss_bytes", "Memory of the process; 0: not known."),
    or_null(object<shares_of, share_keys>("limit_share", "Share of the cycle time during which each limit binds.")),
    or_null(objects<helps_of, help_keys>("what_would_help",
                                         "Each limit that bound, planned again, the largest gain first.")),
    if_any(axes<places_of<&Sum::AxisPlace::zero_mm>>("zero_mm", "Of G-code: where its zero lies on the machine.")),
    if_any(formed<places_of<&Sum::AxisPlace::travel_mm>>(
        "travel_mm",
        R"({"type": "object", "additionalProperties": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}})",
        "Of axes whose travel is limited: the lowest and the highest position.")),
    if_any(count<moves_of>("what_would_help_moves", "The first moves, which stand for all.")),
    if_any(count<events_of<&Sum::events>>("events", "Of the operator.")),
    if_any(count<events_of<&Sum::events_not_reached>>("events_not_reached", "Events after the end of the run.")),
    if_any(object<&Sum::tolerance, tolerance_keys>("tolerance", "Of elements, G-code and lines within a tolerance.")),
    if_any(part<&Sum::program, program_schema>("program", "Of elements and G-code.")),
    if_any(part<&Sum::link, link_schema>("link", "Of a run on Modbus drives.")),
    if_any(part<&Sum::gpio, gpio_schema>("gpio", "Of a run on GPIO lines.")),
};

} // namespace

std::string to_json(const Summary& summary) {
    return written(summary, summary_keys).dump(2) + "\n";
}

nlohmann::ordered_json summary_schema() {
    return written_schema(summary_keys);
}

} // namespace splinefeed::host
