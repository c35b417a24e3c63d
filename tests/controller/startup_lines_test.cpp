// SPDX-License-Identifier: MIT
// Start-up lines of a controller that keeps them: when they are executed, and who has the answers.
#include "controller/kept_tool.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

constexpr std::size_t sector = KeptSettings::least_sector;

} // namespace

TEST_CASE("start-up lines are executed behind the start, a reset and $H, and not in an alarm", "[controller]") {
    RamFlash flash(sector);
    {
        KeptTool tool(flash);
        CHECK(tool.answer("$N0=G0X5\n", 10).empty()); // it is executed first, and written when the machine stands
        CHECK(flash.steps == 0);
        CHECK(tool.answer("", 1000) == "ok\r\n");
        CHECK(flash.steps > 0);
        CHECK(to_mm(tool.machine.position()[0]) == Approx(5.0).margin(1e-6));
        CHECK(tool.answer("$N1=G91\n") == "ok\r\n");
        CHECK(tool.answer("$N\n") == "$N0=G0X5\r\n$N1=G91\r\nok\r\n");
    }
    KeptTool tool(flash);
    const std::string both = ">G0X5:ok\r\n>G91:ok\r\n";
    CHECK(tool.answer("", 1000) == both);
    CHECK(to_mm(tool.machine.position()[0]) == Approx(5.0).margin(1e-6));
    CHECK(tool.answer("$G\n").find("G91") != std::string::npos);
    CHECK(tool.answer("\x18", 1000) == "\r\nGrbl 1.1h ['$' for help]\r\n" + both);
    CHECK(tool.answer("$H\n", 1000) == "ok\r\n" + both);
    CHECK(tool.answer("$HX\n", 1000) == "ok\r\n");
    tool.machine.alarm = Alarm::limit_switch;
    tool.answer("");
    tool.machine.alarm = Alarm::none;
    CHECK(tool.answer("\x18", 1000).find('>') == std::string::npos); // it is locked
    CHECK(tool.answer("$X\n", 1000).find('>') == std::string::npos);
    CHECK(tool.answer("$N0=\n$N1=\n") == "ok\r\nok\r\n");
    CHECK(tool.answer("\x18", 1000).find('>') == std::string::npos);
    KeptTool again(flash);
    CHECK(again.answer("", 1000).empty());
}

TEST_CASE("a start-up line that is stopped has no answer of a sender's line, and none is kept", "[controller]") {
    RamFlash flash(sector);
    {
        KeptTool tool(flash);
        CHECK(tool.answer("$N0=G4P0.5\n", 1000) == "ok\r\n");
    }
    KeptTool tool(flash);
    tool.answer("", 100); // in the dwell
    tool.controller->connect();
    CHECK(tool.answer("G21\n", 100) == "\r\nGrbl 1.1h ['$' for help]\r\n");
    CHECK(tool.answer("", 1000) == ">G4P0.5:ok\r\nok\r\n");
    CHECK(tool.answer("$N1=G0X50\n", 100).empty());
    CHECK(tool.answer("\x18", 2000).find("\r\nok") == std::string::npos);
    CHECK(value_of(tool.answer("$N\n"), "$N1").empty());
    CHECK(tool.answer("$N1=G0X20\n", 50).empty());
    CHECK(tool.answer("\x19", 2000) == "ok\r\n[MSG:Stop]\r\n");
    CHECK(value_of(tool.answer("$N\n"), "$N1").empty());
}

TEST_CASE("lines of a program are counted without start-up lines", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    tool.answer("$N0=G21\n$N1=G90\n");
    tool.answer("\x18", 10);
    CHECK(tool.answer("G0X1\nG0Q1\n").find("[MSG:Error: 2:") != std::string::npos);
}

TEST_CASE("a controller without a keeper has no start-up lines", "[controller]") {
    ControlledTool<double> tool;
    tool.send("$N0=G21\n$RST=*\n$800=0\n\x18");
    for (int ms = 0; ms < 300; ++ms) {
        tool.tick();
    }
    CHECK(tool.text.find("ok") == std::string::npos);
    CHECK(tool.text.find('>') == std::string::npos);
}
