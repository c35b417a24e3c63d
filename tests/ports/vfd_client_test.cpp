// SPDX-License-Identifier: MIT
// VfdClient: what it writes and what it makes of the registers that it reads.
#include "splinefeed/hal/modbus/spindle/vfd_client.hpp"

#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/vfd_drive.hpp"
#include "ports/plant.hpp"
#include "support/catch.hpp"

#include <map>
#include <utility>
#include <vector>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

/// Registers that remember what was written, and in which order.
class Notebook final : public DriveModel {
public:
    void advance(std::uint64_t /*now_us*/) override {}
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = registers[address + static_cast<int>(i)];
        }
        return ModbusException::none;
    }
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values) override {
        written.emplace_back(address, values[0]);
        return values.size() == 1 ? refusal : ModbusException::illegal_value;
    }
    void power_cycle() override {}
    [[nodiscard]] int axes() const override { return 1; }
    [[nodiscard]] double position_counts(int /*axis*/) const override { return 0.0; }

    std::map<int, std::uint16_t> registers;
    std::vector<std::pair<int, std::uint16_t>> written;
    ModbusException refusal = ModbusException::none;
};

using Writes = std::vector<std::pair<int, std::uint16_t>>;

struct Bench {
    explicit Bench(const std::string& profile) : wire(plant.add_wire()) {
        auto model = std::make_unique<Notebook>();
        vfd = model.get();
        plant.add(std::move(model), 1, 0.0, wire);
        client.emplace(VfdWiring{{.port = 1502, .unit = 1}, find_profile(profile)}, plant.make_wire(), plant.clock);
    }

    Plant plant;
    SimulatedWire& wire;
    Notebook* vfd = nullptr;
    std::optional<VfdClient> client;
};

} // namespace

TEST_CASE("VfdClient: speeds and commands are the registers of the makers' documents", "[spindle]") {
    SECTION("Delta MS300") {
        Bench bench("vfd-delta-ms300");
        CHECK(bench.client->write_speed(123.45).ok());
        CHECK(bench.client->command(DriveCommand::forward).ok());
        CHECK(bench.client->command(DriveCommand::reverse).ok());
        CHECK(bench.client->command(DriveCommand::stop).ok());
        CHECK(bench.vfd->written == Writes{{0x2001, 12345}, {0x2000, 0x12}, {0x2000, 0x22}, {0x2000, 0x01}});
    }
    SECTION("GS2: direction and run are two registers") {
        Bench bench("vfd-gs2");
        CHECK(bench.client->write_speed(40.0).ok());
        CHECK(bench.client->command(DriveCommand::reverse).ok());
        CHECK(bench.client->command(DriveCommand::stop).ok());
        CHECK(bench.vfd->written == Writes{{0x091A, 400}, {0x091C, 1}, {0x091B, 1}, {0x091B, 0}});
    }
    SECTION("Omron MX2: run and direction are coils, and all numbers count from 1") {
        Bench bench("vfd-omron-mx2");
        constexpr int run = place_in(RegisterTable::coils, 0);
        constexpr int backwards = place_in(RegisterTable::coils, 1);
        CHECK(bench.client->write_speed(60.0).ok());
        CHECK(bench.client->command(DriveCommand::forward).ok());
        CHECK(bench.client->command(DriveCommand::reverse).ok());
        CHECK(bench.client->command(DriveCommand::stop).ok());
        CHECK(bench.vfd->written == Writes{{1, 0x1770}, {backwards, 0}, {run, 1}, {backwards, 1}, {run, 1}, {run, 0}});
    }
    SECTION("Huanyang H100: a coil for each command") {
        Bench bench("vfd-h100");
        const auto coil = [](int address) {
            return place_in(RegisterTable::coils, address);
        };
        CHECK(bench.client->write_speed(200.0).ok());
        CHECK(bench.client->command(DriveCommand::forward).ok());
        CHECK(bench.client->command(DriveCommand::reverse).ok());
        CHECK(bench.client->command(DriveCommand::stop).ok());
        CHECK(bench.vfd->written == Writes{{0x0201, 0x07D0}, {coil(0x49), 1}, {coil(0x4A), 1}, {coil(0x4B), 1}});
    }
    SECTION("Optidrive: its manual counts registers from 1") {
        Bench bench("vfd-optidrive");
        CHECK(bench.client->write_speed(50.0).ok());
        CHECK(bench.client->command(DriveCommand::forward).ok());
        CHECK(bench.vfd->written == Writes{{1, 500}, {0, 1}});
    }
}

TEST_CASE("VfdClient: a reading has output, speed reached and fault", "[spindle]") {
    Bench bench("vfd-ls-ig5a");
    bench.vfd->registers = {{0x000A, 12345}, {0x000E, 0x0042}, {0x000F, 0x0010}};
    VfdReading reading;
    REQUIRE(bench.client->read(reading).ok());
    CHECK(reading.output_hz == Approx(123.45).margin(1e-4));
    CHECK(reading.done);
    CHECK_FALSE(reading.fault);
    bench.vfd->registers[0x000E] = 0x0008;
    REQUIRE(bench.client->read(reading).ok());
    CHECK_FALSE(reading.done);
    CHECK(reading.fault);
    CHECK(reading.fault_code == 0x10);
}

TEST_CASE("VfdClient: a reading may come from coils, input registers and numbers of two registers", "[spindle]") {
    VfdReading reading;
    {
        Bench bench("vfd-h100");
        bench.vfd->registers = {{0, 9999}, {place_in(RegisterTable::input, 0), 2000}}; // 0.1 Hz
        REQUIRE(bench.client->read(reading).ok());
        CHECK(reading.output_hz == Approx(200.0).margin(1e-3));
        CHECK_FALSE(reading.fault);
    }
    Bench bench("vfd-omron-mx2");
    constexpr int at_speed = place_in(RegisterTable::coils, 0x13);
    constexpr int alarm = place_in(RegisterTable::coils, 0x17);
    bench.vfd->registers = {{0x1000, 1}, {0x1001, 0}, {at_speed, 1}, {alarm, 0}, {0x11, 5}};
    REQUIRE(bench.client->read(reading).ok());
    CHECK(reading.output_hz == Approx(655.36).margin(1e-3)); // the high word is first
    CHECK(reading.done);
    CHECK_FALSE(reading.fault);
    bench.vfd->registers[at_speed] = 0;
    bench.vfd->registers[alarm] = 1;
    REQUIRE(bench.client->read(reading).ok());
    CHECK_FALSE(reading.done);
    CHECK(reading.fault);
    CHECK(reading.fault_code == 5);
}

TEST_CASE("VfdClient: the speed is the nearest that the register can hold", "[spindle]") {
    const Bench bench("vfd-yl620");
    CHECK(bench.client->nearest_hz(200.04) == Approx(200.0).margin(1e-4));
    CHECK(bench.client->nearest_hz(200.06) == Approx(200.1).margin(1e-4));
}

TEST_CASE("VfdClient: a refusal is reported, and a line that comes back is opened again", "[spindle]") {
    Bench bench("vfd-yl620");
    bench.vfd->refusal = ModbusException::illegal_value;
    const LinkAnswer refused = bench.client->write_speed(100.0);
    CHECK(refused.fault == LinkFault::exception);
    CHECK(refused.exception == 3);
    bench.vfd->refusal = ModbusException::none;
    const std::uint64_t now_us = bench.plant.clock.now_us();
    bench.wire.unplugged.push_back({now_us, now_us + 1'000'000});
    CHECK(bench.client->write_speed(100.0).fault != LinkFault::none);
    bench.plant.clock.sleep_us(1'500'000);
    CHECK(bench.client->write_speed(100.0).ok());
}
