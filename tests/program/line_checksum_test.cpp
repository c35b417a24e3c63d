// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/line_checksum.hpp"

#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

ProgramError read(const std::string& line) {
    TextCursor text(line);
    text.go_to(line.find('*'));
    return read_checksum(text).error();
}

} // namespace

TEST_CASE("a checksum is that of all characters before it", "[program][checksum]") {
    const std::string line = "N3 G1 X5 ";
    unsigned sum = 0;
    for (const char c : line) {
        sum ^= static_cast<unsigned char>(c);
    }
    const std::string right = line + "*" + std::to_string(sum);
    CHECK(read(right) == ProgramError::none);
    CHECK(read(right + " ; a comment") == ProgramError::none);
    CHECK(read(right + " X5") == ProgramError::character_invalid);
    CHECK(read("N4" + right.substr(2)) == ProgramError::checksum_wrong);
    CHECK(read(line + "*") == ProgramError::checksum_wrong);
    CHECK(read(line + "*" + std::to_string(sum) + ".5") == ProgramError::checksum_wrong);
}
