// SPDX-License-Identifier: MIT
// InputFormat: the formats that a path may be read from, by their names. A new one is a row in input_format.cpp.
#pragma once

#include "host_sim/program/waypoint_rows.hpp"

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

struct InputFormat {
    std::string_view name; ///< of --format, and behind the dot of a file's name
    /// Opens an input of waypoints and reads as far as its axes are known. Throws InputError. Null: the format is one
    /// of curves.
    /// @param name          of the input, for messages
    /// @param machine_axes  empty: the rows have the axes that the input has
    OpenedRows (*open)(const std::string& path, const std::string& name, const std::vector<std::string>& machine_axes);

    [[nodiscard]] bool is_curve() const noexcept { return open == nullptr; }
};

/// The format of that name; null: there is none.
[[nodiscard]] const InputFormat* input_format(std::string_view name) noexcept;

/// The names of all formats, with `before` each of them: for "csv|json" or ".csv or .json".
[[nodiscard]] std::string input_formats(std::string_view between, std::string_view before = "");

} // namespace splinefeed::host
