// SPDX-License-Identifier: MIT
#include "splinefeed/hal/stop_sequence.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <random>

using namespace splinefeed::hal;
using namespace splinefeed_test;

namespace {

constexpr StopTimes times{.hold_us = 1000, .quick_stop_us = 500, .disable_us = 200, .settle_us = 20};

StopFacts stands(std::uint64_t status_us, StopRequest executed, std::uint64_t executed_us) {
    return {.status_us = status_us, .standstill = true, .executed = executed, .executed_us = executed_us};
}

StopFacts moves(std::uint64_t status_us, StopRequest executed, std::uint64_t executed_us) {
    return {.status_us = status_us, .executed = executed, .executed_us = executed_us};
}

/// One axis that executes what a sequence sends.
struct One {
    StopSequence stop{1, times};

    StopReport at(std::uint64_t now_us, const StopFacts& facts) {
        stop.update(now_us, {&facts, 1});
        return stop.report(0);
    }
};

} // namespace

TEST_CASE("Stop: an axis at standstill before the request gets it too, and confirms it only afterwards") {
    One one;
    CHECK_FALSE(one.stop.settled());
    one.stop.request(StopRequest::hold, 100);
    CHECK(one.at(100, stands(99, StopRequest::none, 0)).state == StopState::moving);
    CHECK(one.stop.to_send(0) == StopRequest::hold);
    // Executed at 110, but what it says is older.
    CHECK(one.at(111, stands(105, StopRequest::hold, 110)).state == StopState::stopping);
    CHECK(one.stop.to_send(0) == StopRequest::none);
    CHECK(one.at(121, stands(120, StopRequest::hold, 110)).state == StopState::stopping); // it settles
    CHECK(one.at(141, stands(139, StopRequest::hold, 110)).state == StopState::stopping);
    CHECK(one.at(142, stands(140, StopRequest::hold, 110)).held());
    CHECK(one.stop.settled());
}

TEST_CASE("Stop: two statuses far apart do not say that the axis stood between them") {
    One one;
    one.stop.request(StopRequest::hold, 100);
    CHECK(one.at(200, stands(200, StopRequest::hold, 110)).state == StopState::stopping);
    CHECK(one.at(300, stands(300, StopRequest::hold, 110)).state == StopState::stopping);
    CHECK(one.at(310, stands(300, StopRequest::hold, 110)).state == StopState::stopping); // the same one
    CHECK(one.at(320, stands(320, StopRequest::hold, 110)).held());
}

TEST_CASE("Stop: a hold that is not confirmed in time becomes a quick stop, then power off, then unconfirmed") {
    One one;
    one.stop.request(StopRequest::hold, 0);
    CHECK(one.at(1000, moves(990, StopRequest::hold, 10)).request == StopRequest::hold);
    CHECK(one.at(1001, moves(1000, StopRequest::hold, 10)).request == StopRequest::quick_stop);
    CHECK(one.stop.to_send(0) == StopRequest::quick_stop);
    CHECK(one.at(1501, moves(1500, StopRequest::quick_stop, 1010)).state == StopState::stopping);
    CHECK(one.at(1502, moves(1500, StopRequest::quick_stop, 1010)).request == StopRequest::disable);
    CHECK_FALSE(one.stop.settled());
    CHECK(one.at(1703, moves(1700, StopRequest::quick_stop, 1010)).state == StopState::unconfirmed);
    CHECK(one.stop.settled());
    CHECK(one.stop.to_send(0) == StopRequest::disable); // it is sent again until the axis executes it
    CHECK(one.at(1800, stands(1790, StopRequest::disable, 1780)).state == StopState::unconfirmed);
    CHECK(one.at(1805, stands(1800, StopRequest::disable, 1780)).state == StopState::unconfirmed);
    CHECK(one.at(1810, stands(1810, StopRequest::disable, 1780)).state == StopState::confirmed);
}

TEST_CASE("Stop: the strongest request that an axis is asked for unasked can be limited") {
    One one;
    one.stop.set_times({.hold_us = 10, .quick_stop_us = 10, .last = StopRequest::quick_stop});
    one.stop.request(StopRequest::hold, 0);
    CHECK(one.at(11, {}).request == StopRequest::quick_stop);
    CHECK(one.at(22, {}).request == StopRequest::quick_stop);
    CHECK(one.stop.report(0).state == StopState::unconfirmed);
}

TEST_CASE("Stop: requests only grow, and a stronger one is for every axis, also for those that stand") {
    StopSequence stop(2, times);
    stop.request(StopRequest::hold, 0);
    std::vector<StopFacts> facts{stands(50, StopRequest::hold, 5), moves(50, StopRequest::hold, 5)};
    stop.update(50, facts);
    for (const std::uint64_t now_us : {60U, 80U}) {
        facts[0].status_us = now_us;
        stop.update(now_us, facts);
    }
    CHECK(stop.report(0).state == StopState::confirmed);
    CHECK_FALSE(stop.settled());
    stop.request(StopRequest::quick_stop, 90);
    stop.request(StopRequest::hold, 91);
    stop.update(92, facts);
    CHECK(stop.to_send(0) == StopRequest::quick_stop);
    CHECK(stop.to_send(1) == StopRequest::quick_stop);
    CHECK(stop.report(0).state == StopState::moving);
    CHECK_FALSE(stop.settled());
    stop.reset();
    CHECK_FALSE(stop.requested());
    CHECK(stop.report(0).request == StopRequest::none);
}

TEST_CASE("Stop: an axis that escalates does so alone") {
    StopSequence stop(2, times);
    stop.request(StopRequest::hold, 0);
    std::vector<StopFacts> facts{stands(50, StopRequest::hold, 5), moves(50, StopRequest::hold, 5)};
    stop.update(50, facts);
    facts[0].status_us = 60;
    stop.update(60, facts);
    facts[0].status_us = 80;
    facts[1].status_us = 1100;
    CHECK(stop.unconfirmed() == 0);
    stop.update(1100, facts);
    CHECK(stop.report(0).held());
    CHECK(stop.unconfirmed() == 1);
    CHECK(stop.report(1).request == StopRequest::quick_stop);
}

TEST_CASE("Stop: what was confirmed and moves again is no longer confirmed") {
    One one;
    one.stop.request(StopRequest::hold, 0);
    one.at(100, stands(100, StopRequest::hold, 5));
    one.at(110, stands(110, StopRequest::hold, 5));
    CHECK(one.at(130, stands(130, StopRequest::hold, 5)).held());
    CHECK(one.at(140, moves(140, StopRequest::hold, 5)).state == StopState::stopping);
    CHECK(one.at(150, stands(150, StopRequest::hold, 5)).state == StopState::stopping);
    CHECK(one.at(1200, moves(1190, StopRequest::hold, 5)).request == StopRequest::quick_stop);
}

TEST_CASE("Stop: an axis that brakes gets the longer time as long as it is heard") {
    StopTimes slow = times;
    slow.braking_us = 20'000;
    StopSequence stop(1, slow);
    stop.request(StopRequest::hold, 100);
    StopFacts facts = moves(150, StopRequest::hold, 110);
    facts.braking = true;
    for (std::uint64_t now_us = 200; now_us <= 5000; now_us += 100) {
        facts.status_us = now_us - 50;
        stop.update(now_us, {&facts, 1});
        REQUIRE(stop.report(0).request == StopRequest::hold);
    }
    stop.update(facts.status_us + times.hold_us, {&facts, 1}); // nothing was heard since
    CHECK(stop.report(0).request == StopRequest::hold);
    stop.update(facts.status_us + times.hold_us + 1, {&facts, 1});
    CHECK(stop.report(0).request == StopRequest::quick_stop);
}

// An axis of random manners, judged by what it really did: never confirmed before it stood for the settling time, for
// good; and always an answer within the sum of the bounds.
TEST_CASE("Stop: whatever an axis does, confirmed means that it stands, and there is an answer in time") {
    const int runs = rounds(2000);
    int confirmed = 0;
    for (int run = 0; run < runs; ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const auto dice = [&](std::uint64_t most) {
            return std::uniform_int_distribution<std::uint64_t>(0, most)(random);
        };
        One one;
        const std::uint64_t reaction_us = dice(1200);        // after it was sent
        const std::uint64_t stands_us = dice(600);           // after it obeyed
        const std::uint64_t start_us = dice(1) * dice(3000); // a start that was under way when the stop was asked for
        const std::uint64_t deaf_us = dice(2) == 0 ? dice(2000) : 0;
        const StopRequest first = dice(1) == 0 ? StopRequest::hold : StopRequest::quick_stop;
        const std::uint64_t second_us = dice(2) == 0 ? dice(1500) : UINT64_MAX;
        StopRequest sent = StopRequest::none;
        StopRequest executed = StopRequest::none;
        std::uint64_t sent_us = 0;
        std::uint64_t executed_us = 0;
        StopFacts facts;
        one.stop.request(first, 1);
        std::uint64_t now = 1;
        for (; now < 4000 && !one.stop.settled(); now += 1 + dice(8)) {
            if (now >= second_us) {
                one.stop.request(StopRequest::disable, now);
            }
            if (executed < sent && now >= sent_us + reaction_us) {
                executed = sent;
                executed_us = now;
            }
            // A start that has its instant before anything was executed is a motion.
            const bool pending = executed == StopRequest::none && start_us > now;
            const bool still = (executed != StopRequest::none && now >= executed_us + stands_us) || pending;
            if (now >= deaf_us) {
                facts = {.status_us = now, .standstill = still, .executed = executed, .executed_us = executed_us};
            }
            const StopReport report = one.at(now, facts);
            if (report.state == StopState::confirmed) {
                INFO("run " << run << " at " << now);
                REQUIRE(executed >= report.request);
                REQUIRE(now >= executed_us + times.settle_us);
                REQUIRE(still);
                ++confirmed;
            }
            if (const StopRequest send = one.stop.to_send(0); send > sent) {
                sent = send;
                sent_us = now;
            }
        }
        INFO("run " << run);
        REQUIRE(one.stop.settled());
        REQUIRE(now < std::min<std::uint64_t>(second_us, 1600) + 1800);
    }
    CHECK(confirmed > runs / 4);
}
