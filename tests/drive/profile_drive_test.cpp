// SPDX-License-Identifier: MIT
// Each shipped profile as a drive, driven as its profile says: by the fields and steps of the profile alone.
#include "host_sim/drive/profile_drive.hpp"

#include "drive/driven_drive.hpp"
#include "host/refusal.hpp"
#include "host_sim/config/profile_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;
using splinefeed::test::DrivenDrive;

namespace {

const std::vector<std::string> positioning{"cia402-kinco", "leadshine-pr", "oriental-az", "lexium32m"};

} // namespace

TEST_CASE("Profile drive: each profile enables, moves to a target with its speed, and says when it is there") {
    for (const std::string& name : positioning) {
        CAPTURE(name);
        DrivenDrive drive(name);
        CHECK(drive.state() == DriveState::disabled);
        drive.begin();
        CHECK(drive.state() == DriveState::enabled);
        drive.move(20000.0, 40000.0, 1e6);
        drive.wait_ms(100);
        CHECK(drive.model().axis().reference().velocity_counts_s() == Approx(40000.0).epsilon(5e-3));
        CHECK_FALSE(drive.done());
        drive.wait_ms(1000);
        CHECK(drive.done());
        CHECK(drive.state() == DriveState::enabled);
        CHECK(drive.position() == 20000);
        CHECK(drive.model().position_counts(0) == 20000.0);
        drive.move(-5000.0, 40000.0, 1e6);
        drive.wait_ms(1000);
        CHECK(drive.position() == -5000);
    }
}

TEST_CASE("Profile drive: a new target replaces the one under way, without a stop") {
    for (const std::string& name : positioning) {
        CAPTURE(name);
        DrivenDrive drive(name);
        drive.begin();
        drive.move(20000.0, 30000.0, 1e6);
        drive.wait_ms(300);
        drive.move(40000.0, 30000.0, 1e6);
        double slowest = 1e9;
        for (int i = 0; i < 500; ++i) {
            drive.wait_ms(1);
            slowest = std::min(slowest, drive.model().axis().reference().velocity_counts_s());
        }
        CHECK(slowest > 29000.0);
        drive.wait_ms(1500);
        CHECK(drive.position() == 40000);
    }
}

TEST_CASE("Profile drive: quick stop, fault, fault reset and enable again, as each profile says") {
    for (const ShippedProfile& shipped : shipped_profiles()) {
        const std::string name(shipped.name);
        if (name == "splinefeed-pvt" || name.rfind("vfd-", 0) == 0) {
            continue;
        }
        CAPTURE(name);
        DrivenDrive drive(name);
        drive.begin();
        drive.move(1e6, 50000.0, 1e6);
        drive.wait_ms(11);
        drive.command(DriveCommand::quick_stop);
        drive.wait_ms(100);
        CHECK_FALSE(drive.model().axis().moving());
        const double here = drive.model().position_counts(0);
        CHECK((here < 900000.0 || drive.profile().stream == StreamWay::cyclic)); // that is there after a period

        drive.model().axis().trip(AxisFault::following_error);
        drive.wait_ms(10);
        CHECK(drive.state() == DriveState::fault);
        CHECK((drive.profile().field_of(FieldRole::fault_code) == nullptr || drive.read(FieldRole::fault_code) != 0));
        drive.command(DriveCommand::enable);
        CHECK(drive.state() == DriveState::fault);
        drive.command(DriveCommand::fault_reset);
        // Oriental's enable is a level, and stands in the frame of the reset as well.
        CHECK(drive.state() == (name == "oriental-az" ? DriveState::enabled : DriveState::disabled));
        drive.begin();
        CHECK(drive.state() == DriveState::enabled);
        CHECK(drive.model().position_counts(0) == Approx(here).margin(1.0));
        drive.command(DriveCommand::disable);
        CHECK(drive.state() == DriveState::disabled);
    }
}

// CS2RS-D503 manual, pages 26 and 59: the software enable can only add to input SI1, which is closed without a wire.
TEST_CASE("Profile drive: an input that keeps the motor on does so through a disable") {
    DriveProfile factory = find_profile("leadshine-pr");
    REQUIRE(factory.stays_on.size() == 1);
    RegisterField& input = factory.fields[factory.stays_on.front().test.field];
    CHECK(input.address == 0x0145);
    CHECK(input.value == 0); // as the profile wants it: no function
    input.value = 0x0088;    // enable, normally closed
    DrivenDrive drive(factory, {});
    PositioningAxis& axis = drive.model().axis();
    CHECK(drive.state() == DriveState::enabled);
    drive.begin();
    drive.move(20000.0, 30000.0, 1e6);
    drive.wait_ms(200);
    drive.command(DriveCommand::disable);
    CHECK(axis.power() == AxisPower::on);
    drive.wait_ms(1000);
    CHECK(drive.position() == 20000); // it has not even stopped
    drive.model().power_cycle();
    CHECK(axis.power() == AxisPower::on);
    axis.trip(AxisFault::following_error);
    drive.wait_ms(10);
    CHECK(axis.power() == AxisPower::fault);
    drive.command(DriveCommand::fault_reset);
    CHECK(axis.power() == AxisPower::on);

    DrivenDrive right("leadshine-pr");
    right.begin();
    CHECK(right.model().axis().power() == AxisPower::on);
    right.command(DriveCommand::disable);
    CHECK(right.model().axis().power() == AxisPower::off);
}

TEST_CASE("Profile drive: homing where the profile has it") {
    for (const std::string& name : {std::string("cia402-kinco"), std::string("leadshine-pr"),
                                    std::string("oriental-az"), std::string("cia402-index")}) {
        CAPTURE(name);
        DrivenDrive drive(name, 3000.0);
        drive.begin();
        if (drive.profile().homing_mode) {
            drive.write(FieldRole::mode, *drive.profile().homing_mode);
        }
        drive.command(DriveCommand::home);
        drive.wait_ms(2000);
        CHECK(drive.position() == 0);
        if (drive.profile().homed) {
            CHECK(holds(*drive.profile().homed, drive.read(FieldRole::status)));
        }
    }
}

TEST_CASE("Profile drive: Lexium halts and goes on; its reads are 0 before the first write") {
    DrivenDrive drive("lexium32m", 777.0);
    CHECK(drive.raw_read(FieldRole::actual_position) == 0);
    drive.begin();
    CHECK(drive.position() == 777);
    drive.move(20000.0, 30000.0, 1e6);
    drive.wait_ms(200);
    drive.command(DriveCommand::halt);
    drive.wait_ms(200);
    CHECK(drive.state() == DriveState::halted);
    CHECK_FALSE(drive.done());
    const auto stands = drive.position();
    CHECK(stands < 20000);
    drive.command(DriveCommand::resume);
    drive.wait_ms(2000);
    CHECK(drive.position() == 20000);

    drive.move(0.0, 30000.0, 1e6);
    drive.wait_ms(200);
    drive.write(FieldRole::control, 0x2081); // halt: an edge
    drive.wait_ms(200);
    CHECK(drive.state() == DriveState::halted);
    drive.write(FieldRole::control, 0xE081); // go on, though that bit still stands
    drive.wait_ms(10);
    CHECK(drive.state() == DriveState::moving);

    drive.write(FieldRole::control, 0x0481); // quick stop
    drive.wait_ms(200);
    CHECK(drive.state() == DriveState::quick_stop);
    drive.write(FieldRole::control, 0x0C81); // left by a fault reset, though that bit, too, still stands
    CHECK(drive.state() == DriveState::enabled);
}

TEST_CASE("Profile drive: a fault on the way brakes first") {
    DrivenDrive drive("oriental-az");
    drive.begin();
    drive.move(1e6, 50000.0, 1e6);
    drive.wait_ms(200);
    const double here = drive.model().position_counts(0);
    drive.model().axis().trip(AxisFault::watchdog);
    drive.wait_ms(1);
    CHECK(drive.model().axis().power() == AxisPower::stopping_fault);
    CHECK(drive.state() == DriveState::fault);
    drive.wait_ms(100);
    CHECK(drive.model().axis().power() == AxisPower::fault);
    CHECK(drive.model().position_counts(0) == Approx(here + 50000.0 * 50000.0 / 4e6).margin(1.0));
}

TEST_CASE("Profile drive: cyclic targets are reached a period later, on a line") {
    ProfileDriveParameters parameters;
    parameters.period_us = 2000;
    DrivenDrive drive(find_profile("cia402-index"), parameters);
    drive.begin();
    for (int i = 1; i <= 50; ++i) {
        drive.write_physical(FieldRole::target_position, 20.0 * i);
        drive.wait_ms(1);
        CHECK(drive.model().position_counts(0) == Approx(20.0 * i - 10.0));
        drive.wait_ms(1);
        CHECK(drive.model().position_counts(0) == Approx(20.0 * i));
    }
    drive.wait_ms(50);
    CHECK(drive.position() == 1000);
    drive.command(DriveCommand::halt);
    drive.write_physical(FieldRole::target_position, 2000.0);
    drive.wait_ms(50);
    CHECK(drive.position() == 1000);
}

TEST_CASE("Profile drive: the set-point handshake of CiA 402, bit 4 against bit 12, at once or one after the other") {
    DrivenDrive drive("cia402-kinco");
    drive.begin();
    const auto status = [&drive] {
        return drive.read(FieldRole::status);
    };
    drive.write_physical(FieldRole::profile_velocity, 50000.0);
    drive.write_physical(FieldRole::profile_acceleration, 1e6);
    drive.write_physical(FieldRole::profile_deceleration, 1e6);
    drive.write_physical(FieldRole::target_position, 10000.0);
    CHECK((status() & 0x1000) == 0);
    drive.write(FieldRole::control, 0x001F);
    CHECK((status() & 0x1000) != 0);
    drive.wait_ms(20);
    drive.write(FieldRole::control, 0x000F);
    CHECK((status() & 0x1000) == 0);
    drive.write_physical(FieldRole::target_position, 20000.0); // without bit 5: when the first one is done
    drive.write(FieldRole::control, 0x001F);
    double slowest = 1e9;
    for (int i = 0; i < 400; ++i) {
        drive.wait_ms(1);
        if (drive.model().position_counts(0) < 15000.0) {
            slowest = std::min(slowest, drive.model().axis().reference().velocity_counts_s());
        }
    }
    CHECK(slowest < 3000.0);
    drive.wait_ms(500);
    CHECK(drive.position() == 20000);
    drive.write(FieldRole::control, 0x006F); // relative
    drive.write_physical(FieldRole::target_position, -500.0);
    drive.write(FieldRole::control, 0x007F);
    drive.wait_ms(500);
    CHECK(drive.position() == 19500);
    drive.write_physical(FieldRole::target_position, 100.0); // no edge: nothing
    drive.wait_ms(100);
    CHECK(drive.position() == 19500);
    drive.write(FieldRole::control, 0x103F); // each new target at once
    drive.write_physical(FieldRole::target_position, 200.0);
    drive.wait_ms(1000);
    CHECK(drive.position() == 200);
}

TEST_CASE("Profile drive: frames that a drive refuses change nothing") {
    DrivenDrive drive("leadshine-pr");
    std::array<std::uint16_t, 8> registers{};
    ProfileDrive& model = drive.model();
    CHECK(model.read(0x7000, registers) == ModbusException::illegal_address);
    CHECK(model.write(0x7000, registers) == ModbusException::illegal_address);
    CHECK(model.write(0x1003, std::span(registers).first(1)) == ModbusException::illegal_address); // read only
    CHECK(model.read(0x602D, std::span(registers).first(1)) == ModbusException::illegal_address);  // half a number
    CHECK(model.read(0x602C, std::span(registers).first(1)) == ModbusException::illegal_address);
    CHECK(model.write(0x6202, std::span(registers).first(2)) == ModbusException::illegal_address);
    CHECK(model.read(0x602C, std::span(registers).first(2)) == ModbusException::none);
    drive.begin();
    registers = {1, 0, 5000, 0xFFFF, 100, 100, 0, 0x10}; // a speed beyond the clamp
    CHECK(model.write(0x6200, registers) == ModbusException::illegal_value);
    drive.wait_ms(100);
    CHECK(drive.position() == 0);
    CHECK(model.read(-1, std::span(registers).first(1)) == ModbusException::illegal_address);
    CHECK(model.read(65535, std::span(registers).first(2)) == ModbusException::illegal_address);
}

TEST_CASE("Profile drive: following error, watchdog, power cycle and swapped words") {
    const std::string text =
        "name='p'\ndrive='d'\nsources=['s']\nnot_verified=[]\nstream='blocks'\n[link]\nwires=['tcp']\n"
        "functions=[3,16]\n"
        "[[field]]\nrole='control'\naddress=0\n[[field]]\nrole='status'\naddress=1\naccess='read'\n"
        "[[field]]\nrole='target_position'\naddress=2\nwidth=32\nsigned=true\n"
        "[[field]]\nrole='profile_velocity'\naddress=4\nwidth=32\n"
        "[[field]]\nrole='actual_position'\naddress=6\nwidth=32\nsigned=true\naccess='read'\n"
        "[[field]]\nrole='watchdog'\naddress=8\n"
        "[[field]]\nrole='following_error_window'\naddress=9\n"
        "[[field]]\nrole='fault_code'\naddress=10\naccess='read'\n"
        "[[state]]\nname='fault'\nfield='status'\nmask=1\nvalue=1\n"
        "[[state]]\nname='enabled'\nfield='status'\nmask=2\nvalue=2\n"
        "[[state]]\nname='disabled'\nfield='status'\nmask=2\nvalue=0\n"
        "[[command]]\nname='enable'\nsteps=[{field='control',value=1}]\n"
        "[[command]]\nname='disable'\nsteps=[{field='control',value=0}]\n"
        "[[command]]\nname='fault_reset'\nsteps=[{field='control',value=2}]\n"
        "[[command]]\nname='quick_stop'\nsteps=[{field='control',value=3}]\n"
        "[[command]]\nname='start_move'\nsteps=[{field='control',value=4}]\n"
        "[motion]\nchange_on_the_fly=true\nfollowing_error_window_counts=50\n"
        "[watchdog]\ntimeout_ms=100\nreaction='fault'\n";
    ProfileDriveParameters parameters;
    parameters.axis.shaft.feed_forward = 0.0;
    DrivenDrive drive(parse_profile(text, "p.toml"), parameters);
    drive.begin();
    drive.write_physical(FieldRole::profile_velocity, 50000.0);
    drive.write_physical(FieldRole::target_position, 100000.0);
    drive.write(FieldRole::control, 4);
    drive.wait_ms(20); // 1e6 counts/s^2 against 60 Hz: 7 counts behind
    CHECK(drive.state() == DriveState::enabled);
    drive.model().axis().shaft().disturb(2e7);
    drive.wait_ms(20);
    CHECK(drive.state() == DriveState::fault);
    CHECK(drive.read(FieldRole::fault_code) == 1);
    drive.model().axis().shaft().disturb(0.0);
    drive.wait_ms(100);
    drive.command(DriveCommand::fault_reset);
    CHECK(drive.state() == DriveState::disabled);

    drive.begin();
    drive.wait_ms(99);
    CHECK(drive.state() == DriveState::enabled); // the question was an exchange
    drive.wait_ms(99);
    CHECK(drive.state() == DriveState::enabled);
    drive.wait_ms(110);
    CHECK(drive.state() == DriveState::fault);
    CHECK(drive.read(FieldRole::fault_code) == 2);

    const double here = drive.model().position_counts(0);
    drive.model().power_cycle();
    CHECK(drive.state() == DriveState::disabled);
    CHECK(drive.model().position_counts(0) == here);
    CHECK(drive.read(FieldRole::watchdog) == 0);

    const std::int64_t position = drive.position();
    drive.model().swap_words();
    CHECK(drive.position() == static_cast<std::int32_t>((static_cast<std::uint32_t>(position) << 16U) |
                                                        (static_cast<std::uint32_t>(position) >> 16U)));
    drive.model().swap_words();
    CHECK(drive.position() == position);
}
