// SPDX-License-Identifier: MIT
// CurveFile: a curve .json: Bezier segments that are executed as they stand, or points and the method that joins them.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// What the file says, checked: finite numbers in range, one dimension, segments that meet.
struct CurveFile {
    /// Control points first_point to first_point + degree.
    struct Segment {
        std::size_t first_point = 0;
        int degree = 0;
    };
    static constexpr double largest_gap_mm = 1e-6; ///< between segments that meet

    std::string method; ///< as the file names it: bezier, catmull_rom
    bool closed = false;
    double tension = 0.5;          ///< catmull_rom
    int axes = 0;                  ///< numbers a point, 1 to 6
    std::vector<double> numbers;   ///< all points in order, `axes` numbers each [mm]
    std::vector<Segment> segments; ///< bezier: at least one; else none, and every point is a waypoint

    [[nodiscard]] std::size_t points() const noexcept { return numbers.size() / static_cast<std::size_t>(axes); }
    [[nodiscard]] double at(std::size_t point, std::size_t axis) const noexcept {
        return numbers[point * static_cast<std::size_t>(axes) + axis];
    }
};

/// Reads the file ("-": standard input). Throws InputError.
[[nodiscard]] CurveFile read_curve_file(const std::string& path);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] CurveFile parse_curve(std::string_view text, const std::string& file);

} // namespace splinefeed::host
