// SPDX-License-Identifier: MIT
// MethodTable: the methods that a description may name, and the functions that compute them.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/curve/methods/description.hpp"

namespace splinefeed::host {

/// A method's own results and its curve, computed from the "input" of a description. Throws DescriptionError.
template <Scalar S>
[[nodiscard]] DescribedCurve describe_catmull_rom(const nlohmann::json& input);
template <Scalar S>
[[nodiscard]] DescribedCurve describe_beta_chain(const nlohmann::json& input);
template <Scalar S>
[[nodiscard]] DescribedCurve describe_boehm(const nlohmann::json& input);
template <Scalar S>
[[nodiscard]] DescribedCurve describe_bspline_interpolation(const nlohmann::json& input);

template <Scalar S>
[[nodiscard]] DescribedCurve describe_catmull_rom_modified(const nlohmann::json& input);
template <Scalar S>
[[nodiscard]] DescribedCurve describe_ferguson(const nlohmann::json& input);

/// Names of the methods, as descriptions spell them.
[[nodiscard]] std::vector<std::string_view> described_methods();

/// The option name of --curve for a description's method: catmull_rom is catmull-rom, boehm is bspline.
[[nodiscard]] std::string curve_name_of(std::string_view method);

/// Computes the curve. Throws DescriptionError, also for an unknown method. `results` also gets `joints`, the measured
/// classes of continuity, and `warnings`, in addition to the method's own keys.
[[nodiscard]] DescribedCurve describe_curve(std::string_view method, const nlohmann::json& input, ScalarKind scalar);

} // namespace splinefeed::host
