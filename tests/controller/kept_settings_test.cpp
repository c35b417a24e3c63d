// SPDX-License-Identifier: MIT
// Settings and offsets of a controller that keeps them: what lasts, and when they change.
#include "controller/kept_tool.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

constexpr std::size_t sector = KeptSettings::least_sector;

/// All that is kept, as a machine that is switched on says it.
std::string kept_text(RamFlash& flash) {
    flash.power_on();
    KeptTool tool(flash);
    tool.answer("");
    return tool.answer("$$\n$#\n$N\n");
}

bool ends_with_ok(const std::string& text) {
    return text.size() >= 4 && text.substr(text.size() - 4) == "ok\r\n";
}

} // namespace

TEST_CASE("settings, offsets and start-up lines last", "[controller]") {
    RamFlash flash(sector);
    std::string before;
    {
        KeptTool tool(flash);
        CHECK(tool.problem.empty());
        CHECK(value_of(tool.answer("$$\n"), "$800") == "0.000");
        CHECK(tool.answer("$100=200\n$112=600.5\n$3=2\n$30=24000\n$27=2.5\n$132=75\n$10=7\n$13=1\n$13=0\n") ==
              "ok\r\nok\r\nok\r\nok\r\nok\r\nok\r\nok\r\nok\r\nok\r\n");
        CHECK(tool.answer("G10L2P1X5Y6Z-7\nG10L2P9X1\nG28.1\nG0X3\nG30.1\nG92X1\nG43.1Z2\n", 1000) ==
              "ok\r\nok\r\nok\r\nok\r\nok\r\nok\r\nok\r\n");
        CHECK(tool.answer("$N0=G21 G90\n$N1= (second) G54\n") == "ok\r\nok\r\n");
        before = tool.answer("$$\n$#\n$N\n");
    }
    CHECK(kept_text(flash) == before);
    CHECK(value_of(before, "$100") == "200.000");
    CHECK(value_of(before, "$112") == "600.500");
    CHECK(value_of(before, "$132") == "75.000");
    CHECK(value_of(before, "$10") == "7");
    CHECK(value_of(before, "$N1") == "(second) G54");
    CHECK(before.find("[G54:5.000,6.000,-7.000]") != std::string::npos);
    CHECK(before.find("[G59.3:1.000,0.000,0.000]") != std::string::npos);
    CHECK(before.find("[G30:8.000,0.000,0.000]") != std::string::npos);
    CHECK(before.find("[TLO:2.000]") != std::string::npos);
    CHECK(before.find("[G92:0.000") == std::string::npos);
}

TEST_CASE("a number that is set acts on the next move", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    tool.answer("$110=600\n$100=80\n$130=20\n$20=1\n"); // 10 mm/s
    tool.answer("G0X10\n", 900);
    CHECK(tool.controller->state() == ControllerState::run);
    tool.answer("", 400);
    CHECK(tool.controller->state() == ControllerState::idle);
    CHECK(to_mm(tool.machine.position()[0]) == Approx(10.0).margin(1e-6));
    CHECK(tool.answer("G0X20.1\n", 3000).find("ALARM:2") != std::string::npos); // the travel, too
    CHECK(tool.answer("\x18").find("Grbl") != std::string::npos);
    CHECK(ends_with_ok(tool.answer("$20=0\n")));
    CHECK(ends_with_ok(tool.answer("G0X30\n", 3000)));
    CHECK(to_mm(tool.machine.position()[0]) == Approx(30.0).margin(1e-6));
}

TEST_CASE("settings change at rest alone", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    const std::size_t steps = flash.steps;
    tool.answer("G1X50F3000\n", 400);
    CHECK(tool.answer("$100=200\n", 20) == "error:8\r\n");
    CHECK(tool.answer("$N0=G21\n", 20) == "error:8\r\n");
    CHECK(tool.answer("$RST=$\n", 20) == "error:8\r\n");
    CHECK(tool.answer("$RST=*\n", 20) == "error:8\r\n");
    tool.answer("!", 300);
    CHECK(tool.controller->state() == ControllerState::hold);
    CHECK(tool.answer("$100=200\n", 20) == "error:8\r\n");
    tool.answer("~", 2000);
    CHECK(flash.steps == steps);
    CHECK(tool.answer("$100=200\n", 20) == "ok\r\n");
    CHECK(flash.steps > steps);
    tool.answer("$C\n");
    CHECK(tool.answer("$100=210\n", 20) == "error:8\r\n");
}

TEST_CASE("settings may be set in an alarm, and stay through a reset", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    tool.machine.alarm = Alarm::limit_switch;
    tool.answer("");
    REQUIRE(tool.controller->state() == ControllerState::alarm);
    CHECK(tool.answer("$21=1\n") == "ok\r\n");
    tool.machine.alarm = Alarm::none;
    tool.answer("\x18");
    CHECK(value_of(tool.answer("$$\n"), "$21") == "1");
}

TEST_CASE("offsets are written when the machine stands, not while it moves", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    tool.answer("G1X50F3000\nG10L2P2X9\nX60\n", 200);
    REQUIRE(tool.controller->state() == ControllerState::run);
    CHECK(flash.steps == 0);
    tool.answer("", 3000);
    REQUIRE(tool.controller->state() == ControllerState::idle);
    CHECK(flash.steps > 0);
    CHECK(kept_text(flash).find("[G55:9.000,0.000,0.000]") != std::string::npos);
}

TEST_CASE("an offset that is answered at rest is kept already", "[controller]") {
    RamFlash flash(sector);
    {
        KeptTool tool(flash);
        tool.controller->receive("G10L2P2X9\n", 1000);
        while (tool.text.find("ok") == std::string::npos) {
            tool.controller->execute(1000);
            std::array<char, 64> part{};
            tool.text.append(part.data(), tool.controller->take_answers(part));
        }
    }
    CHECK(kept_text(flash).find("[G55:9.000,0.000,0.000]") != std::string::npos);
}

TEST_CASE("what is refused changes nothing, and says what would be right", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    const std::string before = tool.answer("$$\n");
    const auto [line, said] = GENERATE(table<std::string, std::string>({
        {"$100=0", "[MSG:$100 is a number from 0.001 to 1000000]\r\nerror:53\r\n"},
        {"$11=0.02", "[MSG:$11 is fixed]\r\nerror:53\r\n"},
        {"$11=0.01", "[MSG:$11 is fixed]\r\nerror:53\r\n"},
        {"$800=0.5",
         "[MSG:max_jerk_mm_s3 must lie between 1 and 1000000000; without it there is no limit]\r\nerror:53\r\n"},
        {"$800=50", "[MSG:this machine has no limit of the jerk: $800 is 0]\r\nerror:53\r\n"},
        {"$31=20000", "[MSG:$31, the lowest speed of the spindle, is at most $30]\r\nerror:53\r\n"},
        {"$140=5", "error:3\r\n"},
        {"$-1=5", "error:3\r\n"},
        {"$100=", "error:3\r\n"},
        {"$RST=&", "[MSG:*]\r\nerror:53\r\n"},
        {"$N2=G21", "error:3\r\n"},
        {"$N0G21", "error:3\r\n"},
        {"$N0=G1X1", "[MSG:Error: $N0:*]\r\nerror:22\r\n"},
        {"$N1=" + std::string(81, ' '), "ok\r\n"},
        {"$N1=G4P0.1" + std::string(75, '0'), "[MSG:A start-up line has at most 80 characters]\r\nerror:14\r\n"},
        {"$N0=$H", "[MSG:A start-up line is G-code]\r\nerror:3\r\n"},
        {"$I=x", "[MSG:*]\r\nerror:53\r\n"},
    }));
    CAPTURE(line);
    const std::string text = tool.answer(line + "\n");
    if (said.find('*') == std::string::npos) {
        CHECK(text == said);
    } else {
        CHECK(text.substr(0, said.find('*')) == said.substr(0, said.find('*')));
        CHECK(text.find(said.substr(said.rfind('*') + 1)) != std::string::npos);
    }
    CHECK(tool.answer("$$\n") == before);
    CHECK(value_of(tool.answer("$N\n"), "$N0").empty());
    CHECK(flash.steps == 0);
    CHECK(ends_with_ok(tool.answer("G0X10\n", 1000)));
    CHECK(to_mm(tool.machine.position()[0]) == Approx(10.0).margin(1e-6));
}

TEST_CASE("a power loss at any byte of a setting leaves the old number or the new one", "[controller]") {
    RamFlash flash(sector);
    const bool full = GENERATE(false, true); // the other sector is next
    {
        KeptTool tool(flash);
        tool.answer("G10L2P1X5\n$N0=G21\n$100=300\n");
        for (int i = 0; full && flash.content(0)[sector - 16] == 0xFF; ++i) {
            tool.answer(fmt::format("$101={}\n", 300 + i), 2);
        }
    }
    const std::string before = kept_text(flash);
    RamFlash whole = flash;
    whole.power_on();
    {
        KeptTool tool(whole);
        CHECK(tool.answer("$100=200\n", 2) == ">G21:ok\r\nok\r\n");
    }
    const std::size_t steps = whole.steps;
    const std::string behind = kept_text(whole);
    REQUIRE(before != behind);
    CHECK((full ? steps > 100 : steps == 16));
    int news = 0;
    for (std::size_t cut = 0; cut < steps; ++cut) {
        RamFlash torn = flash;
        torn.power_on();
        torn.random.seed(static_cast<unsigned>(cut));
        torn.cut_after = cut;
        std::string said;
        {
            KeptTool tool(torn);
            said = tool.answer("$100=200\n", 2);
        }
        const std::string found = kept_text(torn);
        CAPTURE(cut);
        REQUIRE((found == before || found == behind));
        REQUIRE((said.find("\nok") == std::string::npos || found == behind));
        news += found == behind ? 1 : 0;
    }
    CHECK(news < static_cast<int>(steps));
}

TEST_CASE("a power loss while all is forgotten leaves all or nothing", "[controller]") {
    const auto [line, what] =
        GENERATE(table<std::string, std::string>({{"$RST=$", "$"}, {"$RST=#", "#"}, {"$RST=*", "*"}}));
    CAPTURE(line);
    RamFlash flash(sector);
    const std::string usual = kept_text(flash);
    {
        KeptTool tool(flash);
        tool.answer("$100=300\n$111=900\n$13=1\n$13=0\n$10=1\nG10L2P1X5\nG10L2P2Y5\n$N0=G21\n$N1=G90\n");
    }
    const std::string before = kept_text(flash);
    RamFlash whole = flash;
    whole.power_on();
    {
        KeptTool tool(whole);
        tool.answer("");
        const std::string said = tool.answer(line + "\n");
        CHECK(said.find(what == "#" ? "ok\r\n" : "[MSG:Restoring defaults]\r\nok\r\n") == 0);
        CHECK((what == "#") == (said.find("Grbl") == std::string::npos)); // a reset follows, as with grbl
    }
    const std::size_t steps = whole.steps;
    const std::string behind = kept_text(whole);
    CHECK((what != "*" || behind == usual));
    CHECK((what == "#") == (value_of(behind, "$100") == "300.000"));
    CHECK((what == "$") == (behind.find("[G54:5.000") != std::string::npos));
    CHECK((what == "*") == (value_of(behind, "$N1").empty()));
    for (std::size_t cut = 0; cut < steps; ++cut) {
        RamFlash torn = flash;
        torn.power_on();
        torn.cut_after = cut;
        KeptTool(torn).answer(line + "\n", 2);
        const std::string found = kept_text(torn);
        CAPTURE(cut);
        REQUIRE((found == before || found == behind));
    }
}

TEST_CASE("what is forgotten is so at once, and a reset forgets G92 and the tool for good", "[controller]") {
    RamFlash flash(sector);
    KeptTool tool(flash);
    const std::string usual = tool.answer("$$\n$#\n");
    tool.answer("$110=600\n$10=1\n$13=1\n$13=0\n$RST=$\n");
    CHECK(tool.answer("$$\n$#\n") == usual);
    tool.answer("G0X10\n", 500);
    CHECK(to_mm(tool.machine.position()[0]) == Approx(10.0).margin(1e-6)); // at 100 mm/s again
    tool.answer("G10L2P1X5\nG92X1\nG43.1Z2\n$RST=*\n");
    CHECK(tool.answer("$$\n$#\n") == usual);
    tool.answer("G10L2P1X5\nG92X1\nG43.1Z2\n");
    CHECK(kept_text(flash).find("[TLO:2.000]") != std::string::npos);
    tool.answer("\x18");
    const std::string kept = kept_text(flash);
    CHECK(kept.find("[TLO:0.000]") != std::string::npos);
    CHECK(kept.find("[G92:0.000,0.000,0.000]") != std::string::npos);
    CHECK(kept.find("[G54:5.000,0.000,0.000]") != std::string::npos);
}

TEST_CASE("whatever a sender does, nothing is written in motion, and what stands at the end lasts", "[controller]") {
    const unsigned seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    std::mt19937 random(seed);
    constexpr std::string_view parts[] = {
        "G0X5\n",
        "G1X50Y20F3000\n",
        "G10L2P1X3Y4\n",
        "G10L20P0X1\n",
        "G92X2\n",
        "G92.1\n",
        "G43.1Z1\n",
        "G28.1\n",
        "G55\n",
        "G91G0X1\nG90\n",
        "$100=200\n",
        "$110=3000\n",
        "$120=500\n",
        "$130=90\n",
        "$20=1\n",
        "$22=9\n",
        "$23=1\n",
        "$10=1\n",
        "$N0=G0X1\n",
        "$N1=G54\n",
        "$N0=\n",
        "$RST=#\n",
        "$RST=$\n",
        "$RST=*\n",
        "$J=X10F2000\n",
        "$H\n",
        "$X\n",
        "$C\n",
        "$SLP\n",
        "M3S500\n",
        "G4P0.05\n",
        "M0\n",
        "M2\n",
        "G1Q1\n",
        "!",
        "~",
        "\x18",
        "\x19",
        "\x84",
        "\x85",
        "\x89",
        "?",
    };
    for (int round = 0; round < splinefeed_test::rounds(15); ++round) {
        RamFlash flash(sector);
        KeptTool tool(flash);
        flash.on_write = [&] {
            CHECK_FALSE(tool.machine.moves());
        };
        for (int i = 0; i < 60; ++i) {
            tool.answer(parts[random() % std::size(parts)], static_cast<int>(random() % 150));
            if (random() % 20 == 0) {
                tool.controller->disconnect();
                tool.controller->connect();
            }
        }
        tool.answer("\x18", 1500);
        tool.answer("\x18", 1500); // of what began behind the first one
        tool.answer("$X\n", 1500);
        const std::string before = tool.answer("$$\n$#\n$N\n");
        flash.on_write = [] {
        };
        REQUIRE(before.find("$132=") != std::string::npos);
        CHECK(kept_text(flash) == before.substr(before.find("$0=")));
    }
}

TEST_CASE("a flash that takes nothing leaves the machine as it was", "[controller]") {
    RamFlash flash(sector);
    flash.worn = 0;
    KeptTool tool(flash);
    const std::string before = tool.answer("$$\n");
    CHECK(tool.answer("$100=200\n").find("[MSG:The flash") == 0);
    CHECK(tool.answer("$$\n") == before);
    CHECK(tool.answer("$N0=G21\n").find("error:53") != std::string::npos);
    CHECK(ends_with_ok(tool.answer("G0X10\n", 1000)));
    CHECK(to_mm(tool.machine.position()[0]) == Approx(10.0).margin(1e-6));
}

TEST_CASE("what this machine cannot take of the flash is left out", "[controller]") {
    RamFlash flash(sector);
    const auto put = [&](std::uint16_t key, std::vector<std::uint8_t> value) {
        SettingLog log(flash);
        const LogEntry entry{key, value};
        REQUIRE(log.keep({&entry, 1}));
    };
    const std::string usual = kept_text(flash);
    SECTION("numbers out of range, of another form, or unknown") {
        put(100, {0, 0, 0, 0, 0, 0, 0, 0x80});
        put(101, {1, 2, 3});
        put(22, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F});
        put(999, {1, 2, 3, 4, 5, 6, 7, 8});
        put(0x1000, {1, 2, 3, 4, 5, 6, 7, 8});            // offsets of one axis
        put(0x1001, std::vector<std::uint8_t>(32, 0x40)); // of three, a million km away
        CHECK(kept_text(flash) == usual);
    }
    SECTION("numbers that do not fit together: all are those of the firmware, and it says so") {
        put(100, {0, 0x10, 0xA5, 0xD4, 0xE8, 0, 0, 0});      // 1000
        put(31, {0, 0x80, 0xC6, 0xA4, 0x7E, 0x8D, 0x03, 0}); // 1000000 rpm
        flash.power_on();
        KeptTool tool(flash);
        CHECK(tool.problem == "$31, the lowest speed of the spindle, is at most $30");
        CHECK(value_of(tool.answer("$$\n"), "$100") == "320.000");
    }
}
