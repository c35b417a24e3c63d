// SPDX-License-Identifier: MIT
// VfdSpindle on a virtual clock, with a simulated frequency inverter of each shipped profile behind a line with faults.
#include "splinefeed/hal/modbus/spindle/vfd_spindle.hpp"

#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/vfd_drive.hpp"
#include "ports/plant.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <string>
#include <vector>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr double ramp_hz_s = 100.0;

/// An inverter on a line, and the spindle that a run has.
struct Bench {
    explicit Bench(const std::string& profile, const VfdSpindleSettings& settings = {}, Wire kind = Wire::tcp)
        : wire(plant.add_wire()) {
        auto model = std::make_unique<VfdDrive>(find_profile(profile), VfdDriveParameters{.ramp_hz_s = ramp_hz_s});
        vfd = model.get();
        plant.add(std::move(model), 1, 0.0, wire);
        spindle =
            std::make_unique<VfdSpindle>(VfdWiring{{.wire = kind, .port = 1502, .unit = 1}, find_profile(profile)},
                                         settings, plant.make_wire(), plant.clock);
    }

    /// Opened, and at this speed.
    void turn(double hz = 100.0) {
        REQUIRE(spindle->open().empty());
        spindle->order({1, hz});
        pass_ms(static_cast<int>(hz * 12.0) + 300);
        REQUIRE(spindle->reached());
    }
    /// For so long, looked at every millisecond.
    template <class Look>
    void pass_ms(int duration_ms, Look look) {
        for (int i = 0; i < duration_ms; ++i) {
            plant.clock.sleep_us(1000);
            plant.stations.front()->advance(plant.clock.now_us());
            look();
        }
    }
    void pass_ms(int duration_ms) {
        pass_ms(duration_ms, [] {});
    }
    /// By somebody else than the spindle: its registers, as the profile has them.
    void turn_on(double hz) {
        const DriveProfile profile = vfd->profile();
        const auto write = [&](FieldIndex field, std::int64_t raw) {
            const auto value = static_cast<std::uint16_t>(raw);
            REQUIRE(vfd->write(profile.fields[field].place(), std::span(&value, 1)) == ModbusException::none);
        };
        vfd->advance(plant.clock.now_us());
        const FieldIndex speed = profile.index_of(FieldRole::target_velocity);
        write(speed, raw_of(profile.fields[speed], std::llround(hz * (1 << physical_bits))).raw);
        for (const CommandStep& step : profile.steps_of(DriveCommand::forward)) {
            write(step.field, static_cast<std::int64_t>(step.value));
        }
    }

    Plant plant;
    SimulatedWire& wire;
    VfdDrive* vfd = nullptr;
    std::unique_ptr<VfdSpindle> spindle;
};

std::vector<std::string> vfd_profiles() {
    std::vector<std::string> names;
    for (const ShippedProfile& shipped : shipped_profiles()) {
        if (shipped.name.rfind("vfd-", 0) == 0) {
            names.emplace_back(shipped.name);
        }
    }
    return names;
}

} // namespace

TEST_CASE("Spindle: with each profile it turns as ordered, and is at speed only when it is", "[spindle]") {
    REQUIRE(vfd_profiles().size() >= 4);
    for (const std::string& name : vfd_profiles()) {
        CAPTURE(name);
        Bench bench(name);
        REQUIRE(bench.spindle->open().empty());
        for (const auto& [hz, most_ms] : {std::pair{200.0, 2500}, std::pair{300.0, 1500}}) {
            bench.spindle->order({1, hz});
            CHECK_FALSE(bench.spindle->reached());
            bench.pass_ms(most_ms, [&, hz = hz] {
                if (bench.spindle->reached()) {
                    REQUIRE(bench.vfd->output_hz() > 0.975 * hz);
                }
            });
            CHECK(bench.spindle->reached());
            CHECK(bench.vfd->direction() == 1);
        }
        CHECK_FALSE(bench.spindle->stands());
        bench.spindle->order({0, 0.0});
        bench.pass_ms(200);
        CHECK(bench.spindle->reached());
        CHECK_FALSE(bench.spindle->stands());
        bench.pass_ms(3500);
        CHECK(bench.spindle->stands());
        CHECK(bench.spindle->trouble().empty());
    }
}

TEST_CASE("Spindle: it stands before it turns in the other direction", "[spindle]") {
    for (const std::string& name : vfd_profiles()) {
        CAPTURE(name);
        if (find_profile(name).steps_of(DriveCommand::reverse).empty()) {
            continue;
        }
        Bench bench(name);
        bench.turn();
        bench.spindle->order({-1, 100.0});
        bench.pass_ms(3000, [&] {
            if (bench.vfd->direction() < 0) {
                REQUIRE(bench.vfd->output_hz() < 1.0);
            }
            if (bench.spindle->reached()) {
                REQUIRE(bench.vfd->output_hz() < -97.0);
            }
        });
        CHECK(bench.spindle->reached());
    }
}

TEST_CASE("Spindle: once it was ended it never turns again, whatever is ordered and lost", "[spindle]") {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        Bench bench("vfd-delta-ms300");
        bench.wire.random.seed(seed);
        REQUIRE(bench.spindle->open().empty());
        bench.wire.faults = {.lost_request = 0.1, .lost_answer = 0.1};
        bench.spindle->order({1, 50.0});
        bench.pass_ms(static_cast<int>(seed) * 17);
        bench.spindle->end();
        bench.spindle->order({1, 50.0});
        bench.pass_ms(800); // an exchange that was under way, and some that are lost
        bench.pass_ms(3000, [&] { REQUIRE(bench.vfd->direction() == 0); });
        CHECK(bench.vfd->output_hz() == 0.0);
        CHECK(bench.spindle->stands());
    }
}

TEST_CASE("Spindle: a lost inverter is trouble while it turns, and is stopped when it returns", "[spindle]") {
    Bench bench("vfd-gs2");
    bench.turn();
    const std::uint64_t now_us = bench.plant.clock.now_us();
    bench.plant.stations.front()->mute.push_back({now_us, now_us + 3'000'000});
    bench.pass_ms(900);
    CHECK(bench.spindle->trouble().empty());
    bench.pass_ms(700);
    CHECK(bench.spindle->trouble().rfind("the VFD does not answer: ", 0) == 0);
    CHECK_FALSE(bench.spindle->stands());
    CHECK(bench.vfd->direction() == 1); // nobody can tell it anything
    bench.pass_ms(4000);
    CHECK(bench.vfd->direction() == 0);
    CHECK(bench.spindle->stands());
}

TEST_CASE("Spindle: a speed that is not reached in time is trouble, and it stops", "[spindle]") {
    Bench bench("vfd-ls-ig5a", {.at_speed_timeout_ms = 1500});
    REQUIRE(bench.spindle->open().empty());
    bench.spindle->order({1, 300.0}); // takes 3 s
    bench.pass_ms(1400);
    REQUIRE(bench.vfd->direction() == 1);
    bench.pass_ms(300);
    CHECK(bench.spindle->trouble().rfind("the spindle has not reached its speed in", 0) == 0);
    CHECK_FALSE(bench.spindle->reached());
    bench.pass_ms(300);
    CHECK(bench.vfd->direction() == 0);
}

TEST_CASE("Spindle: a speed that is lost is trouble, and an inverter that comes back is stopped", "[spindle]") {
    Bench bench("vfd-ls-ig5a");
    bench.turn();
    SECTION("it was switched off and on") {
        bench.vfd->power_cycle();
        bench.pass_ms(400);
        CHECK(bench.spindle->trouble().rfind("the spindle has lost its speed", 0) == 0);
    }
    SECTION("a fault") {
        bench.vfd->trip();
        bench.pass_ms(200);
        CHECK(bench.spindle->trouble() == "the VFD is in fault, code 1");
        bench.vfd->power_cycle();
    }
    bench.turn_on(30.0); // by its panel
    REQUIRE(bench.vfd->direction() == 1);
    bench.pass_ms(300);
    CHECK(bench.vfd->direction() == 0);
}

TEST_CASE("Spindle: a stop is repeated for as long as the inverter turns", "[spindle]") {
    for (const std::string& name : vfd_profiles()) {
        CAPTURE(name);
        Bench bench(name);
        bench.turn();
        bench.spindle->order({0, 0.0});
        bench.pass_ms(300);
        REQUIRE(bench.spindle->reached()); // the stop is acknowledged
        bench.turn_on(100.0);
        REQUIRE(bench.vfd->direction() == 1);
        bench.pass_ms(200);
        CHECK(bench.vfd->direction() == 0);
        bench.pass_ms(3000);
        CHECK(bench.spindle->stands());
        bench.turn_on(100.0); // from standstill, too
        bench.pass_ms(300);
        CHECK(bench.vfd->direction() == 0);
        bench.pass_ms(3000);
        CHECK(bench.spindle->stands());
        CHECK(bench.spindle->trouble().empty());
    }
}

TEST_CASE("Spindle: off and on again in one direction does not wait for standstill", "[spindle]") {
    Bench bench("vfd-yl620");
    bench.turn(200.0);
    bench.spindle->order({0, 0.0});
    bench.pass_ms(200);
    REQUIRE(bench.vfd->direction() == 0);
    bench.spindle->order({1, 200.0});
    bench.pass_ms(700, [&] { REQUIRE(bench.vfd->output_hz() > 150.0); });
    CHECK(bench.spindle->reached());
}

TEST_CASE("Spindle: a speed whose answer was lost is written again", "[spindle]") {
    Bench bench("vfd-yl620");
    bench.turn();
    bench.wire.faults.lost_answer = 1.0;
    bench.spindle->order({1, 200.0});
    bench.pass_ms(150); // the inverter has taken it
    bench.wire.faults.lost_answer = 0.0;
    bench.spindle->order({1, 100.0});
    bench.pass_ms(3000);
    CHECK(bench.spindle->reached());
    CHECK(bench.vfd->output_hz() == Approx(100.0));
}

TEST_CASE("Spindle: an inverter or a gateway that is busy counts as one that does not answer", "[spindle]") {
    const int code = GENERATE(5, 6, 0x0A, 0x0B);
    CAPTURE(code);
    Bench bench("vfd-gs2");
    bench.wire.exception = static_cast<ModbusException>(code);
    bench.turn();
    bench.wire.faults.exception = 1.0;
    bench.pass_ms(700);
    CHECK(bench.spindle->trouble().empty());
    bench.wire.faults.exception = 0.2;
    bench.pass_ms(3000);
    CHECK(bench.spindle->trouble().empty());
    bench.wire.faults.exception = 1.0;
    bench.pass_ms(1500);
    CHECK(bench.spindle->trouble() ==
          "the VFD answers nothing but exception " + std::string(exception_name(static_cast<std::uint8_t>(code))));
    bench.wire.faults.exception = 0.0;
    bench.pass_ms(3000);
    CHECK(bench.vfd->direction() == 0);
    CHECK(bench.spindle->stands());
}

TEST_CASE("Spindle: an inverter that does not answer or is in fault is refused", "[spindle]") {
    Bench bench("vfd-ls-ig5a");
    SECTION("silent") {
        bench.plant.stations.front()->mute.push_back({0, UINT64_MAX});
        CHECK_FALSE(bench.spindle->open().empty());
    }
    SECTION("in fault") {
        bench.vfd->trip();
        CHECK(bench.spindle->open() == "it is in fault, code 1: reset it");
    }
}

TEST_CASE("Spindle: an inverter that turns when the run begins is stopped, and stands when it does", "[spindle]") {
    for (const std::string& name : vfd_profiles()) {
        CAPTURE(name);
        Bench bench(name);
        bench.turn_on(100.0);
        bench.pass_ms(1500);
        REQUIRE(bench.vfd->output_hz() == Approx(100.0));
        REQUIRE(bench.spindle->open().empty());
        CHECK(bench.spindle->was_on());
        bench.pass_ms(100);
        CHECK(bench.vfd->direction() == 0);
        CHECK_FALSE(bench.spindle->stands());
        bench.spindle->order({1, 100.0}); // nobody knows which way it turns
        bench.pass_ms(700, [&] { REQUIRE(bench.vfd->direction() == 0); });
        bench.pass_ms(3000);
        CHECK(bench.spindle->reached());
    }
}

TEST_CASE("Spindle: an order that nobody confirms is trouble, though the spindle never turned", "[spindle]") {
    Bench bench("vfd-gs2");
    REQUIRE(bench.spindle->open().empty());
    bench.plant.stations.front()->mute.push_back({0, UINT64_MAX});
    bench.pass_ms(3000);
    CHECK(bench.spindle->trouble().empty()); // nothing is wanted of it
    bench.spindle->order({0, 0.0});
    bench.pass_ms(200);
    CHECK_FALSE(bench.spindle->trouble().empty());
}

TEST_CASE("Spindle: answers that are late, break off, or are others' do not end a run on a serial line", "[spindle]") {
    for (const WireFaults& faults : {WireFaults{.late = 0.1, .late_us = 300'000}, WireFaults{.broken = 0.03},
                                     WireFaults{.foreign = 0.03}, WireFaults{.lost_answer = 0.03}}) {
        Bench bench("vfd-gs2", {}, Wire::rtu);
        bench.turn(200.0);
        bench.wire.faults = faults;
        bench.pass_ms(120'000, [&] { REQUIRE(bench.spindle->trouble().empty()); });
        CHECK(bench.wire.hiccups > 20);
        CHECK(bench.spindle->output_hz() == Approx(200.0).margin(0.1));
        bench.spindle->end();
        bench.pass_ms(6000);
        CHECK(bench.vfd->output_hz() == 0.0);
        CHECK(bench.spindle->stands());
    }
}
