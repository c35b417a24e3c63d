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

constexpr WrittenKey<Summary> use_keys[] = {
    {axes_row("velocity", "1 is the limit."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return std::optional(s.limit_use[k].velocity); });
     }},
    {axes_row("acceleration", "1 is the limit."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return std::optional(s.limit_use[k].acceleration); });
     }},
    {axes_row("jerk", "Of axes with a jerk limit."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return s.limit_use[k].jerk; });
     }},
};

constexpr WrittenKey<Summary> share_keys[] = {
    {axes_row("velocity", "Of each axis."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return std::optional(s.limit_share->axis[k].velocity); });
     }},
    {axes_row("acceleration", "Of each axis."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return std::optional(s.limit_share->axis[k].acceleration); });
     }},
    {axes_row("jerk", "Of axes with a jerk limit."),
     [](const Summary& s) {
         return by_axis(s, [&](std::size_t k) { return s.limit_share->axis[k].jerk; });
     }},
    {number_row("feed", "", "The feed of the waypoint, else the machine's."),
     [](const Summary& s) {
         return Json(s.limit_share->feed);
     }},
    {number_row("centripetal", "", "The acceleration across the path."),
     [](const Summary& s) {
         return Json(s.limit_share->centripetal.value_or(0.0));
     }},
    {number_row("chord", "", "The chord error."),
     [](const Summary& s) {
         return Json(s.limit_share->chord.value_or(0.0));
     }},
    {number_row("none", "", "No limit."),
     [](const Summary& s) {
         return Json(s.limit_share->none);
     }},
};

constexpr WrittenKey<RaisedLimit> help_keys[] = {
    {text_row("limit", "Its name."),
     [](const RaisedLimit& limit) {
         return Json(limit.limit);
     }},
    {nullable(text_row("set", "That limit for --set; null: it is a feed of the program.")),
     [](const RaisedLimit& limit) {
         return limit.setting.empty() ? Json(nullptr) : Json(limit.setting);
     }},
    {number_row("cycle_time_s", "s", "If it alone were 10 % higher."),
     [](const RaisedLimit& limit) {
         return Json(limit.cycle_time_s);
     }},
    {number_row("gain", "", "That part of the cycle time."),
     [](const RaisedLimit& limit) {
         return Json(limit.gain);
     }},
};

using Place = ToleranceSummary::Place;
constexpr WrittenKey<Place> place_keys[] = {
    {number_row("distance", "mm or degrees", "The largest one, both ways."),
     [](const Place& place) {
         return Json(place.distance);
     }},
    {nullable(count_row("at", "The element, waypoint or move, from 1; null where the distance is 0.")),
     [](const Place& place) {
         return place.number > 0 ? Json(place.number) : Json();
     }},
    {nullable(count_row("line", "Its line in the input; null where it is not known.")),
     [](const Place& place) {
         return place.line > 0 ? Json(place.line) : Json();
     }},
};

constexpr WrittenKey<ToleranceSummary> tolerance_keys[] = {
    {flag_row("kept", "Whether each tolerance was."),
     [](const ToleranceSummary& t) {
         return Json(t.excess.empty());
     }},
    {inside_row("deviation_mm", "Distance between the path and the program."),
     [](const ToleranceSummary& t) { return written(t.deviation, place_keys); },
     [] {
         return written_schema(place_keys);
     }},
    {not_always(inside_row("deviation_deg", "The same of rotary axes.")),
     [](const ToleranceSummary& t) {
         return t.rotary_deviation ? written(*t.rotary_deviation, place_keys) : left_out();
     },
     [] {
         return written_schema(place_keys);
     }},
    {count_row("blended", "Joints that are rounded."),
     [](const ToleranceSummary& t) {
         return Json(t.blended);
     }},
    {count_row("stopped", "Joints with a stop, with the end."),
     [](const ToleranceSummary& t) {
         return Json(t.stopped);
     }},
    {count_row("through", "Joints that are passed straight on."),
     [](const ToleranceSummary& t) {
         return Json(t.through);
     }},
    {count_row("chains", "Chains of short lines."),
     [](const ToleranceSummary& t) {
         return Json(t.chains);
     }},
    {count_row("elements", "All elements."),
     [](const ToleranceSummary& t) {
         return Json(t.elements);
     }},
    {count_row("pieces", "What they became."),
     [](const ToleranceSummary& t) {
         return Json(t.pieces);
     }},
    {number_row("exact_stop_time_s", "s", "Estimate of the time with a stop at each element."),
     [](const ToleranceSummary& t) {
         return Json(t.exact_stop_s);
     }},
};

constexpr WrittenKey<Summary::MemoryBytes> memory_keys[] = {
    {count_row("curve", "Of the curve."),
     [](const Summary::MemoryBytes& m) {
         return Json(m.curve);
     }},
    {count_row("feed_plan", "Of the feed plan."),
     [](const Summary::MemoryBytes& m) {
         return Json(m.feed_plan);
     }},
    {count_row("stream", "Of the segment stream."),
     [](const Summary::MemoryBytes& m) {
         return Json(m.stream);
     }},
};

Json help_of(const Summary& summary) {
    if (!summary.what_would_help) {
        return nullptr;
    }
    Json out = Json::array();
    for (const RaisedLimit& raised : summary.what_would_help->limits) {
        out.push_back(written(raised, help_keys));
    }
    return out;
}

bool is_steered(const Summary& summary) {
    return summary.events + summary.events_not_reached > 0;
}

constexpr WrittenKey<Summary> summary_keys[] = {
    {number_row("cycle_time_s", "s", "Duration of the motion."),
     [](const Summary& s) {
         return Json(s.cycle_time_s);
     }},
    {number_row("length_mm", "mm", "Length of the path."),
     [](const Summary& s) {
         return Json(s.length_mm);
     }},
    {count_row("waypoints", "Points or moves of the input."),
     [](const Summary& s) {
         return Json(s.waypoints);
     }},
    {count_row("curve_segments", "Bezier segments."),
     [](const Summary& s) {
         return Json(s.curve_segments);
     }},
    {count_row("feed_segments", "Segments of the output."),
     [](const Summary& s) {
         return Json(s.feed_segments);
     }},
    {text_row("scalar", "Number type of the computation."),
     [](const Summary& s) {
         return Json(s.scalar);
     }},
    {nullable(text_row("jerk_scalar", "Number type of the plan with a jerk limit; null: there is none.")),
     [](const Summary& s) {
         return s.jerk_scalar.empty() ? Json(nullptr) : Json(s.jerk_scalar);
     }},
    {text_row("curve", "The method."),
     [](const Summary& s) {
         return Json(s.curve);
     }},
    {number_row("max_speed_mm_s", "mm/s", "The largest one."),
     [](const Summary& s) {
         return Json(s.max_speed_mm_s);
     }},
    {inside_row("limit_use", "Largest use of each axis limit, measured on the emitted motion."),
     [](const Summary& s) { return written(s, use_keys); },
     [] {
         return written_schema(use_keys);
     }},
    {nullable(number_row("waypoint_error_mm", "mm", "Largest distance; null: the curve need not pass them.")),
     [](const Summary& s) {
         return or_null(s.waypoint_error_mm);
     }},
    {nullable(number_row("optimum_time_s", "s", "A lower bound of the cycle time; null: stopped or steered.")),
     [](const Summary& s) {
         return or_null(s.optimum_time_s);
     }},
    {number_row("planning_time_s", "s", "From the start to the summary; on a real target how long it computed."),
     [](const Summary& s) {
         return Json(s.planning_time_s);
     }},
    {inside_row("memory_bytes", "Memory of the planner."),
     [](const Summary& s) { return written(s.memory_bytes, memory_keys); },
     [] {
         return written_schema(memory_keys);
     }},
    {flag_row("stopped", "The run ended before its program."),
     [](const Summary& s) {
         return Json(s.stopped);
     }},
    {nullable(count_row("window_limited", "How often the planning window was too short; null: not known.")),
     [](const Summary& s) {
         return or_null(s.window_limited);
     }},
    {count_row("stops", "Corners where the machine stops, without the ends."),
     [](const Summary& s) {
         return Json(s.stops);
     }},
    {number_row("smoothing_bound_mm", "mm", "Largest distance of the emitted motion from the curve."),
     [](const Summary& s) {
         return Json(s.smoothing_bound_mm);
     }},
    {count_row("peak_rss_bytes", "Memory of the process; 0: not known."),
     [](const Summary& s) {
         return Json(s.peak_rss_bytes);
     }},
    {nullable(inside_row("limit_share", "Share of the cycle time during which each limit binds.")),
     [](const Summary& s) { return s.limit_share ? written(s, share_keys) : Json(nullptr); },
     [] {
         return written_schema(share_keys);
     }},
    {nullable(inside_row("what_would_help", "Each limit that bound, planned again, the largest gain first.")), help_of,
     [] {
         return list_schema(written_schema(help_keys));
     }},
    {not_always(count_row("what_would_help_moves", "The first moves, which stand for all.")),
     [](const Summary& s) {
         return s.what_would_help && s.what_would_help->moves > 0 ? Json(s.what_would_help->moves) : left_out();
     }},
    {not_always(count_row("events", "Of the operator.")),
     [](const Summary& s) {
         return is_steered(s) ? Json(s.events) : left_out();
     }},
    {not_always(count_row("events_not_reached", "Events after the end of the run.")),
     [](const Summary& s) {
         return is_steered(s) ? Json(s.events_not_reached) : left_out();
     }},
    {not_always(inside_row("tolerance", "Of elements, G-code and lines within a tolerance.")),
     [](const Summary& s) { return s.tolerance ? written(*s.tolerance, tolerance_keys) : left_out(); },
     [] {
         return written_schema(tolerance_keys);
     }},
    {not_always(inside_row("program", "Of elements and G-code.")),
     [](const Summary& s) { return s.program.empty() ? left_out() : to_json(s.program); }, program_schema},
    {not_always(inside_row("link", "Of a run on Modbus drives.")),
     [](const Summary& s) { return s.link ? to_json(*s.link) : left_out(); }, link_schema},
    {not_always(inside_row("gpio", "Of a run on GPIO lines.")),
     [](const Summary& s) { return s.gpio ? to_json(*s.gpio) : left_out(); }, gpio_schema},
};

} // namespace

std::string to_json(const Summary& summary) {
    return written(summary, summary_keys).dump(2) + "\n";
}

nlohmann::ordered_json summary_schema() {
    return written_schema(summary_keys);
}

} // namespace splinefeed::host
