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

struct CurveText {
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
    const char* name;
    Text GcodeArguments::*value;
};
constexpr GcodeText gcode_texts[] = {
    {"dialect", &GcodeArguments::dialect},
    {"ignore", &GcodeArguments::ignore},
    {"tools", &GcodeArguments::tools},
};

struct OtherText {
    const char* name;
    void (*take)(const std::string& text, RunArguments& out);
};
constexpr OtherText other_texts[] = {
    {"scalar",
     [](const std::string& text, RunArguments& out) {
         out.path.scalar = host::read_scalar("--scalar", text, {"fixed", "float", "double"});
     }},
    {"jerk_scalar",
     [](const std::string& text, RunArguments& out) {
         out.motion.planner.jerk_scalar = host::read_scalar("--jerk-scalar", text, {"double", "float"});
     }},
    {"window",
     [](const std::string& text, RunArguments& out) {
         out.motion.planner.window_cells = host::read_window(text);
     }},
    {"state",
     [](const std::string& text, RunArguments& out) {
         out.state = text;
     }},
    {"position",
     [](const std::string& text, RunArguments& out) {
         out.position = text;
     }},
};

struct Flag {
    const char* name;
    bool& (*of)(RunArguments& out);
};
constexpr Flag flags[] = {
    {"closed",
     [](RunArguments& out) -> bool& {
         return out.path.curve.closed;
     }},
    {"smooth",
     [](RunArguments& out) -> bool& {
         return out.path.curve.smooth;
     }},
    {"increments",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.increments;
     }},
    {"block_delete",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.block_delete;
     }},
    {"optional_stop",
     [](RunArguments& out) -> bool& {
         return out.path.gcode.optional_stop;
     }},
    {"advice",
     [](RunArguments& out) -> bool& {
         return out.helps;
     }},
};

template <class Row, std::size_t n>
const Row* find_row(const Row (&rows)[n], const std::string& name) {
    const Row* const found = std::find_if(rows, rows + n, [&](const Row& row) { return name == row.name; });
    return found == rows + n ? nullptr : found;
}

[[noreturn]] void refuse_name(const std::string& name) {
    std::vector<std::string_view> known;
    const auto add = [&](const auto& rows) {
        for (const auto& row : rows) {
            known.emplace_back(row.name);
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

RunArguments read_options(const py::dict& options) {
    RunArguments out;
    out.helps = false;
    out.summary = host::SummaryKind::none;
    out.outputs.prints_summary = false;
    out.motion.enforce = false;
    out.motion.quiet = true;
    for (const auto& [key, value] : options) {
        const auto name = py::cast<std::string>(key);
        if (const Flag* const flag = find_row(flags, name)) {
            if (!py::isinstance<py::bool_>(value)) {
                throw py::type_error(name + " must be True or False");
            }
            flag->of(out) = py::cast<bool>(value);
            continue;
        }
        const auto text = py::cast<std::string>(py::str(value));
        if (const CurveText* const of_curve = find_row(curve_texts, name)) {
            out.path.curve.*of_curve->value = text;
        } else if (const GcodeText* const of_gcode = find_row(gcode_texts, name)) {
            out.path.gcode.*of_gcode->value = text;
        } else if (const OtherText* const other = find_row(other_texts, name)) {
            other->take(text, out);
        } else {
            refuse_name(name);
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
