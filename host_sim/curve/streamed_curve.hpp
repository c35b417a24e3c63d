// SPDX-License-Identifier: MIT
// StreamedCurve: a curve that is made while its waypoints come, and the table of the methods that can. A new one is a
// function and a row in streamed_curve.cpp.
#pragma once

#include "host_sim/curve/methods/curve_choice.hpp"
#include "host_sim/curve/methods/curve_method.hpp"

#include "splinefeed/s1_curve/control_point_stream.hpp"
#include "splinefeed/s1_curve/waypoint_curve.hpp"

#include <memory>
#include <span>

namespace splinefeed::host {

template <Scalar S>
struct StreamedCurve {
    std::shared_ptr<WaypointCurve<S>> curve; ///< shared: it knows how to delete the curve, whose base does not
    std::size_t bytes = 0;                   ///< of the curve
};

/// Throws UsageError where the method cannot be told what was chosen.
template <Scalar S>
using MakeCurve = StreamedCurve<S> (*)(const CurveChoice& choice, const CurveOptions<S>& options,
                                       const EndTangents<S>& tangents);

struct StreamingMethod {
    CurveMethod method;
    MakeCurve<Fixed> fixed;
    MakeCurve<float> single;
    MakeCurve<double> dual;
};

[[nodiscard]] std::span<const StreamingMethod> streaming_methods() noexcept;

/// The curve of the method that was chosen. Throws UsageError, also for a method that does not stream.
template <Scalar S>
[[nodiscard]] StreamedCurve<S> streamed_curve(const CurveChoice& choice, const CurveOptions<S>& options,
                                              const EndTangents<S>& tangents);

} // namespace splinefeed::host
