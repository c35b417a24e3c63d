// SPDX-License-Identifier: MIT
#include "host_sim/config/shipped_profiles.hpp"

#include "host_sim/drive/faulty_drive.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "host_sim/drive/vfd_drive.hpp"
#include "pvt_bench.hpp"
#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "support/catch.hpp"

#include <set>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;
using splinefeed::us_per_ms;
using splinefeed_test::PvtBench;

namespace {

/// A drive of a profile, enabled, and a client of single fields.
struct Bench {
    explicit Bench(const std::string& name) : profile(find_profile(name)) {
        std::unique_ptr<DriveModel> inner;
        if (profile.stream == StreamWay::speed) {
            inner = std::make_unique<VfdDrive>(profile, VfdDriveParameters{});
        } else {
            ProfileDriveParameters parameters;
            parameters.axis.start_counts = 1000.0;
            inner = std::make_unique<ProfileDrive>(profile, parameters);
        }
        drive = std::make_unique<FaultyDrive>(std::move(inner), profile);
        drive->advance(0);
    }
    ModbusException write(FieldIndex index, std::int64_t raw) {
        const RegisterField& field = profile.fields[index];
        std::array<std::uint16_t, 4> out{};
        put_raw(field, raw, out);
        last[index] = raw;
        return drive->write(field.address, std::span(out).first(field.registers()));
    }
    ModbusException command(DriveCommand command) {
        ModbusException answer = ModbusException::none;
        for (const CommandStep& step : profile.steps_of(command)) {
            const std::int64_t mask = step.mask;
            answer = write(step.field, (last[step.field] & ~mask) | static_cast<std::int64_t>(step.value));
        }
        return answer;
    }
    std::int64_t read(FieldRole role) {
        const RegisterField& field = *profile.field_of(role);
        std::array<std::uint16_t, 4> in{};
        REQUIRE(drive->read(field.address, std::span(in).first(field.registers())) == ModbusException::none);
        return take_raw(field, in);
    }
    void pass_ms(std::uint64_t ms) { drive->advance(now_us += ms * us_per_ms); }

    DriveProfile profile;
    std::unique_ptr<DriveModel> drive;
    std::vector<std::int64_t> last = std::vector<std::int64_t>(profile.fields.size());
    std::uint64_t now_us = 0;
};

} // namespace

TEST_CASE("faulty drive: a stop is refused while it lasts, and nothing else", "[drive][faults]") {
    for (const char* name : {"cia402-index", "cia402-kinco", "leadshine-pr"}) {
        CAPTURE(name);
        Bench bench(name);
        CHECK(bench.command(DriveCommand::enable) == ModbusException::none);
        bench.drive->set_faults({.refuses_stops = true});
        CHECK(bench.command(DriveCommand::quick_stop) == ModbusException::device_failure);
        CHECK(bench.command(DriveCommand::disable) == ModbusException::none);
        bench.drive->set_faults({});
        CHECK(bench.command(DriveCommand::quick_stop) == ModbusException::none);
    }
    Bench spindle("vfd-gs2");
    spindle.drive->set_faults({.refuses_stops = true});
    CHECK(spindle.command(DriveCommand::stop) == ModbusException::device_failure);
    CHECK(spindle.command(DriveCommand::forward) == ModbusException::none);
}

TEST_CASE("faulty drive: state and place are told as they were, or as asked, or with noise", "[drive][faults]") {
    Bench bench("cia402-index");
    const std::int64_t disabled = bench.read(FieldRole::status);
    bench.drive->set_faults({.stuck_state = true});
    CHECK(bench.command(DriveCommand::enable) == ModbusException::none);
    CHECK(bench.read(FieldRole::status) == disabled);
    bench.drive->set_faults({.state = 99});
    CHECK(bench.read(FieldRole::status) == 99);
    bench.drive->set_faults({});
    CHECK(cia402_state(static_cast<std::uint32_t>(bench.read(FieldRole::status))) == DriveState::enabled);

    CHECK(bench.read(FieldRole::actual_position) == 1000);
    bench.drive->set_faults({.dither_counts = 3});
    std::set<std::int64_t> told;
    for (int i = 0; i < 200; ++i) {
        told.insert(bench.read(FieldRole::actual_position) - 1000);
    }
    CHECK(told == std::set<std::int64_t>{-3, -2, -1, 0, 1, 2, 3});
    CHECK(bench.drive->position_counts(0) == 1000.0); // the shaft stands

    bench.drive->set_faults({});
    CHECK(bench.read(FieldRole::actual_position) == 1000);
    bench.drive->set_faults({.stuck_place = true});
    CHECK(bench.write(bench.profile.index_of(FieldRole::mode), 6) == ModbusException::none);
    CHECK(bench.command(DriveCommand::home) == ModbusException::none);
    bench.pass_ms(2000);
    CHECK(bench.read(FieldRole::actual_position) == 1000);
    bench.drive->set_faults({});
    CHECK(bench.read(FieldRole::actual_position) != 1000);
}

TEST_CASE("faulty drive: a second master stops it", "[drive][faults]") {
    Bench bench("cia402-index");
    CHECK(bench.command(DriveCommand::enable) == ModbusException::none);
    bench.drive->second_master();
    bench.pass_ms(10);
    CHECK(cia402_state(static_cast<std::uint32_t>(bench.read(FieldRole::status))) != DriveState::enabled);
}

TEST_CASE("PVT drive: it tells another state, a full ring and an old place, and refuses stops", "[drive][faults]") {
    PvtDriveParameters parameters;
    parameters.axes.front().start_counts = 500.0;
    PvtBench bench(1, parameters);
    bench.wait_us(1);
    bench.begin();
    bench.drive.set_faults({.refuses_stops = true, .stuck_place = true, .no_room = true, .state = 6});
    CHECK(bench.command(PvtCommand::home).refused == PvtRefusal::none);
    bench.wait_us(10 * us_per_ms);
    CHECK(bench.command(PvtCommand::quick_stop).refused == PvtRefusal::state);
    CHECK(bench.command(PvtCommand::hold).refused == PvtRefusal::state);
    bench.wait_us(1000 * us_per_ms);
    CHECK(bench.drive.position_counts(0) < 1.0);
    CHECK(bench.status().position[0] == 500);
    CHECK(bench.status().free == 0);
    CHECK(static_cast<int>(bench.status().state) == 6);
    bench.drive.set_faults({.dither_counts = 2});
    std::set<std::int64_t> told;
    for (int i = 0; i < 100; ++i) {
        told.insert(bench.status().position[0] - bench.drive.status().position[0]);
    }
    CHECK(told == std::set<std::int64_t>{-2, -1, 0, 1, 2});
    bench.drive.set_faults({});
    bench.drive.second_master();
    CHECK(bench.command(PvtCommand::none).refused == PvtRefusal::session);
}
