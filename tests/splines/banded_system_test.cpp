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

} // namespace

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
