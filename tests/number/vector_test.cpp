// SPDX-License-Identifier: MIT
#include "splinefeed/number/vector.hpp"

#include "support/catch.hpp"

using namespace splinefeed;

namespace {

constexpr int axes = 2;

template <Scalar S>
PerAxis<S> pair_of(int first, int second) {
    return {from_integer<S>(first), from_integer<S>(second)};
}

} // namespace

TEMPLATE_TEST_CASE("Vectors: the axes that count, in their order", "[vector]", double, float, Fixed) {
    using S = TestType;
    const PerAxis<S> a = pair_of<S>(3, -4);
    const PerAxis<S> b = pair_of<S>(1, 2);
    CHECK(norm(a, axes) == from_integer<S>(5));
    CHECK(dot(a, b, axes) == from_integer<S>(-5));
    CHECK(dot(a, b, 1) == from_integer<S>(3));
    CHECK(difference(a, b, axes) == pair_of<S>(2, -6));
    CHECK(plus(a, b, axes) == pair_of<S>(4, -2));
    CHECK(plus(a, b, 1) == pair_of<S>(4, 0));
    CHECK(largest_size(a, axes) == from_integer<S>(4));
    CHECK(largest_size(a, 1) == from_integer<S>(3));
}

TEMPLATE_TEST_CASE("Vectors: in place, what is behind the count stays", "[vector]", double, float, Fixed) {
    using S = TestType;
    PerAxis<S> v = pair_of<S>(8, 4);
    divide(v, from_integer<S>(2), 1);
    CHECK(v == pair_of<S>(4, 4));
    scale(v, from_integer<S>(3), 1);
    CHECK(v == pair_of<S>(12, 4));
    add(v, from_integer<S>(2), pair_of<S>(1, 1), 1);
    CHECK(v == pair_of<S>(14, 4));
    subtract(v, from_integer<S>(7), pair_of<S>(1, -1), axes);
    CHECK(v == pair_of<S>(7, 11));
}

TEST_CASE("Vectors: what is asked of each axis", "[vector]") {
    CHECK(each(axes, [](unsigned k) { return static_cast<int>(k) + 1; }) == PerAxis<int>{1, 2});
    CHECK(sum_of(axes, [](unsigned k) { return static_cast<int>(k) + 1; }) == 3);
    CHECK(for_all(axes, [](unsigned k) { return k < 2; }));
    CHECK_FALSE(for_all(axes, [](unsigned k) { return k < 1; }));
    CHECK(for_any(axes, [](unsigned k) { return k == 1; }));
    CHECK_FALSE(for_any(1, [](unsigned k) { return k == 1; }));
    CHECK(for_all(0, [](unsigned) { return false; }));
}

TEST_CASE("Vectors: of places and of control points", "[vector]") {
    const PerAxis<Position> from{Position{0}, Position{std::int64_t{1} << 40}};
    const PerAxis<Position> to{Position{std::int64_t{3} << 40}, Position{0}};
    CHECK(distances<double>(from, to, 0, axes) == PerAxis<double>{3.0, -1.0});
    CHECK(distances<double>(from, to, -12, 1) == PerAxis<double>{3.0 * 4096.0});
    PerAxis<PerDegree<double>> control{};
    control[0] = {1.0, 2.0, 4.0};
    control[1] = {5.0, 3.0, 2.0};
    CHECK(control_at(control, 2, axes) == PerAxis<double>{4.0, 2.0});
    CHECK(leg(control, 0, 2, axes) == PerAxis<double>{3.0, -3.0});
}
