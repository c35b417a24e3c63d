// SPDX-License-Identifier: MIT
//
// A curve has no place, no size and no axis of its own, and hardly a direction.
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr Parameterization parameterizations[] = {Parameterization::uniform, Parameterization::chordal,
                                                  Parameterization::centripetal};

template <Scalar S>
std::vector<std::vector<CurveSegment<S>>> all_methods(const Path& path, Parameterization how) {
    const CurveOptions<S> options{path.axes, how, literal<S>(0.5)};
    G2Spline<S> g2(options);
    CatmullRom<S> catmull_rom(options, literal<S>(0.5));
    Polyline<S> polyline(options);
    const auto feeds = feeds_of<S>(path);
    return {run_curve<S>(g2, feeds), run_curve<S>(catmull_rom, feeds), run_curve<S>(polyline, feeds)};
}

/// Calls check(before, after) for each segment of each method on both paths.
template <Scalar S, class Check>
void compare(const Path& path, const Path& changed, Parameterization how, const Check& check) {
    const auto a = all_methods<S>(path, how);
    const auto b = all_methods<S>(changed, how);
    for (std::size_t method = 0; method < a.size(); ++method) {
        REQUIRE(a[method].size() == path.points.size() - 1);
        REQUIRE(b[method].size() == a[method].size());
        for (std::size_t i = 0; i < a[method].size(); ++i) {
            CAPTURE(method, i, static_cast<int>(how));
            check(a[method][i], b[method][i]);
        }
    }
}

} // namespace

TEMPLATE_TEST_CASE("curve: shifting the path changes no bit of the offsets", "[curve][invariance]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 40);
    CAPTURE(path_seed);
    for (const Shape shape : all_shapes) {
        for (const Parameterization how : parameterizations) {
            const Path path = random.make(shape, 3, 60);
            for (const double far : {1e6, -1e6, 123.456}) {
                Path shifted = path;
                const Position by[3] = {position_from_mm(far), position_from_mm(-far / 3.0), position_from_mm(far)};
                for (auto& point : shifted.points) {
                    for (unsigned k = 0; k < 3; ++k) {
                        point[k].raw += by[k].raw;
                    }
                }
                compare<S>(path, shifted, how, [](const auto& a, const auto& b) { REQUIRE(same_shape(a, b)); });
            }
        }
    }
}

TEMPLATE_TEST_CASE("curve: scaling by powers of two scales the curve", "[curve][invariance]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 41);
    CAPTURE(path_seed);
    for (const Shape shape : {Shape::uneven, Shape::helix, Shape::zigzag}) {
        for (const Parameterization how : parameterizations) {
            const Path path = random.make(shape, 3, 60);
            for (const int log2 : {2, 4, 6}) { // even, so that roots scale by a power of two, too
                Path scaled_path = path;
                for (auto& point : scaled_path.points) {
                    for (unsigned k = 0; k < 3; ++k) {
                        point[k].raw *= std::int64_t{1} << log2;
                    }
                }
                compare<S>(path, scaled_path, how, [&](const auto& a, const auto& b) {
                    for (int p = 0; p <= a.degree; ++p) {
                        if constexpr (std::same_as<S, Fixed>) {
                            // chord units are absolute: the smaller one has fewer bits, 3 mm moves and 32 roundings *
                            // 20
                            const Real error = distance_of(bezier(a, p), std::ldexp(1.0L, -log2) * bezier(b, p));
                            REQUIRE(static_cast<double>(error) <= 640.0 * static_cast<double>(rounding<S>(10.0L)));
                        } else { // every operation commutes with the scaling
                            REQUIRE(b.unit_log2 == a.unit_log2 + log2);
                            for (unsigned k = 0; k < 3; ++k) {
                                REQUIRE(a.control[k][static_cast<unsigned>(p)] ==
                                        b.control[k][static_cast<unsigned>(p)]);
                            }
                        }
                    }
                });
            }
        }
    }
}
