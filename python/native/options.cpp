// SPDX-License-Identifier: MIT
// Options of the command as keyword arguments, and arrays as waypoints.
#include "python/native/binding.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::python {

namespace {

using host::CurveArguments;
using host::GcodeArguments;
using host::RunArguments;
using Text = std::optional<std::string>;

// Which of OptionsOf a row is for.
constexpr unsigned of_all = 15;
constexpr unsigned of_planned = 14; // not drawn
constexpr unsigned of_programs = 8;
constexpr unsigned of_finite = 12; // what can be planned again

struct CurveText {
    static constexpr unsigned of = of_all;
    const char* name;
    Text CurveArguments::*value;
};
constexpr CurveText curve_texts[] = {
    {"curve", &CurveArguments::method},
    {"degree", &CurveArguments::degree},
    {"parameterization", &CurveArguments::parameterization},
    {"knots", &CurveArguments::knots},
    {"tension", &CurveArguments::tension},
    {"factor", &CurveArguments::factor},
    {"beta1", &CurveArguments::beta1},
    {"beta2", &CurveArguments::beta2},
    {"lambda_", &CurveArguments::lambda},
    {"mu", &CurveArguments::mu},
    {"curvature_sign", &CurveArguments::curvature_sign},
    {"corner_angle", &CurveArguments::corner_angle},
    {"tolerance_mm", &CurveArguments::tolerance},
    {"start_tangent", &CurveArguments::start_tangent},
    {"end_tangent", &CurveArguments::end_tangent},
};

struct GcodeText {
    static constexpr unsigned of = of_programs;
    const char* name;
    Text GcodeArguments::*value;
};
constexpr GcodeText gcode_texts[] = {
    {"dialect", &GcodeArguments::dialect}, {"ignore", &GcodeArguments::ignore},
    {"tools", &GcodeArguments::tools},     {"subprograms", &GcodeArguments::subprograms},
    {"repeat", &GcodeArguments::repeat},
};

struct OtherText {
    unsigned of;
    const char* name;
    void (*take)(const std::string& text, RunArguments& out);
};
constexpr OtherText other_texts[] = {
    {of_all, "scalar",
     [](const std::string& text, RunArguments& out) {
         out.path.scalar = host::read_scalar("--scalar", text, {"fixed", "float", "double"});
     }},
    {of_planned, "jerk_scalar",
     [](const std::string& text, RunArguments& out) {
         out.motion.planner.jerk_scalar = host::read_scalar("--jerk-scalar", text, {"double", "float"});
     }},
    {of_planned, "window",
     [](const std::string& text, RunArguments& out) {
         out.motion.planner.window_cells = host::read_window(text);
     }},
    {of_programs, "state",
     [](const std::string& text, RunArguments& out) {
         out.state = text;
     }},
    {of_programs, "position",
     [](const std::string& text, RunArguments& out) {
         out.position = text;
     }},
    {of_programs, "zero",
     [](const std::string& text, RunArguments& out) {
         out.zero = text;
     }},
};

struct Flag {
    unsigned of;
    const char* name;
    bool& (*member)(RunArguments& out);
};
constexpr Flag flags[] = {
    {of_all, "closed",
     [](RunArguments& out) -> bool& {
         return out.path.curve.closed;
     }},
    {of_all, "smooth",
     [](RunArguments& out) -> bool& {
         return out.path.curve.smooth;
     }},
    {of_programs, "increments",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.increments;
     }},
    {of_programs, "block_delete",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.block_delete;
     }},
    {of_programs, "optional_stop",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.optional_stop;
     }},
    {of_finite, "advice",
     [](RunArguments& out) -> bool& {
         return out.helps;
     }},
};

template <class Row>
bool is_of(const Row& row, OptionsOf of) {
    return (row.of & static_cast<unsigned>(of)) != 0;
}

template <class Row, std::size_t n>
const Row* find_row(const Row (&rows)[n], const std::string& name, OptionsOf of) {
    const Row* const found =
        std::find_if(rows, rows + n, [&](const Row& row) { return is_of(row, of) && name == row.name; });
    return found == rows + n ? nullptr : found;
}

[[noreturn]] void refuse_name(const std::string& name, OptionsOf of) {
    std::vector<std::string_view> known;
    const auto add = [&](const auto& rows) {
        for (const auto& row : rows) {
            if (is_of(row, of)) {
                known.emplace_back(row.name);
            }
        }
    };
    add(curve_texts);
    add(gcode_texts);
    add(other_texts);
    add(flags);
    throw py::type_error(fmt::format("there is no argument '{}'{}", name, host::suggestion(name, known)));
}

std::vector<double> numbers(const std::optional<Column>& column, std::size_t rows, const char* name) {
    if (!column) {
        return {};
    }
    if (column->ndim() != 1 || static_cast<std::size_t>(column->size()) != rows) {
        throw py::value_error(fmt::format("{} must have one number for each of the {} points", name, rows));
    }
    return {column->data(), column->data() + column->size()};
}

} // namespace

void require_path(const char* what, const std::string& path) {
    if (path.empty() || path == "-") {
        throw host::UsageError(fmt::format("{} has no file; give its path, not '{}'", what, path));
    }
}

RunArguments read_options(const py::dict& options, OptionsOf of) {
    RunArguments out;
    out.helps = false;
    out.summary = host::SummaryKind::none;
    out.outputs.prints_summary = false;
    out.motion.enforce = false;
    out.motion.quiet = true;
    for (const auto& [key, value] : options) {
        const auto name = py::cast<std::string>(key);
        if (const Flag* const flag = find_row(flags, name, of)) {
            if (!py::isinstance<py::bool_>(value)) {
                throw py::type_error(name + " must be True or False");
            }
            flag->member(out) = py::cast<bool>(value);
            continue;
        }
        const auto text = py::cast<std::string>(py::str(value));
        if (const CurveText* const of_curve = find_row(curve_texts, name, of)) {
            out.path.curve.*of_curve->value = text;
        } else if (const GcodeText* const of_gcode = find_row(gcode_texts, name, of)) {
            out.path.gcode.*of_gcode->value = text;
        } else if (const OtherText* const other = find_row(other_texts, name, of)) {
            other->take(text, out);
        } else {
            refuse_name(name, of);
        }
    }
    return out;
}

host::WaypointTable make_table(const Column& points, const std::optional<Column>& feed_mm_s,
                               const std::optional<Column>& max_feed_mm_s, const std::optional<Column>& tolerance_mm,
                               const std::optional<Column>& corner) {
    if (points.ndim() != 2) {
        throw py::value_error("points must be an array of the shape (n, axes)");
    }
    host::WaypointTable out;
    out.columns = static_cast<std::size_t>(points.shape(1));
    out.position_mm.assign(points.data(), points.data() + points.size());
    const auto rows = static_cast<std::size_t>(points.shape(0));
    out.feed_mm_s = numbers(feed_mm_s, rows, "feed_mm_s");
    out.max_feed_mm_s = numbers(max_feed_mm_s, rows, "max_feed_mm_s");
    out.tolerance_mm = numbers(tolerance_mm, rows, "tolerance_mm");
    out.corner = numbers(corner, rows, "corner");
    return out;
}

} // namespace splinefeed::python
