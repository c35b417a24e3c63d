// SPDX-License-Identifier: MIT
// Each curve that streams: every bit of its Bezier segments, and of the motion along them.
#include "corpus.hpp"
#include "machines.hpp"
#include "random.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s1_curve/bspline_curve.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/g2_bezier.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "splinefeed/s1_curve/smoothed_curve.hpp"
#include "splinefeed/trajectory.hpp"

using namespace splinefeed;

namespace bits {
namespace {

constexpr int points = 40;

/// Passes the segments of a curve on, and hashes them.
template <Scalar S>
class HashedCurve final : public CurveSource<S> {
public:
    HashedCurve(CurveSource<S>& curve, Hash& hash) noexcept : curve_(&curve), hash_(&hash) {}

    Pull next(CurveSegment<S>& out) noexcept override {
        const Pull pull = curve_->next(out);
        if (pull == Pull::item) {
            hash_->add(out);
        }
        return pull;
    }

private:
    CurveSource<S>* curve_;
    Hash* hash_;
};

/// Plans a wandering path; `curve` takes its waypoints, `source` is what is planned: the curve, or what is made of it.
template <Scalar S>
void run_curve(const char* name, WaypointCurve<S>& curve, CurveSource<S>& source) {
    Hash hash;
    HashedCurve<S> hashed(source, hash);
    std::array<PlannedCell<S>, 32> window;
    AccelerationPlanner<S> planner(window);
    auto trajectory = Trajectory<S>::make(hashed, *uneven_limits<S>, planner);
    bool good = trajectory.has_value();
    Wandering<S> path(7, points);
    FeedSegment segment;
    for (Pull pull = Pull::starved; good && pull != Pull::finished; pull = trajectory->next(segment)) {
        if (pull == Pull::item) {
            hash.add(segment);
            continue;
        }
        while (good && !path.empty() && curve.has_room()) {
            good = curve.push(path.next()).ok();
        }
        if (good && path.empty()) {
            good = curve.finish().ok();
        }
    }
    report<S>(name, hash, good && trajectory->status().ok());
}

template <Scalar S>
void run_curve(const char* name, WaypointCurve<S>& curve) {
    run_curve<S>(name, curve, curve);
}

/// The same ring of waypoints before, on and after the path: a closed curve.
template <Scalar S>
void run_closed(const char* name, WaypointCurve<S>& curve) {
    constexpr std::int64_t ring[][2] = {{0, 0},          {21000, 3000},   {38000, 14000}, {41000, 33000},
                                        {30000, 47000},  {9000, 52000},   {-9500, 40000}, {-20000, 28000},
                                        {-24000, 12000}, {-13000, -1000}, {-6000, -1200}};
    constexpr int size = static_cast<int>(std::size(ring));
    Hash hash;
    bool good = true;
    CurveSegment<S> segment;
    for (int i = -size; i <= 2 * size;) {
        if (const Pull pull = curve.next(segment); pull == Pull::item) {
            hash.add(segment);
            continue;
        }
        const auto& at = ring[(i + size) % size];
        Waypoint<S> waypoint;
        waypoint.position[0] = position_from_um(at[0]);
        waypoint.position[1] = position_from_um(at[1]);
        good = curve.push(waypoint, i < 0 ? Role::lead_in : i > size ? Role::lead_out : Role::path).ok() && good;
        ++i;
    }
    good = curve.finish().ok() && good;
    while (curve.next(segment) == Pull::item) {
        hash.add(segment);
    }
    report<S>(name, hash, good);
}

template <Scalar S>
CurveOptions<S> spaced(Parameterization how) {
    CurveOptions<S> options;
    options.parameterization = how;
    return options;
}

} // namespace

template <Scalar S>
void run_curves() {
    const CurveOptions<S> options;
    {
        G2Spline<S> curve(options);
        run_curve<S>("curve g2", curve);
    }
    {
        G2Spline<S> curve(spaced<S>(Parameterization::centripetal));
        run_curve<S>("curve g2 centripetal", curve);
    }
    {
        G2Spline<S> curve(options);
        run_closed<S>("curve g2 closed", curve);
    }
    {
        BetaJoints<S> joints;
        joints.span_ratio = false;
        joints.beta1 = literal<S>(1.25);
        joints.beta2 = literal<S>(3.0);
        G2Bezier<S> curve(options, joints);
        run_curve<S>("curve g2-bezier", curve);
    }
    {
        CatmullRom<S> curve(spaced<S>(Parameterization::uniform), literal<S>(0.5));
        run_curve<S>("curve catmull-rom", curve);
    }
    {
        CatmullRom<S> curve(spaced<S>(Parameterization::centripetal), literal<S>(0.5));
        run_curve<S>("curve catmull-rom centripetal", curve);
    }
    {
        CatmullRomModified<S> curve(options, literal<S>(1.0));
        run_curve<S>("curve catmull-rom-modified", curve);
    }
    {
        BSplineCurve<S> curve(options, 2);
        run_curve<S>("curve bspline 2", curve);
    }
    {
        BSplineCurve<S> curve(options, 3);
        run_curve<S>("curve bspline 3", curve);
    }
    {
        Polyline<S> curve(options);
        run_curve<S>("curve polyline", curve);
    }
    {
        CatmullRom<S> inner(spaced<S>(Parameterization::chordal), literal<S>(0.5));
        SmoothedCurve<S> curve(inner);
        run_curve<S>("curve smoothed", inner, curve);
    }
}

template void run_curves<Fixed>();
template void run_curves<float>();
template void run_curves<double>();

} // namespace bits
