// SPDX-License-Identifier: MIT
// `splinefeed drive` with other profiles than its own, over real Modbus: this library's client, mbpoll.
#include "drive/drive_process.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"
#include "support/catch.hpp"

#include <chrono>
#include <memory>
#include <modbus/modbus.h>
#include <thread>

using namespace splinefeed::hal::modbus;
using splinefeed::host::find_profile;
using splinefeed::test::DriveProcess;
using splinefeed::test::Tool;

namespace {

class Connection {
public:
    explicit Connection(int port) : context_(modbus_new_tcp("127.0.0.1", port), modbus_free) {
        REQUIRE(modbus_connect(context_.get()) == 0);
        REQUIRE(modbus_set_slave(context_.get(), 255) == 0);
        REQUIRE(modbus_set_response_timeout(context_.get(), 1, 0) == 0);
    }
    ~Connection() { modbus_close(context_.get()); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void write(std::span<const RegisterWrite> writes) {
        for (const RegisterWrite& write : writes) {
            REQUIRE(modbus_write_registers(context_.get(), write.address, static_cast<int>(write.count),
                                           write.values.data()) == static_cast<int>(write.count));
        }
    }
    DriveReading read(StatusFrames& status) {
        for (std::size_t i = 0; i < status.reads().size(); ++i) {
            const RegisterRead& read = status.reads()[i];
            std::array<std::uint16_t, 125> registers{};
            REQUIRE(modbus_read_registers(context_.get(), read.address, static_cast<int>(read.count),
                                          registers.data()) == static_cast<int>(read.count));
            status.take(i, std::span(registers).first(read.count));
        }
        return status.reading();
    }
    [[nodiscard]] modbus_t* get() const { return context_.get(); }

private:
    std::unique_ptr<modbus_t, void (*)(modbus_t*)> context_;
};

} // namespace

TEST_CASE("drive: a block on a Leadshine, a block with function 23 on a Lexium", "[drive][process]") {
    const Tool tool;
    for (const std::string name : {"leadshine-pr", "lexium32m"}) {
        CAPTURE(name);
        const DriveProfile profile = find_profile(name);
        DriveProcess process(tool, "--listen tcp://127.0.0.1:0 --position 1000 --profile " + name + " --record t.csv");
        CHECK(process.line().find(", profile " + name + ", 1 axis") != std::string::npos);
        Connection drive(process.port());
        SetpointFrames frames(profile);
        StatusFrames status(profile);
        for (const CommandStep& step : profile.steps_of(DriveCommand::enable)) {
            for (const bool on : {false, true}) { // edges need both, levels do not mind
                const RegisterWrite write = frames.single(
                    step.field, (frames.last(step.field) & ~std::int64_t{step.mask}) | (on ? step.value : 0U));
                drive.write(std::span(&write, 1));
            }
        }
        CHECK(drive.read(status).state == DriveState::enabled);
        CHECK(drive.read(status).position_q16 == std::int64_t{1000} << 16);
        frames.set(FieldRole::target_position, std::int64_t{1500} << 16);
        frames.set(FieldRole::profile_velocity, std::int64_t{20000} << 16);
        frames.set(FieldRole::profile_acceleration, std::int64_t{1000000} << 16);
        frames.set(FieldRole::profile_deceleration, std::int64_t{1000000} << 16);
        if (profile.link.function_exchange) {
            const std::span<const RegisterWrite> block = frames.build();
            REQUIRE(block.size() == 1);
            std::array<std::uint16_t, 13> read{};
            CHECK(modbus_write_and_read_registers(drive.get(), block[0].address, static_cast<int>(block[0].count),
                                                  block[0].values.data(), 0, 13, read.data()) == 13);
            status.take(0, read);
            CHECK(status.reading().state == DriveState::moving);
        } else {
            drive.write(frames.build());
        }
        DriveReading reading = drive.read(status);
        for (int i = 0; i < 200 && !reading.done; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            reading = drive.read(status);
        }
        CHECK(reading.done);
        CHECK(reading.position_q16 == std::int64_t{1500} << 16);
        std::uint16_t nothing = 0;
        CHECK(modbus_read_registers(drive.get(), 0x7000, 1, &nothing) == -1);
        CHECK(errno == EMBXILADD);
        CHECK(process.stop() == 0);
        CHECK(tool.read("t.csv").find(",1500.000000\n") != std::string::npos);
    }
}

TEST_CASE("drive: mbpoll reads and writes the registers of Kinco", "[drive][process]") {
    const Tool tool;
    if (tool.shell("command -v mbpoll").status != 0) {
        WARN("SKIPPED: mbpoll is not installed");
        return;
    }
    const DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --position -2 --profile cia402-kinco");
    const std::string mbpoll = "mbpoll -m tcp -p " + std::to_string(drive.port()) + " -a 1 -0 -1 ";
    for (const char* word : {"6", "15"}) {
        CHECK(tool.shell(mbpoll + "-t 4 -r 12544 127.0.0.1 " + word).status == 0); // 0x3100
    }
    const auto status = tool.shell(mbpoll + "-t 4:hex -r 12800 -c 1 127.0.0.1"); // 0x3200
    CAPTURE(status.output, status.error);
    CHECK(status.output.find("0x0637") != std::string::npos);                      // operation enabled, target reached
    const auto position = tool.shell(mbpoll + "-t 4:hex -r 14080 -c 2 127.0.0.1"); // 0x3700, low word first
    CAPTURE(position.output);
    CHECK(position.output.find("0xFFFE") < position.output.find("0xFFFF"));
}
