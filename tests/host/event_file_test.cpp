// SPDX-License-Identifier: MIT
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
