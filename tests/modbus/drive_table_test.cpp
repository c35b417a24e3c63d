// SPDX-License-Identifier: MIT
#include "host_sim/config/drive_table.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

using Axes = std::vector<int>;

MachineDescription machine(const std::vector<std::string>& drives) {
    MachineDescription out;
    out.file = "m.toml";
    out.settings.axes = static_cast<int>(drives.size());
    constexpr const char* names[] = {"x", "y", "z", "a", "b", "c"};
    for (std::size_t k = 0; k < drives.size(); ++k) {
        out.axis_name[k] = names[k];
        out.drive[k] = drives[k];
    }
    return out;
}

} // namespace

TEST_CASE("Drive table: one address is one drive with all axes, in order") {
    const DriveTable table = drive_table("modbus-tcp://drive:1502?unit=9", machine({"", "", ""}));
    REQUIRE(table.drives.size() == 1);
    CHECK(table.drives[0].machine_axis == Axes{0, 1, 2});
    CHECK(table.drives[0].address.link.unit == 9);
    CHECK(table.drives[0].address.link.port == 1502);
    CHECK(table.drives[0].address.text == "modbus-tcp://drive:1502?unit=9");
    // What the machine file says does not count then.
    CHECK(drive_table("modbus-tcp://drive", machine({"", "no address", ""})).drives.size() == 1);
}

TEST_CASE("Drive table: axes with the same address and unit share a drive, others have their own") {
    const DriveTable table = drive_table("modbus", machine({"modbus-tcp://a?unit=1&axis=1", "modbus-tcp://b?unit=1",
                                                            "modbus-tcp://a?unit=1", "modbus-tcp://a?unit=2"}));
    REQUIRE(table.drives.size() == 3);
    CHECK(table.drives[0].machine_axis == Axes{2, 0});
    CHECK(table.drives[1].machine_axis == Axes{1});
    CHECK(table.drives[2].machine_axis == Axes{3});
    CHECK(table.drives[1].address.link.host == "b");
    CHECK(table.drives[2].address.link.unit == 2);
}

TEST_CASE("Drive table: an axis of a drive that no axis of the machine has is none") {
    const DriveTable table = drive_table("modbus", machine({"modbus-tcp://a?axis=2", "modbus-tcp://a?axis=0"}));
    REQUIRE(table.drives.size() == 1);
    CHECK(table.drives[0].machine_axis == Axes{1, -1, 0});
}

TEST_CASE("Drive table: what goes together") {
    CHECK(drive_table("modbus", machine({"modbus-rtu:///dev/x?unit=1", "modbus-rtu:///dev/x?unit=2"})).drives.size() ==
          2);
    CHECK(drive_table("modbus-tcp://a?profile=leadshine-pr&ramp=1e6", machine({""})).drives.size() == 1);
}

TEST_CASE("Drive table: a drive on rtu may be behind a gateway") {
    CHECK(drive_table("modbus-tcp://gateway?profile=leadshine-pr", machine({""})).drives.size() == 1);
}

TEST_CASE("Drive table: stop bits are the profile's with its parity, the standard's with another, or as stated") {
    const auto stops = [](const std::string& keys) {
        return drive_table("modbus-rtu:///dev/x?profile=cia402-kinco" + keys, machine({""}))
            .drives[0]
            .address.link.stops();
    };
    CHECK(stops("") == 1); // its makers have 8N1
    CHECK(stops("&parity=N") == 1);
    CHECK(stops("&parity=E") == 1);
    CHECK(stops("&stop=2") == 2);
    CHECK(drive_table("modbus-rtu:///dev/x?parity=N", machine({""})).drives[0].address.link.stops() == 2);
}

TEST_CASE("Drive table: the window of the following error is the drive's own unless a key says otherwise") {
    const auto window = [](const std::string& address) {
        return drive_table(address, machine({""})).drives[0].profile.following_error_window_counts;
    };
    CHECK_FALSE(window("modbus-tcp://a").has_value());
    CHECK(window("modbus-tcp://a?following_window=0") == 0);
    CHECK(window("modbus-tcp://a?following_window=500") == 500);
    const DriveTable shared =
        drive_table("modbus", machine({"modbus-tcp://a?axis=0", "modbus-tcp://a?axis=1&following_window=7"}));
    CHECK(shared.drives[0].profile.following_error_window_counts == 7);
}

TEST_CASE("Drive table: what an address leaves open is as the profile has it") {
    const DriveTable table =
        drive_table("modbus", machine({"modbus-rtu:///dev/x?profile=cia402-kinco&unit=7",
                                       "modbus-rtu:///dev/y?profile=cia402-kinco&baud=115200&parity=E"}));
    CHECK_FALSE(table.interpolate);
    CHECK(table.drives[0].address.link.unit == 7);
    CHECK(table.drives[0].address.link.baud == 19200);
    CHECK(table.drives[0].address.link.parity == 'N');
    CHECK(table.drives[1].address.link.unit == 1);
    CHECK(table.drives[1].address.link.baud == 115200);
    CHECK(table.drives[1].address.link.parity == 'E');
    CHECK(drive_table("modbus-tcp://a?profile=cia402-index", machine({""})).drives[0].address.link.unit == 255);
    CHECK(drive_table("modbus-tcp://a", machine({""})).interpolate);
}
