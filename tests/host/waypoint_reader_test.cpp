// SPDX-License-Identifier: MIT
#include "host_sim/program/waypoint_reader.hpp"

#include "refusal.hpp"
#include "support/catch.hpp"

#include <sstream>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

const std::vector<std::string> xyz{"x", "y", "z"};

std::vector<WaypointRow> read(const std::string& text, const std::vector<std::string>& axes = xyz) {
    std::istringstream input(text);
    WaypointReader reader(input, "w.csv", axes);
    std::vector<WaypointRow> rows;
    WaypointRow row;
    while (reader.next(row)) {
        rows.push_back(row);
    }
    CHECK(reader.rows() == rows.size());
    return rows;
}

std::string refusal(const std::string& text, const std::vector<std::string>& axes = xyz) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(read(text, axes)); });
}

/// Delivers one character at a time, as a slow pipe does, and counts them.
class Drip final : public std::streambuf {
public:
    explicit Drip(std::string text) : text_(std::move(text)) {}
    [[nodiscard]] std::size_t delivered() const { return next_; }

private:
    int_type underflow() override {
        if (next_ == text_.size()) {
            return traits_type::eof();
        }
        current_ = text_[next_++];
        setg(&current_, &current_, &current_ + 1);
        return traits_type::to_int_type(current_);
    }

    std::string text_;
    std::size_t next_ = 0;
    char current_ = 0;
};

} // namespace

TEST_CASE("Waypoints without a header are x,y and the rest") {
    const auto rows = read("1,2\n3,4\n");
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].position[0] == 1.0);
    CHECK(rows[1].position[1] == 4.0);
    CHECK(rows[1].position[2] == 0.0);
    CHECK(rows[1].line == 2);
    CHECK(read("1,2,3\n4,5,6")[1].position[2] == 6.0);
    CHECK(read("1,2,3,4,5,6\n7,8,9,1,2,3", {"x", "y", "z", "a", "b", "c"})[1].position[5] == 3.0);
    CHECK(read("1\n2\n", {"x"}).size() == 2);
}

TEST_CASE("A header names the columns in any order and case") {
    const auto rows = read("# drawing 7\n\n Feed , Y,corner,X\n 50, 1 , 1, +2.5\n,-1e1,,3\n10,0,0,4\n");
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].position[0] == 2.5);
    CHECK(rows[0].position[1] == 1.0);
    CHECK(rows[0].feed_mm_s == 50.0);
    CHECK(rows[0].corner == Corner::forced);
    CHECK(rows[1].feed_mm_s == 0.0);
    CHECK(rows[1].position[1] == -10.0);
    CHECK(rows[1].corner == Corner::automatic);
    CHECK(rows[2].corner == Corner::forbidden);
    CHECK(rows[2].line == 6);
}

TEST_CASE("A row may hold a maximum for the feed, with a feed or without") {
    const auto rows = read("x,feed,MAX_feed,y\n0,,,0\n1,50,60,1\n2,,30.5,2\n");
    CHECK(rows[0].max_feed_mm_s == 0.0);
    CHECK(rows[1].feed_mm_s == 50.0);
    CHECK(rows[1].max_feed_mm_s == 60.0);
    CHECK(rows[2].feed_mm_s == 0.0);
    CHECK(rows[2].max_feed_mm_s == 30.5);
    CHECK(rows[2].position[1] == 2.0);
}

TEST_CASE("What editors do to a file does not matter") {
    const auto rows = read("\xef\xbb\xbfx,y\r\n\r\n# comment\r\n  1.5 ,\t2\r\n   # another\n3,4");
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].position[0] == 1.5);
    CHECK(rows[1].position[1] == 4.0);
}

TEST_CASE("Numbers are read exactly") {
    const auto rows = read("0.1,-65000\n1e-3,-.5\n12345.6789012345678,+7.\n");
    CHECK(rows[0].position[0] == 0.1);
    CHECK(rows[0].position[1] == -65000.0);
    CHECK(rows[1].position[1] == -0.5);
}

TEST_CASE("Only the axes of the file are kept where no machine says which there are") {
    std::istringstream input("c,feed,y\n1,2,3\n4,5,6\n");
    WaypointReader reader(input, "w.csv", {"x", "y", "z", "a", "b", "c"}, true);
    CHECK(reader.axes() == std::vector<std::string>{"y", "c"});
    WaypointRow row;
    REQUIRE(reader.next(row));
    CHECK(row.position[0] == 3.0);
    CHECK(row.position[1] == 1.0);
    CHECK(row.feed_mm_s == 2.0);
}

TEST_CASE("A row is there as soon as its line has ended") {
    const std::string text = "x,y\n1,2\n3,4\n5,6\n";
    Drip drip(text);
    std::istream input(&drip);
    WaypointReader reader(input, "-", xyz);
    WaypointRow row;
    for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(reader.next(row));
        CHECK(drip.delivered() == 8 + 4 * i);
    }
    CHECK_FALSE(reader.next(row));
}

TEST_CASE("Lines that are too long, and bytes that are no text, are refused with their line") {
    CHECK(refusal("1,2\n" + std::string(5000, '1') + "\n").find("w.csv:2: ") == 0);
    CHECK(refusal("1,2\n#" + std::string(5000, '1')).find("longer than 4096") != std::string::npos);
    CHECK(refusal(std::string("1,2\n3,\0004\n", 9)).find("NUL") != std::string::npos);
    CHECK(refusal("1,2\n3,4\033[31m\n").find("\\x1b") != std::string::npos);
    CHECK(refusal("1,2,3\n", {"x", "y", "a"}).find("no axis z") != std::string::npos);
}

TEST_CASE("A column of tolerances may be empty") {
    const std::vector<WaypointRow> rows = read("x,y,tolerance\n0,0,\n1,0,0.05\n2,0,0\n");
    REQUIRE(rows.size() == 3);
    CHECK_FALSE(rows[0].tolerance_mm);
    CHECK(rows[1].tolerance_mm == 0.05);
    CHECK(rows[2].tolerance_mm == 0.0);
    std::istringstream with("x,tolerance\n0,1\n");
    std::istringstream without("x,y\n0,1\n");
    CHECK(WaypointReader(with, "w.csv", xyz).has_tolerances());
    CHECK_FALSE(WaypointReader(without, "w.csv", xyz).has_tolerances());
}
