// SPDX-License-Identifier: MIT
// MethodTable: the methods that a description may name, and those of all points that --curve may name. A new one adds
// its functions and rows in method_table.cpp.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/curve/methods/curve_choice.hpp"
#include "host_sim/curve/methods/curve_method.hpp"
#include "host_sim/curve/methods/description.hpp"

#include <span>

namespace splinefeed::host {

/// A method that sees all points at once, as --curve names it.
struct PointsMethod {
    CurveMethod method;
    std::string_view description; ///< its name in descriptions
    /// The "input" of a description of it. Throws DescriptionError where the points do not make up what it needs.
    /// @param axes  numbers a point
    nlohmann::json (*input)(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes);
};

[[nodiscard]] std::span<const PointsMethod> points_methods() noexcept;
/// The one of that name; null: there is none, or it streams.
[[nodiscard]] const PointsMethod* points_method(std::string_view curve_name) noexcept;

/// Names of the methods, as descriptions spell them.
[[nodiscard]] std::vector<std::string_view> described_methods();

/// The option name of --curve for a description's method: catmull_rom is catmull-rom, boehm is bspline.
[[nodiscard]] std::string curve_name_of(std::string_view method);

/// Computes the curve. Throws DescriptionError, also for an unknown method. `results` also gets `joints`, the measured
/// classes of continuity, and `warnings`, in addition to the method's own keys.
[[nodiscard]] DescribedCurve describe_curve(std::string_view method, const nlohmann::json& input, ScalarKind scalar);

} // namespace splinefeed::host
