// SPDX-License-Identifier: MIT
//
// What a drive's registers cannot carry is refused before anything moves, by the machine's limits.
#include "host/refusal.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/ports/modbus/pvt_target.hpp"
#include "host_sim/ports/modbus/setpoint_target.hpp"
#include "support/catch.hpp"

#include <functional>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

MachineDescription machine(double velocity_mm_s, double steps_per_mm) {
    MachineDescription out = default_machine();
    out.settings.axes = 2;
    out.axis_name = {"x", "y"};
    out.settings.axis[1].max_velocity_mm_s = velocity_mm_s;
    out.settings.axis[1].steps_per_mm = steps_per_mm;
    out.settings.axis[1].max_acceleration_mm_s2 = 1000.0;
    return out;
}

DriveTable blocks(MachineDescription& described, const std::string& profile, const std::string& keys = "") {
    described.drive = {"modbus-tcp://a?profile=" + profile + keys, "modbus-tcp://b?profile=" + profile + keys};
    return drive_table("modbus", described);
}

std::string refusal(const std::function<void()>& call) {
    return splinefeed_test::refusal_of<UsageError>(call);
}

bool contains(const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
    return text.find('\n') == std::string::npos;
}

} // namespace

TEST_CASE("Ranges: velocities that a segment of splinefeed-pvt cannot carry are refused with axis, value and range") {
    // At 19200 baud segments are 20 ms long: 8.4 million counts are just too many.
    const std::string told = refusal([] { check_pvt_range(machine(500.0, 838860.8), 20'000.0); });
    CHECK(contains(told, "axis y: 500 mm/s at 838860.8 counts/mm are 8388608 counts in a segment of 20.00 ms"));
    CHECK(contains(told, "splinefeed-pvt carries 8380228"));
    CHECK(refusal([] { check_pvt_range(machine(500.0, 838860.8), 19'900.0); }) == "accepted");
    CHECK(refusal([] { check_pvt_range(machine(100.0, 320.0), 100'000.0); }) == "accepted");
}

TEST_CASE("Ranges: registers of drives that follow target positions are compared with the machine's limits") {
    MachineDescription fast = machine(500.0, 10'000.0); // 5e6 counts/s; the register of oriental-az ends at 4e6
    const DriveTable oriental = blocks(fast, "oriental-az");
    const std::string told = refusal([&] { check_register_ranges(oriental, fast, 10'000); });
    CHECK(contains(told, "axis y: max_velocity_mm_s"));
    CHECK(contains(told, "the register profile_velocity of the profile oriental-az holds 0 to 4000000"));
    MachineDescription slow = machine(300.0, 10'000.0);
    CHECK(refusal([&] { check_register_ranges(oriental, slow, 10'000); }) == "accepted");
    slow.settings.axis[1].max_acceleration_mm_s2 = 200'000.0; // 2e9 counts/s^2 of 1e9
    CHECK(contains(refusal([&] { check_register_ranges(oriental, slow, 0); }), "the register profile_acceleration"));

    MachineDescription wide = machine(10.0, 1000.0);
    const DriveTable index = blocks(wide, "cia402-index");
    wide.travel[1] = Travel{-1'000'000.0, 1'000'000.0}; // 1e9 counts each way
    CHECK(refusal([&] { check_register_ranges(index, wide, 10'000); }) == "accepted");
    wide.settings.axis[1].steps_per_mm = 3000.0;
    CHECK(contains(refusal([&] { check_register_ranges(index, wide, 10'000); }),
                   "half of travel_mm is 3000000000 counts"));
}

TEST_CASE("Ramps: a drive that is told blocks ramps as the machine file says, and the path a quarter as hard") {
    MachineDescription described = machine(100.0, 320.0);
    const DriveTable table = blocks(described, "leadshine-pr");
    const auto wiring = target_wiring(table, described);
    CHECK(wiring[1].ramp_counts_s2 == Approx(1000.0 * 320.0));
    CHECK(wiring[1].fastest_counts_s == Approx(100.0 * 320.0));
    CHECK(wiring[1].acceleration_counts_s2 == Approx(250.0 * 320.0));
    const std::string lowered = fit_to_ramps(table, described);
    CHECK(contains(lowered, "it is planned with x 250 mm/s^2, y 250 mm/s^2"));
    CHECK(described.settings.axis[1].max_acceleration_mm_s2 == 250.0);
    CHECK(described.settings.axis[1].max_braking_mm_s2 == 0.0);

    MachineDescription stated = machine(100.0, 320.0);
    stated.settings.axis[1].max_braking_mm_s2 = 2000.0;
    const DriveTable harder = blocks(stated, "leadshine-pr", "&ramp=1.28e6"); // 4000 mm/s^2
    CHECK(target_wiring(harder, stated)[1].ramp_counts_s2 == 1.28e6);
    CHECK(contains(fit_to_ramps(harder, stated), "with y 1000 mm/s^2;"));
    CHECK(stated.settings.axis[1].max_acceleration_mm_s2 == 1000.0);
    CHECK(stated.settings.axis[1].max_braking_mm_s2 == 1000.0);
    CHECK(fit_to_ramps(harder, stated).empty());

    MachineDescription cyclic = machine(100.0, 320.0);
    CHECK(fit_to_ramps(blocks(cyclic, "cia402-index"), cyclic).empty());
    CHECK(cyclic.settings.axis[1].max_acceleration_mm_s2 == 1000.0);
}

TEST_CASE("Wiring: an inverted axis is turned on its way to the drive, and keys of the profile reach the port") {
    MachineDescription described = machine(100.0, 320.0);
    described.inverted[1] = true;
    const auto pvt = pvt_wiring(drive_table("modbus-tcp://a?following_window=9", described), described);
    REQUIRE(pvt.size() == 1);
    CHECK(pvt[0].axes == std::vector<hal::modbus::PvtAxis>{{0, false, 3}, {1, true, 3}}); // 0.01 mm
    CHECK(pvt[0].following_window == 9);
    CHECK(pvt[0].watchdog_ms == 1000);
    CHECK(pvt[0].both_in_one);
    CHECK(pvt[0].timing.retries == 3);
    CHECK_FALSE(pvt_wiring(drive_table("modbus-tcp://a", described), described)[0].following_window.has_value());
    CHECK(target_wiring(blocks(described, "leadshine-pr"), described)[1].inverted);
}
