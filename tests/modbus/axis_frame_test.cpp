// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/axis_frame.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

namespace {

constexpr std::int64_t count = units_per_count;
constexpr std::int64_t q16 = 65536;
constexpr std::int64_t most = 0x7FFFFFFF;

} // namespace

TEST_CASE("Axis frame: the drive stands where the axis begins, and counts either way") {
    for (const bool inverted : {false, true}) {
        AxisFrame frame(inverted);
        REQUIRE(frame.align(1000 * q16, 5 * count));
        const std::int64_t way = inverted ? -1 : 1;
        CHECK(frame.position(5 * count) == 1000 * count);
        CHECK(frame.position(8 * count) == (1000 + 3 * way) * count);
        CHECK(frame.velocity(7) == 7 * way);
        CHECK(frame.axis_counts(1000 * q16) == 5.0);
        CHECK(frame.axis_counts((1000 + 3 * way) * q16) == 8.0);
    }
}

TEST_CASE("Axis frame: nothing overflows, whatever the drive says and the program asks for") {
    constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
    for (const bool inverted : {false, true}) {
        AxisFrame frame(inverted);
        REQUIRE(frame.align(7 * q16, 0));
        CHECK_FALSE(frame.align(lowest, 0)); // a drive with 64 bits
        CHECK_FALSE(frame.align(highest, 0));
        CHECK_FALSE(frame.align((most + 1) * q16, 0));
        CHECK_FALSE(frame.align(most * q16, (inverted ? 1 : -1) * most * count));
        CHECK_FALSE(frame.align(0, lowest));
        CHECK(frame.position(0) == 7 * count); // as before
        CHECK_FALSE(frame.position(lowest).has_value());
        CHECK_FALSE(frame.position(highest).has_value());
        CHECK_FALSE(frame.position((inverted ? -1 : 1) * (most - 6) * count).has_value());
        CHECK(frame.position((inverted ? -1 : 1) * (most - 7) * count) == most * count);
        REQUIRE(frame.align(most * q16, (inverted ? -1 : 1) * most * count)); // the same place
        CHECK(frame.position(0) == 0);
    }
}

TEST_CASE("Axis frame: what the register of the target cannot hold is refused") {
    RegisterField target;
    target.is_signed = true;
    target.lowest = -32768;
    target.highest = 32767;
    AxisFrame frame(false, &target);
    REQUIRE(frame.align(30000 * q16, 0));
    CHECK(frame.position(2767 * count) == 32767 * count);
    CHECK_FALSE(frame.position(2768 * count).has_value());
    CHECK(frame.position(-62768 * count).has_value());
    CHECK_FALSE(frame.position(-62769 * count).has_value());
    CHECK_FALSE(frame.align(40000 * q16, 0));
}
