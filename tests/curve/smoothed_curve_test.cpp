// SPDX-License-Identifier: MIT
//
// SmoothedCurve: joints G2 as measured, on every C1 source; corners, ends and lines left alone; near the source.
#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/jet.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Delivers segments that are there.
template <Scalar S>
class Replay final : public CurveSource<S> {
public:
    explicit Replay(std::vector<CurveSegment<S>> segments) : segments_(std::move(segments)) {}
    Pull next(CurveSegment<S>& out) noexcept override {
        if (next_ == segments_.size()) {
            return Pull::finished;
        }
        out = segments_[next_++];
        return Pull::item;
    }

private:
    std::vector<CurveSegment<S>> segments_;
    std::size_t next_ = 0;
};

template <Scalar S>
std::vector<CurveSegment<S>> smoothed(const std::vector<CurveSegment<S>>& source, Seam seam = Seam::open) {
    Replay<S> replay(source);
    SmoothedCurve<S> curve(replay, seam);
    std::vector<CurveSegment<S>> out;
    drain<S>(curve, out);
    CurveSegment<S> none;
    REQUIRE(curve.next(none) == Pull::finished);
    return out;
}

struct Bend {
    Vec point, direction, curvature;
    Real leg;
};

template <Scalar S>
Bend bend_at(const CurveSegment<S>& segment, bool at_end) {
    const int n = segment.degree;
    const auto p = [&](int i) {
        return bezier(segment, at_end ? n - i : i);
    };
    const Real sign = at_end ? -1.0L : 1.0L;
    const Vec d1 = (sign * static_cast<Real>(n)) * (p(1) - p(0));
    const Vec d2 = n < 2 ? Vec{} : static_cast<Real>(n * (n - 1)) * (p(2) - 2.0L * p(1) + p(0));
    const Real square = dot(d1, d1);
    return {p(0), (1.0L / size(d1)) * d1, (1.0L / square) * (d2 - (dot(d1, d2) / square) * d1), size(d1)};
}

/// Curvature jump of a joint, relative to the curvature or to what a turn of 2^-10 over the shorter tangent would be.
template <Scalar S>
Real jump_of(const CurveSegment<S>& a, const CurveSegment<S>& b) {
    const Bend in = bend_at(a, true);
    const Bend out = bend_at(b, false);
    const Real floor = 0x1p-10L / std::min(in.leg, out.leg);
    return distance_of(in.curvature, out.curvature) / std::max({size(in.curvature), size(out.curvature), floor});
}

/// Bezier points carry the rounding of their segment's size; the second derivative takes 40 of those over the square of
/// the tangent, which is at least a tenth of the segment in these paths. Measured: double 2e-14, float 1e-5, Fixed
/// 6e-10.
template <Scalar S>
Real jump_bound() {
    return std::same_as<S, double> ? 1e-12L : std::same_as<S, float> ? 1e-3L : 2e-8L;
}

enum class Kind : std::uint8_t { uniform, centripetal, modified, constant };

template <Scalar S>
std::vector<CurveSegment<S>> source_of(Kind kind, const std::vector<Feed<S>>& feeds, int axes, bool seam_segments) {
    CurveOptions<S> options{axes, Parameterization::uniform, literal<S>(0.5), 65536, seam_segments};
    if (kind == Kind::uniform || kind == Kind::centripetal) {
        options.parameterization = kind == Kind::uniform ? Parameterization::uniform : Parameterization::centripetal;
        CatmullRom<S> curve(options, literal<S>(0.5));
        return run_curve<S>(curve, feeds);
    }
    CatmullRomModified<S> curve(options, literal<S>(1),
                                kind == Kind::modified ? ChordFactor::chord : ChordFactor::constant);
    return run_curve<S>(curve, feeds);
}

Vec point_on(const CurveSegment<double>& segment, double u) {
    Jet<double> jet;
    evaluate(segment, u, jet);
    Vec out{};
    for (const unsigned k : indices(segment.axes)) {
        out[k] = std::ldexp(static_cast<Real>(jet.position[k]), segment.unit_log2);
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("smoothed curve: joints are G2, measured", "[curve][smoothed_curve]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 70);
    CAPTURE(path_seed);
    int joints = 0;
    for (const Shape shape : {Shape::even, Shape::uneven, Shape::helix}) {
        for (const Kind kind : {Kind::uniform, Kind::centripetal, Kind::modified, Kind::constant}) {
            const int axes = 2 + random.below(4);
            const Path path = random.make(shape, axes, 60);
            auto feeds = feeds_of<S>(path);
            feeds[20].point.corner = Corner::forced;
            const auto source = source_of(kind, feeds, axes, false);
            const auto out = smoothed(source);
            REQUIRE(out.size() == source.size());
            Real before = 0.0L;
            for (std::size_t i = 0; i < out.size(); ++i) {
                CAPTURE(static_cast<int>(shape), static_cast<int>(kind), i);
                REQUIRE(out[i].stop_at_end == source[i].stop_at_end);
                REQUIRE(out[i].waypoint == source[i].waypoint);
                REQUIRE(out[i].degree == 5);
                const Real length = size(bezier(source[i], 3));
                REQUIRE(distance_of(bezier(out[i], 5), bezier(source[i], 3)) <= 2.0L * rounding<S>(length));
                if (i + 1 == out.size() || out[i].stop_at_end) {
                    continue;
                }
                before = std::max(before, jump_of(source[i], source[i + 1]));
                const Real jump = jump_of(out[i], out[i + 1]);
                ++joints;
                REQUIRE(jump <= jump_bound<S>());
                const Bend in = bend_at(out[i], true);
                const Bend next = bend_at(out[i + 1], false);
                REQUIRE(distance_of(in.direction, next.direction) <= 200.0L * unit_roundoff<S>());
                // The tangents' lengths are the source's.
                REQUIRE(static_cast<double>(in.leg / bend_at(source[i], true).leg) == Approx(1.0).epsilon(1e-5));
            }
            REQUIRE(before > 1e-3L); // there was something to do
        }
    }
    REQUIRE(joints > 500);
}

TEMPLATE_TEST_CASE("smoothed curve: a closed curve is G2 at its seam, too", "[curve][smoothed_curve]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 71);
    for (const Kind kind : {Kind::uniform, Kind::centripetal, Kind::modified, Kind::constant}) {
        Path path{2, {}};
        for (int i = 0; i < 9; ++i) {
            const double angle = 0.7 * i;
            const double radius = random.between(8.0, 12.0);
            path.points.push_back(
                {position_from_mm(radius * std::cos(angle)), position_from_mm(radius * std::sin(angle))});
        }
        auto points = waypoints_of<S>(path);
        for (auto& point : points) {
            point.corner = Corner::forbidden;
        }
        const auto plain = source_of(kind, closed_feeds(points), 2, false);
        const auto with_seam = source_of(kind, closed_feeds(points), 2, true);
        REQUIRE(plain.size() == 9);
        REQUIRE(with_seam.size() == 11);
        REQUIRE(same_shape(with_seam[0], plain[8]));
        REQUIRE(same_shape(with_seam[10], plain[0]));
        const auto out = smoothed(with_seam, Seam::repeated);
        REQUIRE(out.size() == 9);
        for (std::size_t i = 0; i < 9; ++i) {
            CAPTURE(static_cast<int>(kind), i);
            REQUIRE(out[i].waypoint == plain[i].waypoint);
            REQUIRE(jump_of(out[i], out[(i + 1) % 9]) <= jump_bound<S>());
        }
        REQUIRE(jump_of(plain[8], plain[0]) > 1e-3L);
    }
}

TEST_CASE("smoothed curve: what is left alone", "[curve][smoothed_curve]") {
    // A polyline with corners: bit by bit, also past a collinear waypoint.
    Polyline<double> polyline({2, Parameterization::chordal, 0.5, 65536});
    const auto lines = run_curve<double>(polyline, feeds_of<double>(path_of(2, {0, 0, 1, 1, 3, 3, 5, 0, 9, 0})));
    REQUIRE(same_curve(smoothed(lines), lines));
    // The outer ends keep their curvature; a single segment is passed on.
    RandomPath random(path_seed + 72);
    const auto source =
        source_of<double>(Kind::centripetal, feeds_of<double>(random.make(Shape::uneven, 3, 12)), 3, false);
    const auto out = smoothed(source);
    REQUIRE(static_cast<double>(distance_of(bend_at(out[0], false).curvature, bend_at(source[0], false).curvature)) <
            1e-12);
    REQUIRE(static_cast<double>(
                distance_of(bend_at(out.back(), true).curvature, bend_at(source.back(), true).curvature)) < 1e-12);
    const std::vector<CurveSegment<double>> one{source[3]};
    REQUIRE(same_curve(smoothed(one), one));
    REQUIRE(smoothed(std::vector<CurveSegment<double>>{}).empty());
    // A kink without a stop, and tangents that vanish (tension 0).
    CatmullRom<double> polygon({2, Parameterization::uniform, -1.0, 65536}, 0.0);
    const auto cusps = run_curve<double>(polygon, feeds_of<double>(path_of(2, {0, 0, 1, 0, 2, 1, 2, 3})));
    REQUIRE(same_curve(smoothed(cusps), cusps));
    auto kinked = lines;
    for (auto& segment : kinked) {
        segment.stop_at_end = false;
    }
    REQUIRE(same_curve(smoothed(kinked), kinked));
}

// K = (n_a^2 K_a + n_b^2 K_b)/(n_a^2 + n_b^2): by curves whose own ends are known, and the deviation that follows.
TEST_CASE("smoothed curve: the weighted mean, and how far it moves the curve", "[curve][smoothed_curve]") {
    RandomPath random(path_seed + 73);
    double farthest = 0.0;
    for (int round = 0; round < 40; ++round) {
        const Shape shape = round % 2 == 0 ? Shape::uneven : Shape::very_uneven;
        const Kind kind = round % 4 < 2 ? Kind::centripetal : Kind::modified;
        const auto source = source_of<double>(kind, feeds_of<double>(random.make(shape, 3, 40)), 3, false);
        const auto out = smoothed(source);
        std::vector<Real> moves(source.size() + 1, 0.0L); // at joint i, of both segments
        for (std::size_t i = 0; i + 1 < source.size(); ++i) {
            if (source[i].stop_at_end) {
                continue;
            }
            const Bend a = bend_at(source[i], true);
            const Bend b = bend_at(source[i + 1], false);
            const Real wa = a.leg * a.leg;
            const Real wb = b.leg * b.leg;
            const Vec mean = (1.0L / (wa + wb)) * (wa * a.curvature + wb * b.curvature);
            CAPTURE(round, i);
            REQUIRE(static_cast<double>(distance_of(bend_at(out[i], true).curvature, mean)) <=
                    1e-8 * static_cast<double>(size(a.curvature) + size(b.curvature)) + 1e-9);
            moves[i + 1] = wa * wb / (wa + wb) * distance_of(a.curvature, b.curvature);
        }
        for (std::size_t i = 0; i < source.size(); ++i) {
            const Real allowed = 0.018L * (moves[i] + moves[i + 1]);
            for (int j = 0; j <= 32; ++j) {
                const Real moved = distance_of(point_on(source[i], j / 32.0), point_on(out[i], j / 32.0));
                CAPTURE(round, i, j);
                REQUIRE(static_cast<double>(moved) <= static_cast<double>(allowed) + 1e-12);
                farthest = std::max(farthest, static_cast<double>(moved / size(bezier(source[i], source[i].degree))));
            }
        }
    }
    REQUIRE(farthest < 0.1); // 0.051 of the chord measured
}

// A long line beside a small arc: the line hardly moves.
TEST_CASE("smoothed curve: segments of very different size", "[curve][smoothed_curve]") {
    CurveSegment<double> line;
    line.axes = 2;
    line.degree = 1;
    PerAxis<PerDegree<double>> offsets{};
    offsets[0] = {0.0, 4096.0 * 100.0};
    line.assign(offsets);
    CurveSegment<double> arc;
    arc.axes = 2;
    arc.degree = 3;
    arc.origin[0] = position_from_mm(100.0);
    offsets = {};
    offsets[0] = {0.0, 4096.0 * 0.5523, 4096.0, 4096.0};
    offsets[1] = {0.0, 0.0, 4096.0 * (1.0 - 0.5523), 4096.0};
    arc.assign(offsets);
    const auto out = smoothed<double>({line, arc});
    REQUIRE(static_cast<double>(jump_of(out[0], out[1])) < 1e-9);
    for (int j = 0; j <= 16; ++j) {
        REQUIRE(std::fabs(static_cast<double>(point_on(out[0], j / 16.0)[1])) < 0.06);
    }
}
