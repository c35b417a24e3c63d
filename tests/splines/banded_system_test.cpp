// SPDX-License-Identifier: MIT
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
struct Stored {
    std::vector<S> entries;
    std::vector<std::uint8_t> interchanges;
    BandedSystem<S> system;
    explicit Stored(const BandShape& shape)
        : entries(shape.entries()), interchanges(shape.interchanges()), system(shape, entries, interchanges) {}
};

template <Scalar S>
S weight_of(double value) {
    return from_double<S>(std::ldexp(value, weight_log2<S>));
}

bool near(std::size_t i, std::size_t j, const BandShape& shape) {
    const std::size_t apart = i > j ? i - j : j - i;
    return apart <= shape.width || (shape.cyclic && shape.size - apart <= shape.width);
}

} // namespace

TEMPLATE_TEST_CASE("banded elimination solves what dense elimination solves", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(99);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int solved = 0;
    for (const std::size_t size : {1U, 2U, 3U, 4U, 7U, 8U, 20U, 21U}) {
        for (const std::size_t width : {0U, 1U, 2U, 4U}) {
            for (const bool cyclic : {false, true}) {
                for (const Elimination how : {Elimination::in_order, Elimination::pivoting}) {
                    const BandShape shape{size, width, cyclic, how};
                    Stored<S> stored(shape);
                    Matrix a(size, std::vector<Real>(size));
                    const double share = 1.0 / (2.0 * static_cast<double>(width) + 2.0);
                    for (std::size_t i = 0; i < size; ++i) {
                        for (std::size_t j = 0; j < size; ++j) {
                            if (!near(i, j, shape)) {
                                continue;
                            }
                            // Without pivoting the diagonal must be strong; with it, it may be nothing at all.
                            double value = std::ldexp(std::round(std::ldexp(share * unit(random), 12)), -12);
                            value += how == Elimination::in_order && i == j ? 1.0 : 0.0;
                            a[i][j] = static_cast<Real>(value);
                            stored.system.add(i, j, weight_of<S>(value));
                        }
                    }
                    CAPTURE(size, width, cyclic, static_cast<int>(how));
                    const Real condition = condition_of(a);
                    const Status status = stored.system.factor();
                    if (!(condition < 1e4L)) {
                        continue; // by chance; the seed is fixed
                    }
                    REQUIRE(status.ok());
                    ++solved;
                    // Two right-hand sides in one array, every other entry each.
                    std::vector<Point<S>> values(2U * size + 1U);
                    Matrix b(size, std::vector<Real>(4));
                    for (std::size_t i = 0; i < size; ++i) {
                        for (unsigned c = 0; c < 4; ++c) {
                            const double x = std::round(1000.0 * unit(random));
                            b[i][c] = static_cast<Real>(x);
                            values[1U + 2U * i - (c < 2 ? 0U : 1U)][c % 2U] = from_double<S>(x);
                        }
                    }
                    REQUIRE(stored.system.solve(values, 2, 1, 2).ok());
                    REQUIRE(stored.system.solve(std::span(values), 2, 0, 2).ok());
                    dense_solve(a, b);
                    Real largest_unknown = 0.0L;
                    for (const auto& row : b) {
                        for (const Real x : row) {
                            largest_unknown = std::max(largest_unknown, std::abs(x));
                        }
                    }
                    const Real eps = std::same_as<S, double> ? 0x1p-53L : std::same_as<S, float> ? 0x1p-24L : 0x1p-44L;
                    const Real bound =
                        condition * (largest_unknown * 20.0L * eps + (std::same_as<S, Fixed> ? 0x1p-26L : 0.0L));
                    for (std::size_t i = 0; i < size; ++i) {
                        for (unsigned c = 0; c < 4; ++c) {
                            const auto x =
                                static_cast<Real>(to_double(values[1U + 2U * i - (c < 2 ? 0U : 1U)][c % 2U]));
                            REQUIRE(static_cast<double>(std::abs(x - b[i][c])) <= static_cast<double>(bound));
                        }
                    }
                }
            }
        }
    }
    REQUIRE(solved > 100);
}

TEMPLATE_TEST_CASE("singular systems and results out of range are refused", "[splines]", double, float, Fixed) {
    using S = TestType;
    {
        Stored<S> stored({3, 1, false, Elimination::in_order}); // a zero pivot
        stored.system.add(0, 1, weight_of<S>(1.0));
        stored.system.add(1, 0, weight_of<S>(1.0));
        stored.system.add(2, 2, weight_of<S>(1.0));
        REQUIRE(stored.system.factor().error() == Error::system_singular);
    }
    {
        Stored<S> stored({3, 1, false, Elimination::pivoting}); // the same, no obstacle
        stored.system.add(0, 1, weight_of<S>(1.0));
        stored.system.add(1, 0, weight_of<S>(1.0));
        stored.system.add(2, 2, weight_of<S>(1.0));
        REQUIRE(stored.system.factor().ok());
    }
    {
        Stored<S> stored({4, 1, true, Elimination::pivoting}); // (1, 1) around: alternating values are its kernel
        for (std::size_t i = 0; i < 4; ++i) {
            stored.system.add(i, i, weight_of<S>(0.5));
            stored.system.add(i, (i + 1U) % 4U, weight_of<S>(0.5));
        }
        REQUIRE(stored.system.factor().error() == Error::system_singular);
    }
    {
        Stored<S> stored({2, 1, false, Elimination::pivoting});
        const double nearly = std::same_as<S, float> ? 0.0078125 : 0.000244140625;
        stored.system.add(0, 0, weight_of<S>(1.0));
        stored.system.add(0, 1, weight_of<S>(1.0));
        stored.system.add(1, 0, weight_of<S>(1.0));
        stored.system.add(1, 1, weight_of<S>(1.0 + nearly));
        REQUIRE(stored.system.factor().ok());
        std::vector<Point<S>> values(2);
        const double far = std::same_as<S, Fixed> ? 0x1p27 : 0.9 * to_double(largest<S>());
        values[0][0] = from_double<S>(far);
        values[1][0] = from_double<S>(-far);
        REQUIRE(stored.system.solve(values, 1).error() == Error::result_out_of_range);
        if constexpr (!std::same_as<S, Fixed>) {
            values[0][0] = std::numeric_limits<S>::quiet_NaN();
            REQUIRE(stored.system.solve(values, 1).error() == Error::result_out_of_range);
        }
    }
}
