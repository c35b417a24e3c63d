// SPDX-License-Identifier: MIT
// Each curve of all points at once, and the surface through a grid.
#include "corpus.hpp"
#include "random.hpp"
#include "splinefeed/splines/beta_chain.hpp"
#include "splinefeed/splines/ferguson.hpp"
#include "splinefeed/splines/g2_bezier.hpp"
#include "splinefeed/surfaces/surface_interpolation.hpp"

using namespace splinefeed;

namespace bits {
namespace {

constexpr std::size_t count = 24;

template <Scalar S>
Point<S> random_point(Random& random, std::size_t i) {
    Point<S> out{};
    for (unsigned k = 0; k < axes; ++k) {
        const auto onwards = static_cast<std::int32_t>(k == 0 ? i << 13 : 0U);
        out[k] = scale2(from_integer<S>(onwards + random.below(1 << 14)), -10);
    }
    return out;
}

template <Scalar S>
std::array<Point<S>, count> random_points(std::uint64_t seed) {
    Random random(seed);
    std::array<Point<S>, count> out{};
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = random_point<S>(random, i);
    }
    return out;
}

template <Scalar S>
void run_interpolation(const char* name, int degree) {
    const auto points = random_points<S>(3);
    const InterpolationKind kind{degree};
    std::array<S, count> parameters{};
    std::array<S, count + 6> knots{};
    std::array<S, 512> entries{};
    std::array<Point<S>, count> controls{};
    const std::span<S> used_knots(knots.data(), kind.knots(count));
    bool good = kind.band(count).entries() <= entries.size();
    good =
        good &&
        spline_parameters<S>(points, axes, Parameterization::centripetal, false, from_integer<S>(64), parameters).ok();
    good = good && open_knots<S>(KnotRule::average, parameters, degree, false, used_knots).ok();
    BsplineInterpolation<S> system;
    good = good && system.prepare(kind, parameters, used_knots, entries, {}).ok();
    good = good && system.interpolate(points, nullptr, axes, controls).ok();
    Hash hash;
    for (const Point<S>& control : controls) {
        hash.add_point<S>(control);
    }
    report<S>(name, hash, good);
}

template <Scalar S>
void run_ferguson() {
    const auto points = random_points<S>(4);
    Random random(5);
    std::array<FergusonJoint<S>, count - 2> joints{};
    for (auto& joint : joints) {
        joint.lambda = scale2(from_integer<S>(48 + random.below(32)), -6);
        joint.mu = scale2(from_integer<S>(random.below(64)), -6);
    }
    FergusonInput<S> input{points, joints};
    estimate_end_tangents<S>(points, joints, input.start_tangent, input.end_tangent);
    std::array<Point<S>, count> in{};
    std::array<Point<S>, count> out{};
    std::array<BezierPiece<S>, count> pieces{};
    std::array<CyclicRow<S>, count> rows{};
    FergusonReport<S> measured;
    const bool good = ferguson<S>(input, {in, out, pieces, rows}, measured).ok();
    Hash hash;
    for (std::size_t i = 0; i < measured.segments; ++i) {
        hash.add(pieces[i]);
    }
    hash.add_scalar(measured.condition);
    report<S>("spline ferguson", hash, good);
}

template <Scalar S>
void run_g2_bezier() {
    const auto points = random_points<S>(9);
    std::array<S, count * axes> coordinates{};
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        coordinates[i] = points[i / axes][i % axes];
    }
    G2BezierJoint<S> joint;
    joint.beta2 = literal<S>(1.5);
    G2BezierInput<S> input;
    input.coordinates = coordinates;
    input.joints = std::span<const G2BezierJoint<S>>(&joint, 1);
    std::array<S, count * axes> tangents{};
    std::array<S, count> scratch{};
    std::array<BezierPiece<S>, count - 1> pieces{};
    const bool good =
        g2_bezier_tangents<S>(input, tangents, scratch).ok() && g2_bezier_pieces<S>(input, tangents, pieces).ok();
    Hash hash;
    for (const auto& piece : pieces) {
        hash.add(piece);
    }
    report<S>("spline g2-bezier", hash, good);
}

template <Scalar S>
void run_beta_chain() {
    Random random(6);
    std::array<Point<S>, 4> first{};
    std::array<Point<S>, 8> free{};
    std::array<Beta<S>, 8> betas{};
    for (std::size_t i = 0; i < first.size(); ++i) {
        first[i] = random_point<S>(random, i);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
        free[i] = random_point<S>(random, i + first.size());
        betas[i] = {scale2(from_integer<S>(48 + random.below(48)), -6),
                    scale2(from_integer<S>(random.below(129) - 64), -6)};
    }
    std::array<BezierPiece<S>, 9> pieces{};
    std::array<BetaJoint<S>, 8> joints{};
    const bool good = beta_chain<S>({3, 2, false, first, free, betas}, pieces, joints).ok();
    Hash hash;
    for (const auto& piece : pieces) {
        hash.add(piece);
    }
    report<S>("spline beta-chain", hash, good);
}

template <Scalar S>
void run_surface() {
    constexpr std::size_t rows = 6;
    constexpr std::size_t columns = 7;
    constexpr SurfaceKind kind{};
    Random random(8);
    std::array<Point<S>, rows * columns> grid{};
    for (std::size_t i = 0; i < grid.size(); ++i) {
        grid[i][0] = scale2(from_integer<S>(static_cast<std::int32_t>(i / columns) * 4096 + random.below(1024)), -9);
        grid[i][1] = scale2(from_integer<S>(static_cast<std::int32_t>(i % columns) * 4096 + random.below(1024)), -9);
        grid[i][2] = scale2(from_integer<S>(random.below(8192)), -9);
    }
    std::array<S, rows> parameters_u{};
    std::array<S, columns> parameters_v{};
    std::array<S, rows + 4> knots_u{};
    std::array<S, columns + 4> knots_v{};
    std::array<Point<S>, rows * columns> net{};
    std::array<S, kind.entries(rows, columns)> entries{};
    std::array<Point<S>, columns> row{};
    std::array<S, columns> row_parameters{};
    const auto surface =
        interpolate_surface<S>({axes, rows, columns, grid}, kind, from_integer<S>(16), from_integer<S>(16),
                               {parameters_u, parameters_v, knots_u, knots_v, net, entries, row, row_parameters});
    bool good = surface.has_value();
    Hash hash;
    for (int i = 0; good && i <= 16; ++i) {
        const S at = from_integer<S>(i);
        const SurfaceJet<S> jet = evaluate(*surface, at, from_integer<S>(i * 5 % 17));
        const auto normal = normal_of(*surface, jet, i == 16, i * 5 % 17 == 16);
        good = normal.has_value();
        for (const Point<S>* part : {&jet.position, &jet.u, &jet.v, &jet.uu, &jet.uv, &jet.vv}) {
            hash.add_point<S>(*part);
        }
        if (good) {
            hash.add_point<S>(normal->direction);
        }
    }
    report<S>("surface", hash, good);
}

} // namespace

template <Scalar S>
void run_splines() {
    run_interpolation<S>("spline bspline-interpolation 3", 3);
    run_interpolation<S>("spline bspline-interpolation 5", 5);
    run_ferguson<S>();
    run_g2_bezier<S>();
    run_beta_chain<S>();
    run_surface<S>();
}

template void run_splines<Fixed>();
template void run_splines<float>();
template void run_splines<double>();

} // namespace bits
