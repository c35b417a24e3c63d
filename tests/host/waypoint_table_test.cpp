// SPDX-License-Identifier: MIT
#include "host_sim/program/waypoint_table.hpp"

#include "host_sim/program/waypoint_reader.hpp"
#include "refusal.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <sstream>

using namespace splinefeed::host;
using splinefeed_test::refusal_of;

namespace {

const double none = std::nan("");

WaypointTable table() {
    return {.columns = 2,
            .position_mm = {0.0, 1.0, 10.0, 5.0, 20.0, -0.5},
            .feed_mm_s = {none, 40.0, none},
            .max_feed_mm_s = {none, none, 90.0},
            .tolerance_mm = {none, 0.5, none},
            .corner = {none, 1.0, 0.0}};
}

std::vector<WaypointRow> all(WaypointRows& rows) {
    std::vector<WaypointRow> out;
    for (WaypointRow row; rows.wait({}) && rows.next(row);) {
        out.push_back(row);
    }
    return out;
}

void require_same(const std::vector<WaypointRow>& found, const std::vector<WaypointRow>& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i].position == expected[i].position);
        CHECK(found[i].feed_mm_s == expected[i].feed_mm_s);
        CHECK(found[i].max_feed_mm_s == expected[i].max_feed_mm_s);
        CHECK(found[i].corner == expected[i].corner);
        CHECK(found[i].tolerance_mm == expected[i].tolerance_mm);
    }
}

} // namespace

TEST_CASE("rows of a table are those of a file with the same columns") {
    std::istringstream text("x,y,feed,max_feed,tolerance,corner\n0,1,,,,\n10,5,40,,.5,1\n20,-0.5,,90,,0\n");
    WaypointReader reader(text, "file", {"x", "y", "z"});
    std::vector<WaypointRow> expected;
    for (WaypointRow row; reader.next(row);) {
        expected.push_back(row);
    }
    const OpenedRows opened = open_table(std::make_shared<const WaypointTable>(table()), "table", {"x", "y", "z"});
    CHECK(opened.axes == std::vector<std::string>{"x", "y", "z"});
    CHECK(opened.has_tolerances);
    require_same(all(*opened.rows), expected);

    PushedRows pushed(WaypointCheck("table", {"x", "y", "z"}));
    CHECK_FALSE(pushed.wait({}));
    WaypointTable wrong = table();
    wrong.position_mm[0] = HUGE_VAL;
    CHECK(refusal_of([&] { pushed.push(wrong); }) ==
          "table:1: x 'inf' is out of range; a position must lie within +-1048576 mm"); // it is no row
    pushed.push(table());
    require_same(all(pushed), expected);
    CHECK_FALSE(pushed.wait({}));
    pushed.finish();
    CHECK(pushed.wait({}));
    WaypointRow row;
    CHECK_FALSE(pushed.next(row));
}

TEST_CASE("a table is refused with the row, from 1") {
    const auto refused = [](const WaypointTable& wrong, const std::vector<std::string>& axes) {
        return refusal_of([&] {
            const OpenedRows opened = open_table(std::make_shared<const WaypointTable>(wrong), "table", axes);
            static_cast<void>(all(*opened.rows));
        });
    };
    const std::vector<std::string> xy{"x", "y"};
    WaypointTable wrong = table();
    CHECK(refused(wrong, {}) == "accepted");
    CHECK(refused(wrong, {"x"}) == "table: the points have 2 coordinates; there must be 1 to 1: x");
    wrong.corner = {none, 2.0, none};
    CHECK(refused(wrong, xy) ==
          "table:2: corner is 2; it must be 1 (a corner), 0 (none) or nan (the corner angle decides)");
    wrong = table();
    wrong.tolerance_mm[1] = -1.0;
    CHECK(refused(wrong, xy) == "table:2: tolerance '-1' is out of range; it must lie between 0 and 100 mm");
    wrong.position_mm[3] = HUGE_VAL;
    CHECK(refused(wrong, xy) == "table:2: y 'inf' is out of range; a position must lie within +-1048576 mm");
    wrong = {.columns = 2};
    CHECK(refused(wrong, xy) == "table: there is no waypoint; a path needs two");
}
