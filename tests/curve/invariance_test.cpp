// SPDX-License-Identifier: MIT
//
// A curve has no place, no size and no axis of its own, and hardly a direction.
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "support/curve_harness.hpp"

#include <utility>

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

TEMPLATE_TEST_CASE("curve: axes may be exchanged and mirrored", "[curve][invariance]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 42);
    CAPTURE(path_seed);
    for (const Shape shape : all_shapes) {
        for (const Parameterization how : parameterizations) {
            const Path path = random.make(shape, 2, 60); // x^2 + y^2 = y^2 + x^2 to the last bit
            Path changed = path;
            for (auto& point : changed.points) {
                std::swap(point[0], point[1]);
                point[0].raw = -point[0].raw;
            }
            compare<S>(path, changed, how, [](const auto& a, const auto& b) {
                REQUIRE(a.unit_log2 == b.unit_log2);
                for (unsigned p = 0; p <= static_cast<unsigned>(a.degree); ++p) {
                    REQUIRE(a.control[0][p] == b.control[1][p]);
                    REQUIRE(a.control[1][p] == -b.control[0][p]);
                }
            });
            // An axis that never moves changes nothing.
            Path more = path;
            more.axes = 4;
            compare<S>(path, more, how, [](const auto& a, const auto& b) {
                REQUIRE(a.unit_log2 == b.unit_log2);
                for (unsigned p = 0; p <= static_cast<unsigned>(a.degree); ++p) {
                    REQUIRE(a.control[0][p] == b.control[0][p]);
                    REQUIRE(a.control[1][p] == b.control[1][p]);
                    REQUIRE(b.control[3][p] == S{});
                }
            });
        }
    }
}

TEMPLATE_TEST_CASE("curve: the reversed path has the reversed curve", "[curve][invariance]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 43);
    CAPTURE(path_seed);
    for (const Shape shape : {Shape::even, Shape::uneven, Shape::helix}) {
        for (const Parameterization how : parameterizations) {
            const Path path = random.make(shape, 3, 80);
            Path reversed = path;
            std::reverse(reversed.points.begin(), reversed.points.end());
            const auto a = all_methods<S>(path, how);
            const auto b = all_methods<S>(reversed, how);
            for (std::size_t method = 0; method < 3; ++method) {
                for (std::size_t i = 0; i < a[method].size(); ++i) {
                    const auto& there = a[method][i];
                    const auto& back = b[method][a[method].size() - 1 - i];
                    const Vec shift = origin_from(back, there.origin);
                    CAPTURE(method, i, static_cast<int>(how), static_cast<int>(shape));
                    for (int p = 0; p <= there.degree; ++p) {
                        const Real error = distance_of(bezier(there, p), shift + bezier(back, there.degree - p));
                        // rounding as against the batch solution; g2 also the truncation of its look-ahead: 0.35^13 of
                        // a few mm where spacing is uneven (nearly 1:20)
                        const Real truncation = method == 0 ? 5e-6L : 0.0L;
                        REQUIRE(static_cast<double>(error) <=
                                static_cast<double>(truncation + 640.0L * rounding<S>(5.0L)));
                    }
                }
            }
        }
    }
}
