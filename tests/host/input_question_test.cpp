// SPDX-License-Identifier: MIT
#include "host_sim/ports/program_outputs.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

constexpr std::uint64_t began_us = 1'000'000;
constexpr double timeout_s = 2.0;
constexpr std::uint64_t end_us = began_us + 2'000'000;

/// The answer to readings, one each millisecond; -2: it waits on.
int answer_to(InputWait wait, std::initializer_list<bool> readings) {
    InputQuestion question(wait, timeout_s, began_us);
    std::uint64_t now_us = began_us;
    std::optional<int> answer;
    for (const bool active : readings) {
        REQUIRE_FALSE(answer);
        answer = question.take(active, now_us);
        now_us += 1000;
    }
    return answer.value_or(-2);
}

} // namespace

TEST_CASE("M66 L0 answers at once, with the level") {
    CHECK(answer_to(InputWait::now, {false}) == 0);
    CHECK(answer_to(InputWait::now, {true}) == 1);
}

TEST_CASE("M66 L3 and L4 answer where the level is what they wait for") {
    CHECK(answer_to(InputWait::high, {true}) == 1);
    CHECK(answer_to(InputWait::high, {false, false, true}) == 1);
    CHECK(answer_to(InputWait::high, {false, false}) == -2);
    CHECK(answer_to(InputWait::low, {false}) == 0);
    CHECK(answer_to(InputWait::low, {true, true, false}) == 0);
}

TEST_CASE("M66 L1 and L2 answer to a change, not to a level") {
    CHECK(answer_to(InputWait::rise, {true, true}) == -2);
    CHECK(answer_to(InputWait::rise, {false, true}) == 1);
    CHECK(answer_to(InputWait::rise, {true, false, true}) == 1);
    CHECK(answer_to(InputWait::fall, {false, false}) == -2);
    CHECK(answer_to(InputWait::fall, {true, false}) == 0);
    CHECK(answer_to(InputWait::fall, {false, true, false}) == 0);
}

TEST_CASE("A time-out needs a reading that is not older, and one that answers comes first") {
    InputQuestion question(InputWait::high, timeout_s, began_us);
    CHECK_FALSE(question.take(false, end_us - 1));
    SECTION("still low") {
        CHECK(question.take(false, end_us) == InputQuestion::timed_out);
    }
    SECTION("high in the last reading") {
        CHECK(question.take(true, end_us + 500'000) == 1);
    }
}
