// SPDX-License-Identifier: MIT
#include "host_sim/run/supervision.hpp"

#include "support/catch.hpp"
#include "talking_target.hpp"
#include "temporary_folder.hpp"

#include <algorithm>
#include <filesystem>

using namespace splinefeed_test;

TEST_CASE_METHOD(TalkingRun, "a run's segments reach the target in order, and then its end", "[supervision]") {
    Told expected{"prepare"};
    for (std::uint32_t i = 0; i < 100; ++i) {
        submit(i);
        expected.push_back("segment " + std::to_string(i));
    }
    CHECK(supervision.finish());
    expected.emplace_back("complete");
    expected.emplace_back("finish");
    CHECK(target.told() == expected);
    CHECK(supervision.where() == "; there");
}

TEST_CASE_METHOD(TalkingRun, "drives that are not left as the machine file says end a run with that sentence",
                 "[supervision]") {
    target.unfinished = "a drive did not confirm that it is off";
    SECTION("behind a whole motion") {
        submit();
        fails("a drive did not confirm that it is off; there");
    }
    SECTION("behind a refusal") {
        target.refusal = "no";
        static_cast<void>(supervision.submit(segment(0)));
        fails("no; a drive did not confirm that it is off; there");
    }
}

TEST_CASE_METHOD(TalkingRun, "a run ends on the line that the machine has come to, however far the plan is",
                 "[supervision]") {
    CHECK(supervision.line() == 0);
    for (std::uint32_t i = 0; i < 8; ++i) { // two segments a line: 10, 20, 30, 40
        REQUIRE(supervision.submit(segment(i), 10 + i / 2 * 10));
    }
    REQUIRE(comes([&] { return target.told().size() == 9; }));
    SECTION("within the third line") {
        target.executed = 5;
        request(1);
        is_over();
        fails("held; there, on line 30");
        CHECK(supervision.line() == 30);
        REQUIRE(supervision.places().size() == 1);
        CHECK(supervision.places()[0].axis == 1);
        CHECK(supervision.places()[0].mm == 2.5);
        CHECK_FALSE(supervision.places()[0].known().has_value()); // it does not answer
    }
    SECTION("before the first segment was executed") {
        request(1);
        is_over();
        fails("held; there, on line 10");
    }
    SECTION("at the end of a line a machine that goes on is on the next") {
        target.executed = 4;
        target.phase = hal::PortPhase::fault;
        is_over();
        fails("a fault; there, on line 30");
    }
    SECTION("at the end") {
        target.executed = 8;
        CHECK(supervision.finish());
        CHECK(supervision.line() == 40);
        CHECK(supervision.where() == "; there, on line 40");
    }
}

TEST_CASE_METHOD(TalkingRun, "the planner is ahead of a port that takes nothing by no more than is handed over",
                 "[supervision]") {
    target.takes = false;
    std::uint32_t i = 0;
    while (supervision.room()) {
        REQUIRE(supervision.submit(segment(i++)));
    }
    CHECK(i == Supervision::hand_over_us / 1000);
    REQUIRE(comes([&] { return !target.told().empty(); }));
    request(1);
    CHECK_FALSE(supervision.submit(segment(i)));
    fails("held; there");
    CHECK(target.told() == Told{"prepare", "hold", "finish"});
}

TEST_CASE_METHOD(TalkingRun, "a signal is obeyed while the planner does nothing, the second one at once",
                 "[supervision]") {
    target.halts = false;
    move();
    request(1);
    CHECK(comes([&] { return target.told().back() == "hold"; }));
    CHECK_FALSE(supervision.over());
    request(2);
    is_over();
    CHECK(target.told() == Told{"prepare", "segment 0", "hold", "quick stop", "finish"});
    fails("stopped; there");
}

TEST_CASE_METHOD(TalkingRun, "each request is passed on once, and a third signal asks for nothing more",
                 "[supervision]") {
    target.halts = target.stops = false;
    move();
    request(1);
    stays({"prepare", "segment 0", "hold"});
    for (const int more : {2, 3}) {
        request(more);
        stays({"prepare", "segment 0", "hold", "quick stop"});
    }
    CHECK_FALSE(supervision.over());
    target.phase = hal::PortPhase::halted;
    is_over();
    CHECK(supervision.ending() == "stopped; there");
}

TEST_CASE_METHOD(TalkingRun, "two signals before the first look are a quick stop", "[supervision]") {
    target.halts = false;
    move();
    // Two signals of different kinds are both pending, however late the watch is woken.
    REQUIRE(kill(getpid(), SIGTERM) == 0);
    REQUIRE(kill(getpid(), SIGHUP) == 0);
    is_over();
    const Told told = target.told();
    REQUIRE(told.size() > 2);
    CHECK(told[told.size() - 2] == "quick stop");
    CHECK(told.back() == "finish");
    CHECK_FALSE(supervision.finish());
}

TEST_CASE_METHOD(TalkingRun, "a signal before the first segment leaves the drives alone", "[supervision]") {
    request(1);
    submit();
    CHECK_FALSE(supervision.finish());
    CHECK(target.told().empty());
    CHECK(supervision.ending() == "interrupted before anything was moved; the drives were not enabled");
}

TEST_CASE_METHOD(TalkingRun, "what a target refuses or why it fails ends the run", "[supervision]") {
    SECTION("refused") {
        target.refusal = "refused";
    }
    SECTION("fault") {
        target.phase = hal::PortPhase::fault;
    }
    submit();
    is_over();
    CHECK_FALSE(supervision.finish());
    CHECK(supervision.ending() == (target.refusal.empty() ? "a fault; there" : "refused; there"));
}

TEST_CASE_METHOD(TalkingRun, "the planner learns that its plan is to be held, and the run ends where that ends",
                 "[supervision]") {
    target.reason = "a limit acts";
    submit();
    CHECK(comes([&] { return supervision.hold_asked(); }));
    CHECK_FALSE(supervision.over());
    submit(1);
    fails("a limit acts; there");
}

TEST_CASE_METHOD(TalkingRun, "a plan that ends while the axes move is never declared complete: they are held",
                 "[supervision]") {
    FeedSegment moving = segment(0);
    moving.end_velocity[1] = 1;
    REQUIRE(supervision.submit(moving));
    REQUIRE(comes([&] { return target.told().size() == 2; }));
    CHECK_FALSE(supervision.finish());
    CHECK(target.told() == Told{"prepare", "segment 0", "hold", "finish"});
    CHECK(supervision.ending() == "the plan ended while the axes moved; held; there");
}

TEST_CASE_METHOD(TalkingRun, "whatever a target throws, its axes are held and its run has the one end",
                 "[supervision]") {
    move();
    SECTION("once it moves") {
        target.breaks = true;
        CHECK_FALSE(supervision.finish());
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "finish"});
        CHECK(supervision.ending() == "it broke; held; there");
    }
    SECTION("and does not stop") {
        target.halts = false;
        target.breaks = true;
        REQUIRE(comes([&] { return target.told().size() == 3; }));
        request(1);
        request(2);
        CHECK_FALSE(supervision.finish());
        CHECK(target.told() == Told{"prepare", "segment 0", "hold", "quick stop", "finish"});
        CHECK(supervision.ending() == "it broke; stopped; there");
    }
}

TEST_CASE("the state says that no place is known before anything moves, and at the end what is known",
          "[supervision]") {
    const TemporaryFolder folder;
    const std::string file = folder.file("s.json");
    const std::vector<std::string> axes{"x", "y"};
    MachineState begins;
    begins.position_mm = {1.0, 2.0};
    write_state_file(file, {axes}, begins);
    const auto kept = [&] {
        return read_state_file(file, axes).value();
    };
    const StateFile kept_file(file, {axes});
    StateKeeper state(kept_file, begins);
    SignalWatch signals({});
    TalkingTarget target;
    const auto run = [&] {
        Supervision supervision(target, signals, nullptr, &state);
        REQUIRE(supervision.submit(segment(0)));
        static_cast<void>(supervision.finish());
    };
    SECTION("while it runs") {
        Supervision supervision(target, signals, nullptr, &state);
        REQUIRE(supervision.submit(segment(0)));
        CHECK(kept().position_mm[0] == std::nullopt); // at once: a kill may come
        CHECK(kept().unknown_why.rfind("a run has not ended", 0) == 0);
    }
    SECTION("it stands") {
        target.stands = {{0, 5.0}, {1, 2.5, false}};
        run();
        CHECK(kept().position_mm[0] == 5.0);
        CHECK(kept().position_mm[1] == std::nullopt); // it does not answer
        CHECK(kept().unknown_why.rfind("when the last run ended", 0) == 0);
    }
    SECTION("nothing has moved") {
        target.refusal = "no";
        target.stands = {};
        run();
        CHECK(kept() == begins);
    }
    SECTION("homing was interrupted") {
        target.refusal = "no";
        target.stands = {{0, std::nullopt}, {1, std::nullopt}};
        run();
        CHECK(kept().position_mm[0] == std::nullopt);
    }
    SECTION("the target breaks") {
        target.stands = {{0, 5.0}, {1, 6.0}};
        target.breaks = true;
        run();
        CHECK(kept().position_mm[1] == 6.0);
    }
    SECTION("it cannot be written") {
        std::filesystem::create_directory(folder.file("gone"));
        const StateFile gone(folder.file("gone/s.json"), {axes});
        std::filesystem::remove(folder.file("gone"));
        StateKeeper nowhere(gone, begins);
        Supervision supervision(target, signals, nullptr, &nowhere);
        CHECK_THROWS_WITH(supervision.submit(segment(0)), Catch::Contains("/gone/s.json: cannot be written: "));
        static_cast<void>(supervision.finish());
        CHECK(target.told().empty());
    }
}

TEST_CASE("a planner that leaves before the end has the axes held", "[supervision]") {
    SignalWatch signals({});
    TalkingTarget target;
    {
        Supervision supervision(target, signals);
        REQUIRE(supervision.submit(segment(0)));
    }
    const Told told = target.told();
    CHECK(std::count(told.begin(), told.end(), "hold") == 1);
    CHECK(target.phase == hal::PortPhase::halted);
}
