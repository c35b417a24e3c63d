// SPDX-License-Identifier: MIT
//
// The commands that speak to drives, from the command line: link, and run with --target.
#include "drive/drive_process.hpp"
#include "host_sim/drive/reserved_port.hpp"
#include "support/catch.hpp"

#include <algorithm>

using splinefeed::host::ListenAddress;
using splinefeed::host::ReservedPort;
using splinefeed::test::Call;
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

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

void check_refusal(const Call& call, int status, const std::string& told) {
    CAPTURE(call.output, call.error, told);
    CHECK(call.status == status);
    CHECK(call.output.empty());
    CHECK(contains(call.error, told));
    CHECK(std::count(call.error.begin(), call.error.end(), '\n') == 1);
}

} // namespace

TEST_CASE("link and --target: bad usage is one line, exit status 2") {
    const Tool tool;
    tool.write("line.csv", line);
    tool.write("two.toml", "[path]\nmax_feed_mm_s = 100\n"
                           "[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n"
                           "drive = 'modbus-tcp://127.0.0.1:1'\n"
                           "[[axis]]\nname = 'y'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n");
    for (const auto& [arguments, told] : std::vector<std::pair<std::string, std::string>>{
             {"link", "name the drives with --target"},
             {"link --target sim", "there is nothing to test"},
             {"link --target modbus", "axis x has no drive"},
             {"link --target modbus -m two.toml", "axis y has no drive"},
             {"link --target modbus -m none.toml", "none.toml"},
             {"link --target modbus-tcp://h?untt=1", "did you mean 'unit'?"},
             {"link --target modbus-tcp://h --seconds 0", "a number from 0.1 to 3600"},
             {"link --target modbus-tcp://h --secs 1", "has no option '--secs'"},
             {"link --target modbus-tcp://h more", "'more'"},
             {"run line.csv --target gpio", "there is no such target"},
             {"run line.csv --target modbus-udp://h", "write modbus-tcp://HOST:PORT"},
             {"run line.csv --target modbus-tcp://h:0", "from 1 to 65535"},
             {"run line.csv --target 'modbus-rtu:///dev/x?baud=100'", "must be"},
             {"run line.csv --target modbus-tcp://h?profile=other", "profile"},
             {"run line.csv --target modbus", "axis x has no drive"},
         }) {
        CAPTURE(arguments);
        check_refusal(tool(arguments), 2, told);
    }
    CHECK(tool.holds_only("line.csv two.toml"));
}

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
          "word order: high word first", "round trip of a status read: half below", "lost: 0 of ",
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
