// SPDX-License-Identifier: MIT
#ifdef SPLINEFEED_HAS_GPIO
#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include "host/refusal.hpp"
#include "support/catch.hpp"

#include <array>

using namespace splinefeed::hal::gpio;

namespace {

const std::string chip = "/dev/gpiochip7";
const std::array<std::string, 8> names{"", "X_STEP", "X_DIR", "Y_STEP", "Y_DIR", "LED", "LED", ""};

std::string refusal(const std::vector<PinName>& wanted, std::span<const std::string> of = names) {
    return splinefeed_test::refusal_of<GpioError>([&] { static_cast<void>(find_lines(chip, of, wanted)); });
}

} // namespace

TEST_CASE("Lines: found by name, by offset, or by both, in the order in which they are wanted") {
    CHECK(find_lines(chip, names, std::vector<PinName>{{"Y_DIR", {}}, {"", 0}, {"X_STEP", 1}}) ==
          std::vector<unsigned>{4, 0, 1});
    // A name that is there twice is no obstacle where the offset says which.
    CHECK(find_lines(chip, names, std::vector<PinName>{{"LED", 6}, {"LED", 5}}) == std::vector<unsigned>{6, 5});
}

TEST_CASE("Lines: a name that the chip does not have is told with the nearest ones") {
    CHECK(refusal({{"Y_STPE", {}}}) ==
          chip + " has no line named 'Y_STPE'; did you mean 'Y_STEP' (line 3) or 'X_STEP' (line 1)?");
    CHECK(refusal({{"a_STEP", {}}}, std::array<std::string, 4>{"A1_STEP", "A2_STEP", "A_STEP", "A3_STEP"}) ==
          chip +
              " has no line named 'a_STEP'; did you mean 'A_STEP' (line 2), 'A1_STEP' (line 0) or 'A2_STEP' (line 1)?");
    CHECK(refusal({{"enable", {}}}) == chip + " has no line named 'enable'; gpioinfo lists their names");
    CHECK(refusal({{"X_STEP", {}}}, std::array<std::string, 2>{}) ==
          chip + " has no line named 'X_STEP'; its lines have no names: give offsets");
    CHECK(refusal({{"LED", {}}}) ==
          chip + " has 2 lines named 'LED', lines 5 and 6; give the offset of the one that is meant");
}

TEST_CASE("Lines: an offset is checked against the chip, and against the name") {
    CHECK(refusal({{"", 8}}) == chip + " has no line 8; its lines are 0 to 7");
    CHECK(refusal({{"", 0}}, {}) == chip + " has no lines; take another chip");
    CHECK(refusal({{"X_DIR", 1}}) == "line 1 of " + chip +
                                         " is named 'X_STEP', where 'X_DIR' was expected; that is line 2: correct one "
                                         "of both");
    CHECK(refusal({{"ENABLE", 0}}) ==
          "line 0 of " + chip + " has no name, where 'ENABLE' was expected; correct the name, or leave it out");
}

TEST_CASE("Lines: each once, 1 to 64, none without name and offset") {
    CHECK(refusal({{"X_DIR", {}}, {"", 3}, {"", 2}}) ==
          "line 2 ('X_DIR') of " + chip + " was asked for twice; each use needs a line of its own");
    CHECK(refusal({}) == "0 lines of " + chip + " were asked for; it must be 1 to 64");
    CHECK(refusal({{}}) == "a line of " + chip + " was asked for without a name or an offset; give one of both");
    const std::vector<std::string> many(65);
    std::vector<PinName> wanted;
    for (unsigned offset = 0; offset < 64; ++offset) {
        wanted.push_back({"", offset});
    }
    CHECK(find_lines(chip, many, wanted).size() == 64);
    wanted.push_back({"", 64});
    CHECK(refusal(wanted, many) == "65 lines of " + chip + " were asked for; it must be 1 to 64");
}
#endif
