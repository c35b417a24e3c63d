// SPDX-License-Identifier: MIT
// CurveFile: a curve .json: Bezier segments that are executed unchanged, or points and the method that joins them.
#pragma once

#include "host_sim/base/scalar_kind.hpp"

#include "host_sim/curve/methods/parameter_interval.hpp"

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// A curve as Bezier segments, read from the file or computed as it describes.
struct CurveFile {
    /// Control points first_point to first_point + degree.
    struct Segment {
        std::size_t first_point = 0;
        int degree = 0;
    };
    static constexpr double largest_gap_mm = 1e-6; ///< largest gap between segments that meet

    std::string method = "bezier"; ///< the name of --curve
    bool described = false;        ///< computed from a description
    bool closed = false;
    int axes = 0;                                          ///< numbers a point, 1 to 6
    std::vector<double> numbers;                           ///< all control points in order, `axes` numbers each [mm]
    std::vector<Segment> segments;                         ///< at least one
    std::vector<ParameterInterval> intervals;              ///< as in DescribedCurve
    std::shared_ptr<const nlohmann::ordered_json> results; ///< of its method, beside the segments; null: none
    std::vector<std::string> warnings;                     ///< sentences

    [[nodiscard]] std::size_t points() const noexcept { return numbers.size() / static_cast<std::size_t>(axes); }
    [[nodiscard]] double at(std::size_t point, std::size_t axis) const noexcept {
        return numbers[point * static_cast<std::size_t>(axes) + axis];
    }
};

/// Largest file of a curve or a program. [bytes]
inline constexpr std::size_t largest_curve_file = std::size_t{1} << 28;

/// Reads a document; a description is computed in `scalar`. Segments of the file are checked: finite numbers in range,
/// equal dimensions, segments that meet. Throws InputError.
/// @param file  its name in messages
[[nodiscard]] CurveFile curve_of(const nlohmann::json& document, const std::string& file, ScalarKind scalar);

/// The same for a text; `file` is its name in messages.
[[nodiscard]] CurveFile parse_curve(std::string_view text, const std::string& file,
                                    ScalarKind scalar = ScalarKind::float64);

/// Computes the curve of a description. Throws InputError.
[[nodiscard]] CurveFile compute_curve(std::string_view method, const nlohmann::json& input, ScalarKind scalar,
                                      const std::string& file);

/// Checks that a machine can follow a computed curve: positions in range, and segment lengths that the core accepts.
/// Throws InputError.
void require_executable(const CurveFile& curve, const std::string& file);

} // namespace splinefeed::host
