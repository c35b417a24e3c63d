// SPDX-License-Identifier: MIT
//
// Reference vectors of the spline methods: cases with input, expected output and tolerance (tests/golden/README.md).
#pragma once

#include "host_sim/curve/methods/joint_report.hpp"
#include "host_sim/curve/methods/method_table.hpp"

#include <string>
#include <vector>

namespace splinefeed_test {

/// A file of tests/golden.
[[nodiscard]] nlohmann::json golden_set(const std::string& file);

/// What of a case's `expected` the curve does not give within the tolerances, a line each. `slack` widens them: the
/// error that another scalar is allowed, in units of the case's.
[[nodiscard]] std::vector<std::string> differences(const nlohmann::json& golden,
                                                   const splinefeed::host::DescribedCurve& curve, double slack = 1.0);

/// The largest error of a control point of a segment, relative to the case's scale.
[[nodiscard]] double control_error(const nlohmann::json& golden, const splinefeed::host::DescribedCurve& curve);

} // namespace splinefeed_test
