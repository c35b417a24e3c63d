// SPDX-License-Identifier: MIT
#include "waypoints/line_parser.hpp"

#include "support/catch.hpp"
#include "support/split.hpp"

#include <string>

using firmware::Command;
using firmware::parse_line;
using firmware::Verb;
using splinefeed::Corner;
using splinefeed::position_from_mm;

namespace {

Command parsed(const std::string& line) {
    return parse_line(line, 3);
}

} // namespace

TEST_CASE("Line parser: waypoints", "[line]") {
    const Command plain = parsed("1.5,-2,.25");
    REQUIRE(plain.verb == Verb::waypoint);
    CHECK(plain.position[0] == position_from_mm(1.5));
    CHECK(plain.position[1] == position_from_mm(-2.0));
    CHECK(plain.position[2] == position_from_mm(0.25));
    CHECK(plain.number.raw == 0);
    CHECK(plain.corner == Corner::automatic);

    const Command full = parsed(" 1 , 2 , 3 , 12.5 , 1 ");
    REQUIRE(full.verb == Verb::waypoint);
    CHECK(full.number.raw == 12'500'000'000);
    CHECK(full.corner == Corner::forced);
    CHECK(parsed("1,2,3,,0").corner == Corner::forbidden);
    CHECK(parsed("1,2,3,,").verb == Verb::waypoint);
    CHECK(parsed("1,2,3,").verb == Verb::waypoint);
    CHECK(parsed("1048576,-1048576,0").verb == Verb::waypoint);
}

TEST_CASE("Line parser: words, and lines that say nothing", "[line]") {
    CHECK(parsed("end").verb == Verb::end);
    CHECK(parsed("END ").verb == Verb::end);
    CHECK(parsed("reset").verb == Verb::reset);
    CHECK(parsed("memory").verb == Verb::memory);
    CHECK(parsed("stall").verb == Verb::stall);
    CHECK(parsed("feed 120").number.raw == 120'000'000'000);
    const Command at = parsed("at 1,2,3");
    CHECK(at.verb == Verb::at);
    CHECK(at.position[2] == position_from_mm(3.0));
    for (const char* line : {"", "  ", "# 1,2,3", "x,y,z", "x,y,z,feed,corner"}) {
        CAPTURE(line);
        CHECK(parsed(line).verb == Verb::nothing);
    }
}

TEST_CASE("Line parser: what is refused says what would be right", "[line]") {
    for (const std::string& line : splinefeed_test::split(
             "1,2|1,,3|1;2;3|1,2,3,4,2|1,2,3,4,1,|1,2,3,-4|1,2,3,x|1048576.1,0,0|1e3,0,0|end 1|ends|at 1,2|at|feed|"
             "feed 201|feed -1|hold|1,2,3*|1,2,3*0|1,2,3*zz|1,2,3*00|1,2,3*1e0|99999999999999999999,0,0")) {
        CAPTURE(line);
        const Command command = parsed(line);
        CHECK(command.verb == Verb::invalid);
        CHECK(command.error != nullptr);
    }
}

TEST_CASE("Line parser: a checksum finds every single wrong character", "[line]") {
    const std::string body = "12.5,-3,0.125";
    unsigned sum = 0;
    for (const char c : body) {
        sum ^= static_cast<unsigned char>(c);
    }
    constexpr char digits[] = "0123456789abcdef";
    const std::string line = body + '*' + digits[sum >> 4U] + digits[sum & 15U];
    REQUIRE(parsed(line).verb == Verb::waypoint);
    for (std::size_t i = 0; i < body.size(); ++i) {
        for (unsigned bit = 0; bit < 7; ++bit) {
            std::string wrong = line;
            wrong[i] = static_cast<char>(static_cast<unsigned char>(wrong[i]) ^ (1U << bit));
            CAPTURE(wrong);
            const Verb verb = parsed(wrong).verb;
            // As a comment it would be an answer of "ok" to a waypoint that is missing.
            CHECK(verb == Verb::invalid);
        }
    }
}
