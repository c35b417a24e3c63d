// SPDX-License-Identifier: MIT
#include "host/refusal.hpp"
#include "host_sim/drive/drive_faults.hpp"
#include "host_sim/drive/listen_address.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace splinefeed::host;
using splinefeed_test::refusal_of;

namespace {

std::string refusal(const std::string& text) {
    return refusal_of<UsageError>([&] { static_cast<void>(parse_drive_faults(text)); });
}

} // namespace

TEST_CASE("drive faults: the whole list", "[drive][faults]") {
    const DriveFaults faults = parse_drive_faults(
        "drop=0.01,corrupt=0.02,exception=0.03,duplicate=0.04,stale=0.05,delay=20:0.5,delay=300:0.01,freeze@3:40,"
        "disconnect@1.5:200,power-cycle@9,swap-words@2,disconnect@7:1,clock-skew=-35.5,seed=18446744073709551615,"
        "short=0.06,foreign=0.07,echo=0.08,late=250:0.5,drip=9:0.1,mute=150:0.2,mute-at=3:150,dither=4");
    CHECK(faults.drop == 0.01);
    CHECK(faults.corrupt == 0.02);
    CHECK(faults.exception == 0.03);
    CHECK(faults.duplicate == 0.04);
    CHECK(faults.stale == 0.05);
    REQUIRE(faults.delays.size() == 2);
    CHECK(faults.delays[1].duration_ms == 300.0);
    CHECK(faults.delays[1].probability == 0.01);
    REQUIRE(faults.events.size() == 5);
    CHECK(faults.events[0].kind == DriveFaults::EventKind::disconnect);
    CHECK(faults.events[0].amount == 200.0);
    CHECK(faults.events[1].kind == DriveFaults::EventKind::swap_words);
    CHECK(faults.events[2].kind == DriveFaults::EventKind::freeze);
    CHECK(faults.events[4].time_s == 9.0);
    CHECK(faults.short_reply == 0.06);
    CHECK(faults.foreign == 0.07);
    CHECK(faults.echo == 0.08);
    CHECK(faults.late.at(0).duration_ms == 250.0);
    CHECK(faults.drips.at(0).probability == 0.1);
    CHECK(faults.mutes.at(0).duration_ms == 150.0);
    CHECK(faults.silences.at(0).request == 3.0);
    CHECK(faults.silences.at(0).duration_ms == 150.0);
    CHECK(faults.of_model(0.0) == ModelFaults{.dither_counts = 4});
    CHECK(faults.clock_skew_ppm == -35.5);
    CHECK(faults.seed == 18446744073709551615U);
    CHECK(faults.random());
    CHECK_FALSE(parse_drive_faults("").random());
    CHECK_FALSE(parse_drive_faults("freeze@1:2").random());
}

TEST_CASE("drive faults: what lasts, lasts from its instant on for its time", "[drive][faults]") {
    const DriveFaults faults = parse_drive_faults("refuse-stop@1:500,stuck-state@2:10,stuck-place@2:20,no-room@3:1,"
                                                  "state@4:99,state@5:6,flood@6:100");
    CHECK(faults.of_model(0.999) == ModelFaults{});
    CHECK(faults.of_model(1.0) == ModelFaults{.refuses_stops = true});
    CHECK(faults.of_model(1.5) == ModelFaults{});
    CHECK(faults.of_model(2.005) == ModelFaults{.stuck_state = true, .stuck_place = true});
    CHECK(faults.of_model(2.015) == ModelFaults{.stuck_place = true});
    CHECK(faults.of_model(3.0) == ModelFaults{.no_room = true});
    CHECK(faults.of_model(4.5) == ModelFaults{.state = 99});
    CHECK(faults.of_model(100.0) == ModelFaults{.state = 6}); // until the end
    CHECK(faults.lasts(DriveFaults::EventKind::flood, 6.05));
    CHECK_FALSE(faults.lasts(DriveFaults::EventKind::flood, 6.1));
}

TEST_CASE("drive faults: each is in the list, and an item that is written like it is taken", "[drive][faults]") {
    std::string list = list_drive_faults();
    CHECK(std::count(list.begin(), list.end(), ',') == 26);
    const std::pair<const char*, const char*> numbers[] = {
        {"MS", "10"}, {"PPM", "5"}, {"P", "0.5"}, {"S", "2"}, {"N", "3"}};
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t end = std::min(list.find(", ", at), list.size());
        std::string item = list.substr(at, end - at);
        const std::size_t sign = item.find_first_of("=@");
        REQUIRE(sign != std::string::npos);
        for (const auto& [letters, number] : numbers) {
            const std::size_t found = item.find(letters, sign);
            if (found != std::string::npos) {
                item.replace(found, std::string(letters).size(), number);
            }
        }
        CAPTURE(item);
        CHECK(refusal(item) == "accepted");
        CHECK(refusal(item + "x") != "accepted");
        at = end + 2;
    }
}

TEST_CASE("drive faults: an item without a name is none", "[drive][faults]") {
    for (const char* text : {",", "drop=0.1,,drop=0.2", "=1", "@"}) {
        CAPTURE(text);
        CHECK(refusal(text).find("': there is no such fault; known are drop, corrupt, ") != std::string::npos);
    }
}

TEST_CASE("drive faults: as often as asked, and the same again with the same seed", "[drive][faults]") {
    const DriveFaults asked = parse_drive_faults("drop=0.2,duplicate=0.1,delay=5:0.3,delay=100:0.3,stale=0.05");
    FaultDice dice(asked, 7);
    FaultDice again(asked, 7);
    int dropped[2] = {0, 0};
    int doubled[2] = {0, 0};
    int stale = 0;
    double delay_ms = 0.0;
    constexpr int many = 20000;
    for (int i = 0; i < many; ++i) {
        const ExchangeFaults faults = dice.next();
        const ExchangeFaults same = again.next();
        REQUIRE(faults.bits == same.bits);
        REQUIRE(faults.delay_ms == same.delay_ms);
        REQUIRE_FALSE((faults.drop_request && faults.drop_reply));
        CHECK_FALSE(faults.corrupt);
        CHECK_FALSE(faults.exception);
        dropped[0] += faults.drop_request ? 1 : 0;
        dropped[1] += faults.drop_reply ? 1 : 0;
        doubled[0] += faults.repeat_request ? 1 : 0;
        doubled[1] += faults.repeat_reply ? 1 : 0;
        stale += faults.stale ? 1 : 0;
        delay_ms += faults.delay_ms;
    }
    // The seed is fixed: five standard deviations once and for all.
    const auto near = [](int count, double p) {
        return std::fabs(count - many * p) < 5.0 * std::sqrt(many * p);
    };
    CHECK(near(dropped[0], 0.1));
    CHECK(near(dropped[1], 0.1));
    CHECK(near(doubled[0], 0.05));
    CHECK(near(doubled[1], 0.05));
    CHECK(near(stale, 0.05));
    CHECK(delay_ms / many == Approx(0.3 * 105.0).epsilon(0.05));
}

TEST_CASE("listen address: TCP and serial lines", "[drive][faults]") {
    CHECK(parse_listen_address("tcp://localhost:0", false).text() == "tcp://127.0.0.1:0");
    CHECK(parse_listen_address("tcp://0.0.0.0:5", true).host == "0.0.0.0");
    const ListenAddress line = parse_listen_address("rtu:///dev/pts/3?baud=19200&parity=N&unit=17&pace=off", false);
    CHECK(line.device == "/dev/pts/3");
    CHECK(line.text() == "rtu:///dev/pts/3?baud=19200&parity=N&unit=17&pace=off");
    CHECK(parse_listen_address("tcp://127.0.0.1:1502?unit=7", false).text() == "tcp://127.0.0.1:1502?unit=7");
    CHECK(line.character_us() == Approx(11e6 / 19200)); // two stop bits without parity
    CHECK(parse_listen_address("rtu:///dev/x?stop=1&parity=N", false).character_us() == Approx(10e6 / 115200));
}
