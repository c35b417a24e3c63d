// SPDX-License-Identifier: MIT
//
// Where moves end within a line: how many fit, and which of them a line passes.
#include "splinefeed/s1_blended_path/line_parts.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace splinefeed;

namespace {

PerAxis<Position> at_mm(double x, double y = 0.0) {
    PerAxis<Position> place{};
    place[0] = position_from_mm(x);
    place[1] = position_from_mm(y);
    return place;
}

} // namespace

TEST_CASE("a place of a part is free as soon as its line must have been passed", "[blended_path][collinear]") {
    LineParts parts;
    for (std::uint32_t i = 0; i < LineParts::capacity; ++i) {
        REQUIRE(parts.has_room(LineParts::capacity - i, i / 40));
        parts.add({{}, i, i / 40});
    }
    CHECK_FALSE(parts.has_room(LineParts::capacity + 1, 1000));
    constexpr std::uint32_t free = LineParts::elements_on_the_way;
    CHECK_FALSE(parts.has_room(1, free - 1));
    CHECK(parts.has_room(40, free)); // those of line 0
    CHECK_FALSE(parts.has_room(41, free));
    CHECK(parts.has_room(41, free + 1));
}

TEMPLATE_TEST_CASE("a line ends where its next move does, but not within a rounding", "[blended_path][collinear]",
                   double, float, Fixed) {
    using S = TestType;
    LineParts parts;
    for (std::uint32_t i = 3; i < 8; ++i) { // at 3 to 7 mm, a little off the line
        parts.add({at_mm(i, 1e-4), i, 0});
    }
    PerAxis<Position> there = at_mm(6.5);
    std::uint32_t index = 9;
    REQUIRE(pass_part<S>(parts, at_mm(3.5), 2, there, index)); // 3 mm are within the rounding before it
    CHECK(index == 4);
    CHECK(std::abs(to_mm(there[0]) - 4.0) < 1e-6);
    CHECK(there[1].raw == 0); // on the line
    there = at_mm(6.5);
    index = 9;
    REQUIRE(pass_part<S>(parts, at_mm(4.0), 2, there, index));
    CHECK(index == 5);
    there = at_mm(6.0);
    index = 9;
    CHECK_FALSE(pass_part<S>(parts, at_mm(5.0), 2, there, index)); // nothing would be left behind 6 mm
    CHECK(index == 9);
    CHECK(there[0] == at_mm(6.0)[0]);
    parts.pass_before(7);
    REQUIRE(parts.next_before(9) != nullptr);
    CHECK(parts.next_before(9)->index == 7);
    CHECK(parts.next_before(7) == nullptr); // it belongs to the move that ends there, not to one before
}
