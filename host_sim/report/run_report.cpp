// SPDX-License-Identifier: MIT
#include "host_sim/report/run_report.hpp"

#include "host_sim/report/packed_column.hpp"
#include "host_sim/report/page_template.hpp"
#include "host_sim/report/program_text.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

constexpr double per_s = ticks_per_us * 1e6;
constexpr double finest_time_s = 1e-6; // units of columns
constexpr double finest_speed = 1e-3;
constexpr double finest_share = 1e-4;
constexpr double finest_jerk = 1e-1; // [mm/s^3] of an axis without a limit
constexpr double finest_load = 1.0 / 64.0;
constexpr std::size_t most_costly = 50;

template <class Item, class Value>
std::string column(const std::vector<Item>& items, double unit, const Value& value) {
    std::vector<std::int64_t> values;
    values.reserve(items.size());
    for (const Item& item : items) {
        values.push_back(std::llround(static_cast<double>(value(item)) / unit));
    }
    return packed_column(values);
}

std::vector<std::string> axis_names(const MachineDescription& machine) {
    return {machine.axis_name.begin(), machine.axis_name.begin() + machine.settings.axes};
}

Json machine_json(const MachineDescription& machine) {
    Json axes = Json::array();
    for (unsigned k = 0; k < static_cast<unsigned>(machine.settings.axes); ++k) {
        const AxisSettings& axis = machine.settings.axis[k];
        const auto& travel = machine.travel[k];
        axes.push_back({{"name", machine.axis_name[k]},
                        {"unit", axis.rotary ? "deg" : "mm"},
                        {"velocity", axis.max_velocity_mm_s},
                        {"acceleration", axis.max_acceleration_mm_s2},
                        {"braking", axis.braking_mm_s2()},
                        {"jerk", axis.max_jerk_mm_s3},
                        {"travel", travel ? Json{travel->low, travel->high} : Json()}});
    }
    return {{"name", machine.name}, {"file", machine.file}, {"axes", axes}};
}

Json places_json(const ThinnedPath& path, unsigned axes) {
    const auto& points = path.points();
    const double unit = path.tolerance() / 4.0;
    Json positions = Json::array();
    for (unsigned k = 0; k < axes; ++k) {
        positions.push_back(column(points, unit, [k](const ThinnedPath::Point& point) { return point.position[k]; }));
    }
    return {{"count", points.size()},
            {"unit", unit},
            {"tolerance", path.tolerance()},
            {"left_out", path.left_out()},
            {"position", positions}};
}

Json path_json(const MotionRecord& record, unsigned axes) {
    using Point = ThinnedPath::Point;
    const auto& points = record.path().points();
    double fastest = 0.0;
    for (const MotionRecord::Total& total : record.totals()) {
        fastest = std::max(fastest, total.max_speed_mm_s);
    }
    const double speed_unit = fastest > 0.0 ? fastest / 1000.0 : 1.0;
    double before_s = 0.0;
    const auto speed = [&before_s](const Point& point) {
        const double seconds = point.time_s - std::exchange(before_s, point.time_s);
        return seconds > 0.0 ? static_cast<double>(point.way) / seconds : 0.0;
    };
    const auto reached = [](const Point& point) {
        return point.wanted > 0.0F ? point.way / point.wanted : 0.0F;
    };
    Json out = places_json(record.path(), axes);
    out["time_unit"] = finest_time_s;
    out["speed_unit"] = speed_unit;
    out["load_unit"] = finest_load;
    out["time"] = column(points, finest_time_s, [](const Point& point) { return point.time_s; });
    out["speed"] = column(points, speed_unit, speed);
    out["reached"] = column(points, finest_load, reached);
    out["line"] = column(points, 1.0, [](const Point& point) { return static_cast<double>(point.line); });
    // Of most programs each line is a row: what remains is constant.
    out["row"] = column(points, 1.0, [](const Point& point) {
        return static_cast<double>(point.row) - static_cast<double>(point.line);
    });
    out["kind"] = column(points, 1.0, [](const Point& point) { return static_cast<double>(point.kind); });
    out["limit"] = column(points, 1.0, [](const Point& point) { return static_cast<double>(point.code); });
    out["acceleration"] = column(points, finest_load, [](const Point& point) { return point.acceleration; });
    out["jerk"] = column(points, finest_load, [](const Point& point) { return point.jerk; });
    return out;
}

Json layers_json(const MotionRecord& record) {
    constexpr double finest_mm = 1e-4;
    using Layer = LayerTimes::Layer;
    const std::vector<Layer> layers = record.layers().layers();
    return {{"count", layers.size()},
            {"unit", finest_mm},
            {"time_unit", finest_time_s},
            {"height", column(layers, finest_mm, [](const Layer& layer) { return layer.height_mm; })},
            {"start", column(layers, finest_time_s, [](const Layer& layer) { return layer.start_s; })}};
}

Json waypoints_json(const MotionRecord& record) {
    constexpr double finest_mm = 1e-4;
    const auto& waypoints = record.waypoints();
    Json positions = Json::array();
    for (unsigned k = 0; k < static_cast<unsigned>(record.machine().settings.axes); ++k) {
        positions.push_back(column(waypoints, finest_mm, [k](const PerAxis<double>& point) { return point[k]; }));
    }
    return {{"count", waypoints.size()}, {"unit", finest_mm}, {"position", positions}};
}

Json deviation_json(const MotionRecord& record) {
    constexpr double finest_mm = 1e-6;
    return {{"count", record.deviations().size()},
            {"rows", record.rows_together()},
            {"unit", finest_mm},
            {"mm", column(record.deviations(), finest_mm, [](float mm) { return mm; })}};
}

/// The lowest value in each bin, and how far the highest one is above it.
Json channel_json(const TimeStrips& strips, std::size_t channel, double unit) {
    std::vector<std::int64_t> low;
    std::vector<std::int64_t> width;
    for (std::size_t i = 0; i < strips.bins().size(); ++i) {
        low.push_back(std::llround(static_cast<double>(strips.range(i, channel).low) / unit));
        width.push_back(std::llround(static_cast<double>(strips.range(i, channel).high) / unit) - low.back());
    }
    return {{"unit", unit}, {"low", packed_column(low)}, {"width", packed_column(width)}};
}

Json target_json(const TargetRecord& record) {
    const TimeStrips& strips = record.strips();
    constexpr double finest_buffer_s = 1e-4;
    Json channels = Json::array();
    for (std::size_t c = 0; c < strips.channels(); ++c) {
        channels.push_back(channel_json(strips, c, finest_buffer_s));
    }
    return {{"count", strips.bins().size()},
            {"bin_s", static_cast<double>(strips.bin_ticks()) / per_s},
            {"least_s", record.least_s()},
            {"channels", channels}};
}

Json strips_json(const MotionRecord& record) {
    const TimeStrips& strips = record.strips();
    using Bin = TimeStrips::Bin;
    const auto& bins = strips.bins();
    Json channels = Json::array();
    for (std::size_t c = 0; c < strips.channels(); ++c) {
        const bool jerk = c > 0 && c % 3 == 0;
        const double limit = jerk ? record.machine().settings.axis[c / 3 - 1].max_jerk_mm_s3 : 0.0;
        const double unit = c == 0 ? finest_speed : jerk && !(limit > 0.0) ? finest_jerk : finest_share;
        channels.push_back(channel_json(strips, c, unit));
    }
    return {{"count", bins.size()},
            {"bin_s", static_cast<double>(strips.bin_ticks()) / per_s},
            {"length_unit", finest_speed},
            {"feed_unit", finest_speed},
            {"length_mm", record.length_mm()},
            {"length", column(bins, finest_speed, [](const Bin& bin) { return bin.length_mm; })},
            {"feed", column(bins, finest_speed, [](const Bin& bin) { return bin.feed_mm_s; })},
            {"limit", column(bins, 1.0, [](const Bin& bin) { return static_cast<double>(bin.code); })},
            {"channels", channels}};
}

// Every limit that is named in the columns.
Json limits_json(const MotionRecord& record) {
    const std::vector<std::string> names = axis_names(record.machine());
    std::set<std::uint8_t> codes{0};
    for (const TimeStrips::Bin& bin : record.strips().bins()) {
        codes.insert(bin.code);
    }
    for (const ThinnedPath::Point& point : record.path().points()) {
        codes.insert(point.code);
    }
    for (const LineTimes::Line& line : record.lines().lines()) {
        codes.insert(line.code);
    }
    Json out = Json::object();
    for (const std::uint8_t code : codes) {
        out[std::to_string(code)] = {{"name", limit_name(BindingLimit::of(code), names)}};
    }
    return out;
}

Json tools_json(const MotionRecord& record) {
    Json out = Json::array();
    for (const auto& [number, seconds] : record.tools()) {
        out.push_back({{"number", number}, {"time_s", seconds}});
    }
    return out;
}

Json stops_json(const MotionRecord& record) {
    constexpr std::array whys{"turn", "asked", "exact stop", "program", "held", "end"};
    Json out = Json::array();
    for (const MotionRecord::Stop& stop : record.stops()) {
        Json position = Json::array();
        for (unsigned k = 0; k < static_cast<unsigned>(record.machine().settings.axes); ++k) {
            position.push_back(std::round(stop.position[k] * 1e6) / 1e6);
        }
        out.push_back({{"t", stop.time_s},
                       {"stood_s", stop.stood_s},
                       {"row", stop.row},
                       {"line", stop.line},
                       {"turn_deg", std::round(stop.turn_deg * 100.0) / 100.0},
                       {"why", whys[static_cast<std::size_t>(stop.why)]},
                       {"position", position}});
    }
    return out;
}

Json operated_json(const MotionRecord& record) {
    constexpr std::array names{"hold", "resume", "abort", "override"};
    Json out = Json::array();
    for (const MotionRecord::Operated& done : record.operated()) {
        out.push_back({{"t", done.time_s},
                       {"what", names[static_cast<std::size_t>(done.event.operation)]},
                       {"value", done.event.value}});
    }
    return out;
}

Json lines_json(const MotionRecord& record, const ReportFacts& facts) {
    using Line = LineTimes::Line;
    const std::vector<std::uint64_t> slowest = record.lines().slowest(most_costly);
    std::vector<Line> lines = record.lines().lines();
    const ProgramText text =
        facts.text_file.empty() ? ProgramText{} : read_program_text(facts.text_file, slowest, lines.size());
    std::vector<double> beads; // filament by way
    for (std::size_t i = 0; i < text.extruded.size(); ++i) {
        const auto way_mm = static_cast<double>(lines[i].way_mm);
        beads.push_back(way_mm > 0.0 ? static_cast<double>(text.extruded[i]) / way_mm : 0.0);
    }
    Json picked = Json::object();
    for (const auto& [number, line] : text.picked) {
        picked[std::to_string(number)] = line;
    }
    Json costly = Json::array();
    for (const std::uint64_t number : slowest) {
        const Line& line = lines[number];
        costly.push_back({{"line", number}, {"start_s", line.start_s}, {"time_s", line.seconds}, {"limit", line.code}});
    }
    if (text.lines > 0) {
        lines.resize(std::min<std::size_t>(lines.size(), text.head_lines + 1));
    }
    return {{"unit", facts.unit},
            {"text", text.head},
            {"text_lines", text.head_lines},
            {"file_lines", text.lines},
            {"picked", picked},
            {"slowest", costly},
            {"count", lines.size()},
            {"time_unit", finest_time_s},
            {"start", column(lines, finest_time_s, [](const Line& line) { return line.start_s; })},
            {"seconds", column(lines, finest_time_s, [](const Line& line) { return line.seconds; })},
            {"limit", column(lines, 1.0, [](const Line& line) { return static_cast<double>(line.code); })},
            {"bead_count", beads.size()},
            {"bead_unit", finest_share},
            {"bead", column(beads, finest_share, [](double bead) { return std::min(bead, 100.0); })}};
}

Json totals_json(const MotionRecord& record) {
    constexpr std::array names{"feed", "rapid", "approach", "standing"};
    Json out = Json::object();
    for (std::size_t i = 0; i < names.size(); ++i) {
        out[names[i]] = {{"time_s", record.totals()[i].seconds},
                         {"length_mm", record.totals()[i].length_mm},
                         {"max_speed_mm_s", record.totals()[i].max_speed_mm_s}};
    }
    return out;
}

// A JSON text that no parser of HTML takes for markup: a < is only in strings, where it may be written by its number.
void append_data(OutputFile& file, const std::string& text) {
    std::size_t from = 0;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', from)) {
        file.append(std::string_view(text).substr(from, at - from));
        file.append("\\u003c");
        from = at + 1;
    }
    file.append(std::string_view(text).substr(from));
}

} // namespace

void RunReport::write(const ReportFacts& facts) {
    record_.finish();
    const auto axes = static_cast<unsigned>(record_.machine().settings.axes);
    Json data;
    data["program"] = facts.program;
    data["stopped"] = facts.stopped;
    data["machine"] = machine_json(record_.machine());
    data["summary"] = Json::parse(to_json(*facts.summary));
    if (data["summary"].contains("program")) {
        data["summary"]["program"].erase("first_events"); // here are more of them
    }
    data["events"] = to_json(record_.events());
    data["event_count"] = facts.summary->program.events;
    data["tools"] = tools_json(record_);
    data["limits"] = limits_json(record_);
    data["totals"] = totals_json(record_);
    data["stop_count"] = record_.stop_count();
    data["stops"] = stops_json(record_);
    data["operated"] = operated_json(record_);
    data["lines"] = lines_json(record_, facts);
    data["path"] = path_json(record_, axes);
    data["programmed"] = places_json(record_.programmed(), axes);
    data["layers"] = layers_json(record_);
    data["waypoints"] = waypoints_json(record_);
    data["deviation"] = deviation_json(record_);
    data["strips"] = strips_json(record_);
    data["target"] = target_json(record_.target());
    for (const std::string_view piece : page_head()) {
        file_.append(piece);
    }
    file_.append("<script type=\"application/json\" id=\"data\">");
    append_data(file_, data.dump(-1, ' ', false, Json::error_handler_t::replace));
    file_.append("</script>");
    for (const std::string_view piece : page_tail()) {
        file_.append(piece);
    }
    file_.commit();
}

} // namespace splinefeed::host
