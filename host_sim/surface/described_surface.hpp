// SPDX-License-Identifier: MIT
// DescribedSurface: a surface that was computed from a description, with its intermediate results.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/curve/methods/description.hpp"
#include "splinefeed/surfaces/bspline_surface.hpp"

#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Owns knots and net, in mm. double holds the numbers of every type in which they were computed; the surface is
/// evaluated in double.
struct DescribedSurface {
    int axes = 0;
    int degree_u = 3;
    int degree_v = 3;
    std::vector<double> params_u; ///< empty for skins: each section has its own
    std::vector<double> params_v;
    std::vector<double> knots_u;
    std::vector<double> knots_v;
    std::vector<Point<double>> net;                                    ///< [i * points along v + j]
    nlohmann::ordered_json results = nlohmann::ordered_json::object(); ///< further keys of the report

    [[nodiscard]] BSplineSurface<double> view() const noexcept {
        return {axes, degree_u, degree_v, knots_u, knots_v, net};
    }
};

/// "bspline_surface": the surface through input["grid"] (Sakude, section 3). Throws DescriptionError.
[[nodiscard]] DescribedSurface describe_grid(const nlohmann::json& input, ScalarKind scalar);
/// "bspline_skin": the surface through input["sections"], which input["spine"], if it is given, carries along a curve
/// (in double).
[[nodiscard]] DescribedSurface describe_skin(const nlohmann::json& input, ScalarKind scalar);
/// Calls the function for the method's name. Throws DescriptionError.
[[nodiscard]] DescribedSurface describe_surface(std::string_view method, const nlohmann::json& input,
                                                ScalarKind scalar = ScalarKind::float64);

/// {"degree_u", "degree_v", "params_u", "params_v", "knots_u", "knots_v", "net", "samples"}, then the method's own
/// keys. params_u is null for a skin. `samples` has S and its derivatives at nine places.
[[nodiscard]] nlohmann::ordered_json surface_report(const DescribedSurface& surface);

/// The degree that `key` states, or the usual one for that many points. Throws DescriptionError if there are too few
/// points.
[[nodiscard]] int degree_in(const nlohmann::json& input, const char* key, std::size_t points, std::string_view what);

} // namespace splinefeed::host
