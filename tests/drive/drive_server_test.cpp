// SPDX-License-Identifier: MIT
// A host that stands still between two looks at the clock, and what the record of a drive says of that time.
#include "host/temporary_folder.hpp"
#include "host_sim/drive/drive_server.hpp"
#include "modbus/scripted_peer.hpp"
#include "support/catch.hpp"
#include "support/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <termios.h>
#include <thread>

using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t stands_still_us = 20000; // then the host does, while the model is advanced
constexpr std::chrono::milliseconds stand{300};
constexpr std::uint64_t ends_us = 400000;
constexpr std::uint64_t gives_up_us = 10000000;

/// A drive whose shaft is always where its clock is, in us. Its host stands still once. It ends its server some time
/// after it was read or met an event.
class ClockDrive : public DriveModel {
public:
    void advance(std::uint64_t now_us) override {
        if (!stood_ && now_us >= stands_still_us) {
            stood_ = true;
            std::this_thread::sleep_for(stand);
        }
        now_us_ = std::max(now_us_, now_us);
        stop = (happened && now_us_ >= ends_us) || now_us_ >= gives_up_us ? 1 : 0;
    }
    ModbusException read(int /*address*/, std::span<std::uint16_t> out) override {
        std::fill(out.begin(), out.end(), std::uint16_t{0});
        happened = true;
        return ModbusException::none;
    }
    ModbusException write(int /*address*/, std::span<const std::uint16_t> /*values*/) override {
        return ModbusException::none;
    }
    void power_cycle() override { happened = true; }
    void second_master() override { happened = true; }
    void set_faults(const ModelFaults& /*faults*/) override { happened = true; }
    [[nodiscard]] int axes() const override { return 1; }
    [[nodiscard]] double position_counts(int /*axis*/) const override { return static_cast<double>(now_us_); }

    volatile std::sig_atomic_t stop = 0;
    bool happened = false;

private:
    bool stood_ = false;
    std::uint64_t now_us_ = 0;
};

/// Rows of the record of a run, and those that are not where the shaft was at their instant.
struct Rows {
    std::size_t count = 0;
    std::size_t wrong = 0;
};

Rows recorded(ClockDrive& drive, const ListenAddress& address, const std::string& faults) {
    const TemporaryFolder folder;
    DriveServer server(drive, address, parse_drive_faults(faults), 1);
    DriveRecord record(folder.file("drive.csv"), "test", 1, server.start_s());
    server.run(drive.stop, &record);
    record.commit();
    Rows rows;
    for (const std::string& line : lines_of(folder.file("drive.csv"))) {
        if (line.front() == '#' || line.front() == 't') {
            continue;
        }
        const std::vector<std::string> cells = cells_of(line);
        rows.wrong += std::stod(cells[1]) == std::round(1e6 * std::stod(cells[0])) ? 0 : 1;
        ++rows.count;
    }
    return rows;
}

} // namespace

TEST_CASE("drive server: a request takes effect late on a host that stood still; the record has every row where the "
          "shaft was",
          "[drive]") {
    const Terminal terminal;
    termios raw{};
    REQUIRE(tcgetattr(terminal.descriptor(), &raw) == 0);
    cfmakeraw(&raw);
    REQUIRE(tcsetattr(terminal.descriptor(), TCSANOW, &raw) == 0);
    // At 1200 baud it takes 105 ms with the silence behind it: received before the host stands still, due while it
    // does.
    const Bytes request = with_crc({1, 3, 0, 0, 0, 1});
    terminal.type({reinterpret_cast<const char*>(request.data()), request.size()});
    ListenAddress address;
    address.kind = ListenAddress::Kind::rtu;
    address.device = terminal.name();
    address.baud = 1200;
    ClockDrive drive;
    const Rows rows = recorded(drive, address, "");
    CHECK(rows.wrong == 0);
    CHECK(rows.count >= 400);
    CHECK(drive.happened);
}

TEST_CASE(
    "drive server: an event happens late on a host that stood still; the record has every row where the shaft was",
    "[drive]") {
    for (const char* faults : {"power-cycle@0.1", "second-master@0.1", "stuck-state@0.1:1000"}) {
        CAPTURE(faults);
        ClockDrive drive;
        const Rows rows = recorded(drive, ListenAddress{}, faults);
        CHECK(rows.wrong == 0);
        CHECK(rows.count >= 400);
        CHECK(drive.happened);
    }
}
