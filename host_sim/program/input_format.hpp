// SPDX-License-Identifier: MIT
// InputFormat: the formats that a path may be read from, by their names. A new one is a row in input_format.cpp.
#pragma once

#include "host_sim/program/waypoint_row.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// The axes that a path may have.
inline const std::vector<std::string> every_axis{"x", "y", "z", "a", "b", "c"};

/// Waypoints, and the names of their coordinates, which a reader knows before its first row.
struct OpenedRows {
    std::unique_ptr<WaypointRows> rows;
    std::vector<std::string> axes;
    bool has_tolerances = false; ///< rows may state a tolerance
};

enum class InputKind {
    waypoints, ///< rows of points
    curve,     ///< a curve, or elements
    gcode,     ///< lines of a program
};

struct InputFormat {
    std::string_view name; ///< of --format
    InputKind kind = InputKind::waypoints;
    std::string_view suffixes; ///< of files' names, each with a blank before and behind it
    /// Opens an input of waypoints and reads as far as its axes are known. Throws InputError. Null: another kind.
    /// @param name          of the input, for messages
    /// @param machine_axes  empty: the rows have the axes that the input has
    OpenedRows (*open)(const std::string& path, const std::string& name, const std::vector<std::string>& machine_axes);

    [[nodiscard]] bool is_curve() const noexcept { return kind == InputKind::curve; }
    [[nodiscard]] bool is_gcode() const noexcept { return kind == InputKind::gcode; }
};

/// The format of that name; null: there is none.
[[nodiscard]] const InputFormat* input_format(std::string_view name) noexcept;

/// The format of files whose names end like this, in any case; null: there is none. @param suffix  without the dot
[[nodiscard]] const InputFormat* format_of_suffix(std::string_view suffix) noexcept;

/// The names of all formats, with `before` each of them: for "csv|json" or ".csv or .json".
[[nodiscard]] std::string input_formats(std::string_view between, std::string_view before = "");

} // namespace splinefeed::host
