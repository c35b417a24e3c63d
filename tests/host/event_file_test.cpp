// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"
#include "host_sim/program/event_file.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"

#include <fstream>

using namespace splinefeed::host;

namespace {

const char* const file = "splinefeed_events_test.csv";

std::vector<OperatorEvent> read(const std::string& text) {
    std::ofstream(file) << text;
    return read_event_file(file);
}

std::string refusal(const std::string& text) {
    return splinefeed_test::refusal_of([&] { static_cast<void>(read(text)); });
}

} // namespace

TEST_CASE("events in order of time", "[host][events]") {
    const auto events = read("# shift\nt,event,value\n0,hold\n\n0.5 , resume\r\n1,override,0.25\n1,abort,\n");
    REQUIRE(events.size() == 4);
    CHECK(events[0].operation == Operation::hold);
    CHECK(events[1].time_s == 0.5);
    CHECK(events[2].value == 0.25);
    CHECK(events[3].operation == Operation::abort);
    CHECK(read("").empty());
}

TEST_CASE("bad events are told with their line", "[host][events]") {
    const std::string at = std::string(file) + ":2: ";
    CHECK(refusal("1,hold\n0.5,resume\n").find(at + "0.5 s is before") == 0);
    CHECK(refusal("1,hold\n2,resmue\n") == at + "there is no event 'resmue'; did you mean 'resume'?");
    for (const char* row : {"2", "x,hold", "-1,hold", "2,override", "2,override,2.01", "2,override,-0.1",
                            "2,override,nan", "2,hold,1", "2,override,1,1", "1e9,hold"}) {
        CAPTURE(row);
        CHECK(refusal(std::string("1,hold\n") + row + "\n").find(at) == 0);
    }
}
