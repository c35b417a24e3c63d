// SPDX-License-Identifier: MIT
// LoopedCurve: a G2 curve through as many waypoints as asked for, which come as the curve asks for them.
#pragma once

#include "raster.hpp"

#include "splinefeed/s1_curve/g2_spline.hpp"

#include <cstdint>
#include <cstdlib>

namespace bench {

template <splinefeed::Scalar S>
class LoopedCurve final : public splinefeed::CurveSource<S> {
public:
    explicit LoopedCurve(std::int64_t waypoints) : left_(waypoints), curve_(splinefeed::CurveOptions<S>{}) {}

    splinefeed::Pull next(splinefeed::CurveSegment<S>& out) noexcept override {
        for (;;) {
            const splinefeed::Pull pull = curve_.next(out);
            if (pull != splinefeed::Pull::starved) {
                return pull;
            }
            const bool pushed = left_ > 0 ? curve_.push(point(pushed_++)).ok() : curve_.finish().ok();
            --left_;
            if (!pushed) {
                std::abort();
            }
        }
    }

private:
    /// A loop of 221 mm with five lobes, over and over: 200 waypoints, 0.2 to 1.7 mm apart.
    static splinefeed::Waypoint<S> point(std::int64_t i) {
        const double t = 6.283185307179586 / 200.0 * static_cast<double>(i % 200);
        return waypoint<S>(30.0 * std::cos(t) + 6.0 * std::cos(4.0 * t), 30.0 * std::sin(t) - 6.0 * std::sin(4.0 * t),
                           2.0 * std::sin(2.0 * t));
    }

    std::int64_t left_;
    std::int64_t pushed_ = 0;
    splinefeed::G2Spline<S> curve_;
};

} // namespace bench
