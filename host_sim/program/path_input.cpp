// SPDX-License-Identifier: MIT
#include "host_sim/program/path_input.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/json_text.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/program/dialect_guess.hpp"
#include "host_sim/program/element_file.hpp"
#include "host_sim/program/row_queue.hpp"

#include "host_sim/curve/methods/method_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

namespace {

/// Of a curve that is made of all of them: about 2 GB.
constexpr std::uint64_t most_points = 1'000'000;

/// Whether two waypoints are one, as WaypointCurve::push has it for the streaming methods: 0.1 um on every axis.
bool merged(const PerAxis<double>& a, const PerAxis<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return std::fabs(x - y) < 1e-4; });
}

} // namespace

PathInput::PathInput(const PathArguments& arguments, PathUse use, const PathMachine& machine)
    : name_(arguments.name.empty() ? arguments.input : arguments.name), path_(arguments.input), given_(arguments.rows),
      tolerances_(machine.tolerances), format_(arguments.format), machine_axes_(machine.axes),
      scalar_(arguments.scalar), read_ahead_(use == PathUse::followed), content_(open(arguments, use, machine)) {}

PathInput::Content PathInput::open(const PathArguments& arguments, PathUse use, const PathMachine& machine) {
    if (path_ == "-" && is_regular_file("/dev/stdin")) {
        path_ = "/dev/stdin"; // it can be read twice
    }
    reopens_ = given_ ? given_->repeatable : is_regular_file(path_);
    if (format_->is_curve()) {
        return open_description(arguments, use);
    }
    if (const std::string_view option = first_option(arguments.gcode); !option.empty() && !format_->is_gcode()) {
        throw UsageError("{}: only a program in G-code has it; leave the option out", option);
    }
    if (format_->is_gcode()) {
        return open_gcode(arguments, use, machine);
    }
    return open_waypoints(arguments, use);
}

OpenedRows PathInput::open_rows() const {
    return given_ ? given_->open(name_, machine_axes_) : format_->open(path_, name_, machine_axes_);
}

PathInput::Content PathInput::open_waypoints(const PathArguments& arguments, PathUse use) {
    choice_ = choose_curve(arguments.curve);
    OpenedRows opened = open_rows();
    axes_ = std::move(opened.axes);
    const bool within_tolerance = choice_.tolerance_mm > 0.0 || opened.has_tolerances;
    if (opened.has_tolerances && choice_.method != "polyline") {
        throw InputError(name_, 0,
                         "there is a column tolerance, and --curve {} has none; add --curve polyline, or "
                         "leave the column out",
                         choice_.method);
    }
    if (within_tolerance && choice_.closed) {
        throw InputError(name_, 0,
                         "a column tolerance and --closed exclude each other; repeat the first waypoint at the end "
                         "instead");
    }
    if (const PointsMethod* const method = points_method(choice_.method)) {
        return compute_from_points(*method, *opened.rows, use);
    }
    return Waypoints{std::move(opened.rows), within_tolerance};
}

CurveFile PathInput::compute_from_points(const PointsMethod& method, WaypointRows& rows, PathUse use) {
    std::vector<PerAxis<double>> points;
    WaypointRow row;
    while (rows.next(row)) {
        if (points_read_ == most_points) {
            throw InputError(name_, row.line,
                             "--curve {} is made of all points at once, and takes at most {}; take another "
                             "curve, which streams (g2), or fewer points",
                             choice_.method, most_points);
        }
        if (row.feed_mm_s > 0.0 || row.max_feed_mm_s > 0.0 || row.corner != Corner::automatic) {
            throw InputError(name_, row.line,
                             "--curve {} takes all points as one smooth curve; leave out the columns "
                             "feed, max_feed and corner",
                             choice_.method);
        }
        if (points.empty() || !merged(points.back(), row.position)) {
            points.push_back(row.position);
        }
        ++points_read_;
    }
    if (choice_.closed && points.size() > 1 && merged(points.front(), points.back())) {
        points.pop_back();
    }
    const int axes = static_cast<int>(axes_.size());
    try {
        CurveFile file = compute_curve(method.description, method.input(choice_, points, axes), scalar_, name_);
        if (use != PathUse::drawn) {
            require_executable(file, name_);
        }
        return file;
    } catch (const DescriptionError& error) {
        throw InputError(name_, 0, error.what());
    }
}

PathInput::Content PathInput::open_description(const PathArguments& arguments, PathUse use) {
    if (const std::string_view option = first_option(arguments.curve); !option.empty()) {
        throw UsageError("{}: a curve file says itself which curve it is; leave the option out", option);
    }
    const nlohmann::json document = parse_json(read_text_file(path_, largest_curve_file, name_), name_);
    if (has_elements(document)) {
        return open_elements(arguments, document);
    }
    if (arguments.curve.tolerance) {
        throw UsageError("--tolerance: a curve is followed exactly; leave the option out, or take a file of elements");
    }
    CurveFile file = curve_of(document, name_, arguments.scalar);
    if (file.described && use != PathUse::drawn) {
        require_executable(file, name_);
    }
    choice_.method = "bezier";
    choice_.closed = file.closed;
    choice_.smooth = arguments.curve.smooth;
    const auto count = static_cast<std::size_t>(file.axes);
    axes_ = machine_axes_.empty() ? std::vector<std::string>(every_axis.begin(), every_axis.begin() + file.axes)
                                  : machine_axes_;
    if (count > axes_.size()) {
        throw InputError(name_, 0, "the points have {} coordinates; the machine has {} axes: {}", count, axes_.size(),
                         fmt::join(axes_, ", "));
    }
    return file;
}

ElementProgram PathInput::open_elements(const PathArguments& arguments, const nlohmann::json& document) {
    if (arguments.curve.smooth) {
        throw UsageError("--smooth: a program of elements is smoothed within its tolerance; leave the option out");
    }
    if (arguments.curve.tolerance) {
        tolerances_.programmed_mm = read_tolerance(*arguments.curve.tolerance);
    }
    choice_.method = "elements";
    axes_ = machine_axes_.empty() ? axes_of_elements(document) : machine_axes_;
    return read_elements(document, name_, axes_, tolerances_);
}

GcodeSettings PathInput::open_gcode(const PathArguments& arguments, PathUse use, const PathMachine& machine) {
    if (const std::string_view option = first_option(arguments.curve); !option.empty()) {
        throw UsageError("{}: a program in G-code says itself what its path is; leave the option out", option);
    }
    if (arguments.curve.smooth) {
        throw UsageError("--smooth: a program in G-code is smoothed within its tolerance; leave the option out");
    }
    if (arguments.curve.tolerance) {
        tolerances_.programmed_mm = read_tolerance(*arguments.curve.tolerance);
    }
    choice_.method = "gcode";
    axes_ = machine.axes.empty() ? std::vector<std::string>{"x", "y", "z"} : machine.axes;
    GcodeSettings out = read_gcode_arguments(arguments.gcode);
    if (reopens_ && path_ == arguments.input && arguments.name.empty()) { // others are beside nothing
        out.subprogram_folders.insert(out.subprogram_folders.begin(), std::filesystem::path(path_).parent_path());
    }
    out.simulated = use != PathUse::followed;
    out.tolerance_mm = tolerances_.programmed_mm;
    out.chain_quarters = tolerances_.rules.chain_quarters;
    out.rapid_tolerance_mm = tolerances_.rapid_mm;
    out.axes = axes_;
    out.max_feed_mm_s = machine.max_feed_mm_s;
    out.rotary_axes = machine.rotary_axes;
    out.spindle = machine.spindle;
    out.lines = machine.lines;
    left_out_ = std::make_unique<LeftOutList>();
    out.left_out = left_out_.get();
    if (out.dialect_choice == DialectChoice::first_lines && !reopens_) {
        throw UsageError("--dialect auto reads the first lines before the others; name the dialect, or give it a file");
    }
    if (reopens_) {
        guess_dialect(out);
    }
    return out;
}

// Also where a dialect was named, or none: a refusal says which one the program looks like.
void PathInput::guess_dialect(GcodeSettings& out) {
    LineReader lines(path_, name_);
    DialectGuess guess;
    SourceLine line;
    try {
        while (line.number < DialectGuess::most_lines && lines.next(line)) {
            guess.add(line.text, line.number);
        }
    } catch (const InputError&) { // whoever reads the program says it
        return;
    }
    const std::string reason = guess.reason();
    const Dialect looks_like = guess.dialect();
    if (out.dialect_choice == DialectChoice::first_lines) {
        out.dialect = looks_like;
        dialect_choice_ = fmt::format("--dialect {}: {}", dialect_name(looks_like),
                                      reason.empty() ? "nothing in the first 200 lines says another one" : reason);
    } else if (!reason.empty() && looks_like != out.dialect) {
        out.dialect_guess = fmt::format(" (the program looks like {}, by {})", dialect_name(looks_like), reason);
    }
    if (out.dialect_choice == DialectChoice::first_lines ||
        (out.dialect_choice == DialectChoice::nobody && !out.dialect_guess.empty())) {
        dialect_doubt_ = guess.differences(out.dialect);
    }
}

std::vector<std::string> PathInput::dialect_notes() const {
    std::vector<std::string> out;
    if (!dialect_choice_.empty()) {
        out.push_back(dialect_choice_);
    }
    if (!dialect_doubt_.empty()) {
        out.push_back(dialect_doubt_ + "; --dialect says whose words they are");
    }
    return out;
}

std::vector<LeftOutList::Entry> PathInput::left_out() const {
    return left_out_ ? left_out_->entries() : std::vector<LeftOutList::Entry>{};
}

void PathInput::begin_at(const MachineState& state) {
    if (auto* const program = std::get_if<GcodeSettings>(&content_)) {
        program->offsets = state.offsets;
        for (unsigned k = 0; k < axes_.size(); ++k) {
            program->start[k] = position_from_mm(state.position_mm[k].value_or(0.0));
        }
    }
}

void PathInput::end_after(std::uint64_t moves) {
    if (auto* const program = std::get_if<GcodeSettings>(&content_)) {
        program->most_moves = moves;
    }
}

std::unique_ptr<SourceLines> PathInput::lines() {
    auto lines = std::make_unique<LineReader>(path_, name_);
    return read_ahead_ ? std::unique_ptr<SourceLines>(std::make_unique<LineQueue>(std::move(lines))) : std::move(lines);
}

std::unique_ptr<WaypointRows> PathInput::rows() {
    auto& opened = std::get<Waypoints>(content_).opened;
    std::unique_ptr<WaypointRows> rows = opened ? std::move(opened) : open_rows().rows;
    return read_ahead_ ? std::make_unique<RowQueue>(std::move(rows)) : std::move(rows);
}

} // namespace splinefeed::host
