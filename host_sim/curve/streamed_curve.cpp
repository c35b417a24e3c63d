// SPDX-License-Identifier: MIT
#include "host_sim/curve/streamed_curve.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/s1_curve/bspline_curve.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/g2_bezier.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"

#include <array>

namespace splinefeed::host {

namespace {

template <class Curve, Scalar S, class... Arguments>
StreamedCurve<S> made(const CurveOptions<S>& options, const Arguments&... arguments) {
    return {std::make_shared<Curve>(options, arguments...), sizeof(Curve)};
}

template <Scalar S>
StreamedCurve<S> make_g2(const CurveChoice& /*choice*/, const CurveOptions<S>& options,
                         const EndTangents<S>& tangents) {
    return made<G2Spline<S>>(options, tangents);
}

template <Scalar S>
StreamedCurve<S> make_g2_bezier(const CurveChoice& choice, const CurveOptions<S>& options,
                                const EndTangents<S>& tangents) {
    BetaJoints<S> joints;
    joints.span_ratio = !choice.beta1.has_value();
    joints.beta1 = from_double<S>(choice.beta1.value_or(1.0));
    joints.beta2 = from_double<S>(choice.beta2);
    if (const Status status = joints.check(); !status.ok()) {
        throw UsageError("--curve g2-bezier: {}", describe(status.error()));
    }
    return made<G2Bezier<S>>(options, joints, tangents);
}

template <Scalar S>
StreamedCurve<S> make_catmull_rom(const CurveChoice& choice, const CurveOptions<S>& options,
                                  const EndTangents<S>& /*tangents*/) {
    return made<CatmullRom<S>>(options, from_double<S>(choice.tension));
}

template <Scalar S>
StreamedCurve<S> make_catmull_rom_modified(const CurveChoice& choice, const CurveOptions<S>& options,
                                           const EndTangents<S>& /*tangents*/) {
    if (!choice.constant_factor && choice.tension > 2.0) {
        throw UsageError("--tension of catmull-rom-modified is at most 2 (a length in mm with --factor constant)");
    }
    const ChordFactor factor = choice.constant_factor ? ChordFactor::constant : ChordFactor::chord;
    return made<CatmullRomModified<S>>(options, from_double<S>(choice.tension), factor);
}

template <Scalar S>
StreamedCurve<S> make_bspline(const CurveChoice& choice, const CurveOptions<S>& options,
                              const EndTangents<S>& /*tangents*/) {
    return made<BSplineCurve<S>>(options, choice.degree);
}

template <Scalar S>
StreamedCurve<S> make_polyline(const CurveChoice& /*choice*/, const CurveOptions<S>& options,
                               const EndTangents<S>& /*tangents*/) {
    return made<Polyline<S>>(options);
}

/// One row per method: a new one adds its own.
constexpr std::array streaming{
    StreamingMethod{{.name = "g2", .takes = takes_parameterization | takes_corners | takes_tangents},
                    make_g2<Fixed>,
                    make_g2<float>,
                    make_g2<double>},
    StreamingMethod{{.name = "g2-bezier", .takes = takes_betas | takes_corners | takes_tangents},
                    make_g2_bezier<Fixed>,
                    make_g2_bezier<float>,
                    make_g2_bezier<double>},
    StreamingMethod{{.name = "catmull-rom",
                     .takes = takes_parameterization | takes_tension | takes_corners | takes_smooth,
                     .usual = Parameterization::centripetal},
                    make_catmull_rom<Fixed>,
                    make_catmull_rom<float>,
                    make_catmull_rom<double>},
    StreamingMethod{{.name = "catmull-rom-modified",
                     .takes = takes_tension | takes_factor | takes_corners | takes_smooth,
                     .usual_tension = 1.0,
                     .highest_tension = 65536.0}, // with --factor constant it is a length
                    make_catmull_rom_modified<Fixed>,
                    make_catmull_rom_modified<float>,
                    make_catmull_rom_modified<double>},
    StreamingMethod{{.name = "bspline",
                     .takes = takes_degree | takes_corners | takes_smooth,
                     .usual = Parameterization::uniform,
                     .lowest_degree = 2,
                     .usual_corner_angle_deg = 180.0, // control points turn sharply where the curve does not
                     .passes_waypoints = false},
                    make_bspline<Fixed>,
                    make_bspline<float>,
                    make_bspline<double>},
    StreamingMethod{{.name = "polyline", .takes = takes_tolerance},
                    make_polyline<Fixed>,
                    make_polyline<float>,
                    make_polyline<double>},
};

} // namespace

std::span<const StreamingMethod> streaming_methods() noexcept {
    return streaming;
}

template <Scalar S>
StreamedCurve<S> streamed_curve(const CurveChoice& choice, const CurveOptions<S>& options,
                                const EndTangents<S>& tangents) {
    for (const StreamingMethod& row : streaming) {
        if (row.method.name == choice.method) {
            if constexpr (std::same_as<S, Fixed>) {
                return row.fixed(choice, options, tangents);
            } else if constexpr (std::same_as<S, float>) {
                return row.single(choice, options, tangents);
            } else {
                return row.dual(choice, options, tangents);
            }
        }
    }
    throw UsageError("--curve {} does not stream", choice.method);
}

template StreamedCurve<double> streamed_curve(const CurveChoice&, const CurveOptions<double>&,
                                              const EndTangents<double>&);
template StreamedCurve<float> streamed_curve(const CurveChoice&, const CurveOptions<float>&, const EndTangents<float>&);
template StreamedCurve<Fixed> streamed_curve(const CurveChoice&, const CurveOptions<Fixed>&, const EndTangents<Fixed>&);

} // namespace splinefeed::host
