// SPDX-License-Identifier: MIT
//
// The commands that speak to drives, from the command line: link, and run with --target.
#include "drive/drive_process.hpp"
#include "host_sim/drive/drive_wire.hpp"
#include "support/catch.hpp"

#include <algorithm>

using splinefeed::host::ListenAddress;
using splinefeed::host::ReservedPort;
using splinefeed::test::Call;
using splinefeed::test::contains;
using splinefeed::test::DriveProcess;
using splinefeed::test::Tool;

namespace {

// 2 mm along x: a quarter of a second.
const std::string line = "x,y,z\n0,0,0\n2,0,0\n";

/// Of a drive, or of a port on which nobody listens.
template <class Owner>
std::string address(const Owner& owner) {
    return "modbus-tcp://127.0.0.1:" + std::to_string(owner.port());
}

void check_refusal(const Call& call, int status, const std::string& told) {
    CAPTURE(call.output, call.error, told);
    CHECK(call.status == status);
    CHECK(call.output.empty());
    CHECK(contains(call.error, told));
    CHECK(std::count(call.error.begin(), call.error.end(), '\n') == 1);
}

} // namespace

TEST_CASE("link and --target: a drive that cannot be used is one line, exit status 1, and nothing is written") {
    const Tool tool;
    tool.write("line.csv", line);
    const ReservedPort deaf(ListenAddress{});
    const std::string run = "run line.csv --trace t.csv --target ";
    check_refusal(tool("link --target " + address(deaf)), 1, address(deaf) + ": there is no connection");
    check_refusal(tool(run + address(deaf)), 1, address(deaf) + ": there is no connection");
    check_refusal(tool("link --target modbus-rtu:///dev/no-such-line"), 1, "/dev/no-such-line");
    const DriveProcess two(tool, "--listen tcp://127.0.0.1:0 --axes 2");
    check_refusal(tool(run + address(two)), 1, "it has fewer axes");
    const DriveProcess swapped(tool, "--listen tcp://127.0.0.1:0 --faults swap-words@0");
    check_refusal(tool(run + address(swapped)), 1, "low word first");
    check_refusal(tool("link --target " + address(swapped)), 1, "low word first");
    CHECK(tool.holds_only("line.csv .drive_error"));
}

TEST_CASE("link: who answers, how fast, and what that means") {
    const Tool tool;
    const DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --ring 100");
    const Call call = tool("link --seconds 0.2 --target " + address(drive));
    CAPTURE(call.output);
    CHECK(call.status == 0);
    CHECK(call.error.empty());
    for (const char* part :
         {"drive 1: modbus-tcp://127.0.0.1:", "splinefeed-pvt version 1, 3 axes, ring of 100 segments",
          "word order: high word first", "state: disabled, no fault\n  axis x: at 0 counts\n",
          "round trip of a status read: half below", "lost: 0 of ",
          "clock against ours:", "what that means:", "the machine file asks for 1.00 ms"}) {
        CAPTURE(part);
        CHECK(contains(call.output, part));
    }
    const DriveProcess lossy(tool, "--listen tcp://127.0.0.1:0 --faults exception=0.2,seed=3");
    const Call lost = tool("link --seconds 0.2 --target " + address(lossy));
    CAPTURE(lost.output);
    CHECK(lost.status == 0);
    CHECK(contains(lost.output, "% of the requests were lost"));
}

TEST_CASE("link: a drive in fault is told with its code, its axis and the way out, exit status 1") {
    const Tool tool;
    tool.write("line.csv", "0,0\n2,0\n");
    const DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --axes 2 --max-velocity 32000,1000");
    const auto axis = [&](const std::string& name, int place) {
        return "[[axis]]\nname = '" + name + "'\nmax_velocity_mm_s = 50\nmax_acceleration_mm_s2 = 1000\n" +
               "steps_per_mm = 320\ndrive = '" + address(drive) + "?axis=" + std::to_string(place) + "'\n";
    };
    tool.write("m.toml", "[path]\nmax_feed_mm_s = 50\n" + axis("x", 1) + axis("y", 0));
    const std::string fault = "code 3 on axis x: a limit of velocity, acceleration or travel";
    const Call run = tool("run line.csv -m m.toml --target modbus --quiet");
    CAPTURE(run.error);
    CHECK(run.status == 1);
    CHECK(contains(run.error, "m.toml:14: drive of y and x (" + address(drive) + "?axis=1): it is in fault, " + fault));
    const Call call = tool("link --seconds 0.2 -m m.toml --target modbus");
    CAPTURE(call.output, call.error);
    CHECK(call.status == 1);
    CHECK(contains(call.output, "  state: in fault, " + fault + "\n  axis y: at "));
    CHECK(contains(call.error, "it is in fault, " + fault + "; mend the cause, then run with --reset\n"));
}

TEST_CASE("run: a line on two drives, and what their shafts did") {
    const Tool tool;
    tool.write("line.csv", line);
    const auto axis = [](const std::string& name, const std::string& where) {
        return "[[axis]]\nname = '" + name + "'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n" +
               "steps_per_mm = 320\ndrive = '" + where + "'\n";
    };
    DriveProcess one(tool, "--listen tcp://127.0.0.1:0 --axes 2 --record one.csv");
    DriveProcess two(tool, "--listen tcp://127.0.0.1:0 --axes 1 --record two.csv");
    tool.write("m.toml", "[path]\nmax_feed_mm_s = 100\n" + axis("x", address(two)) +
                             axis("y", address(one) + "?axis=1") + axis("z", address(one)));
    const Call call = tool("run line.csv -m m.toml --target modbus --summary json --quiet");
    CAPTURE(call.error);
    CHECK(call.status == 0);
    CHECK(contains(call.output, "\"stopped\": false"));
    CHECK(one.stop() == 0);
    CHECK(two.stop() == 0);
    const auto last_row = [&](const std::string& file) {
        const std::string text = tool.read(file);
        const std::size_t before = text.rfind('\n', text.size() - 2);
        const std::string row = text.substr(before + 1);
        return row.substr(row.find(','));
    };
    CHECK(last_row("two.csv") == ",640.000000\n");
    CHECK(last_row("one.csv") == ",0.000000,0.000000\n");
}
