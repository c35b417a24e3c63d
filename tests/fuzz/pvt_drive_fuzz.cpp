// SPDX-License-Identifier: MIT
// Any registers at any time to a simulated drive: it takes or refuses them, and never holds more than it may.
#include "fuzz/bytes.hpp"
#include "host_sim/drive/pvt_drive.hpp"

#include <cmath>
#include <cstdlib>

using namespace splinefeed::host;
using namespace splinefeed::hal::modbus;
using splinefeed_test::Bytes;

namespace {

void write_anything(PvtDrive& drive, Bytes& bytes) {
    std::array<std::uint16_t, 130> values{};
    const std::size_t count = bytes.take() % values.size();
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = bytes.take16();
    }
    static_cast<void>(drive.write(bytes.take16(), std::span(values).first(count)));
}

/// With its checksum, near the present session, counter and sequence numbers: it gets further.
void write_block(PvtDrive& drive, Bytes& bytes) {
    PvtSegments segments{};
    const std::uint16_t count = bytes.take() % (pvt::most_segments(drive.axes()) + 1);
    for (PvtSegment& segment : std::span(segments).first(count)) {
        segment.duration_ticks = static_cast<std::uint32_t>(bytes.take16()) * (1U + bytes.take());
        segment.rest = bytes.take() % 2 == 0;
        for (const unsigned k : splinefeed::indices(drive.axes())) {
            segment.end[k] = static_cast<std::int64_t>(bytes.take16()) - 32768;
            segment.end[k] *= std::int64_t{1} << bytes.take() % 32;
            segment.end_velocity[k] = segment.rest ? 0 : (static_cast<std::int64_t>(bytes.take16()) - 32768) * 65536;
        }
    }
    const PvtBlock block{.nonce = bytes.take16(),
                         .session = static_cast<std::uint16_t>(bytes.take() / 64),
                         .command = static_cast<PvtCommand>(bytes.take() % 13),
                         .command_counter = static_cast<std::uint16_t>(drive.status().last_command + bytes.take() % 3),
                         .argument = drive.status().clock_us + bytes.take16(),
                         .count = count,
                         .first = drive.status().next + bytes.take() % 4 - 2};
    PvtBlockRegisters registers{};
    const std::size_t size = encode(block, segments, drive.axes(), registers);
    if (drive.write(pvt::block_address, std::span(registers).first(size)) != ModbusException::none ||
        drive.status().nonce != block.nonce) {
        std::abort();
    }
}

void check(PvtDrive& drive, std::uint16_t ring) {
    const PvtStatus status = drive.status();
    const std::uint32_t held = status.next - status.executed;
    if (held > ring || status.free != ring - held || static_cast<unsigned>(status.state) > 6U ||
        (status.state == PvtState::fault) != (status.fault != 0 && status.fault != 2) ||
        !(drive.machine().rate() >= 0.0 && drive.machine().rate() <= 1.0)) {
        if (status.state != PvtState::fault || status.fault != 2) { // the watchdog is a fault while homing
            std::abort();
        }
    }
    for (int k = 0; k < drive.axes(); ++k) {
        if (!std::isfinite(drive.position_counts(k))) {
            std::abort();
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    PvtDriveParameters parameters;
    parameters.ring = static_cast<std::uint16_t>(16 + bytes.take() % 16);
    parameters.axes.resize(1 + bytes.take() % 6);
    parameters.axes.front().largest_counts_s = bytes.take() % 2 == 0 ? 1e6 : 0.0;
    parameters.axes.front().shaft.feed_forward = bytes.take() % 2 == 0 ? 1.0 : 0.5;
    PvtDrive drive(parameters);
    std::uint64_t now_us = 0;
    std::array<std::uint16_t, 64> registers{};
    for (int step = 0; step < 200 && bytes.left > 0; ++step) {
        switch (bytes.take() % 8) {
        case 0: write_anything(drive, bytes); break;
        case 1: static_cast<void>(drive.read(bytes.take(), std::span(registers).first(bytes.take() % 64))); break;
        case 2: now_us += bytes.take16(); break;
        case 3: drive.power_cycle(); break;
        case 4:
            static_cast<void>(drive.write(pvt::configuration_address,
                                          std::array<std::uint16_t, 4>{bytes.take(), bytes.take(), 0, bytes.take()}));
            break;
        default: write_block(drive, bytes); break;
        }
        now_us += bytes.take();
        drive.advance(now_us);
        check(drive, parameters.ring);
    }
    return 0;
}
