// SPDX-License-Identifier: MIT
// DriveBench: the drive of examples/firmware/drive on a host: interrupt, main loop and a master, on a clock of its own.
#pragma once

#include "drive/pvt_drive.hpp"
#include "drive/rtu_frame.hpp"

#include <vector>

namespace firmware {

namespace modbus = splinefeed::hal::modbus;

/// Registers as bytes, the high one first.
inline void append(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
}

inline std::vector<std::uint8_t> with_crc(std::vector<std::uint8_t> bytes) {
    const std::uint16_t crc = rtu_crc(bytes);
    bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
    return bytes;
}

inline std::vector<std::uint8_t> read_request(std::uint32_t address, std::uint32_t count, std::uint8_t unit = 1) {
    std::vector<std::uint8_t> bytes{unit, 3};
    append(bytes, address);
    append(bytes, count);
    return with_crc(bytes);
}

/// Function 23: the block, and the status after it.
inline std::vector<std::uint8_t> exchange_request(std::span<const std::uint16_t> block) {
    std::vector<std::uint8_t> bytes{1, 23};
    append(bytes, modbus::pvt::status_address);
    append(bytes, modbus::pvt::status_registers(drive_axes));
    append(bytes, modbus::pvt::block_address);
    append(bytes, static_cast<std::uint32_t>(block.size()));
    bytes.push_back(static_cast<std::uint8_t>(2 * block.size()));
    for (const std::uint16_t value : block) {
        append(bytes, value);
    }
    return with_crc(bytes);
}

/// Segments of this duration along a parabola up and one down; the last one comes to rest.
inline std::vector<PvtSegment> there_and_stop(int count, std::uint32_t ticks, double counts) {
    std::vector<PvtSegment> segments(static_cast<std::size_t>(count));
    for (int i = 1; i <= count; ++i) {
        const double u = static_cast<double>(i) / count;
        PvtSegment& segment = segments[static_cast<std::size_t>(i - 1)];
        segment.duration_ticks = ticks;
        segment.rest = i == count;
        for (unsigned k = 0; k < drive_axes; ++k) {
            const double way = counts / (k + 1.0);
            segment.end[k] = static_cast<std::int64_t>(65536.0 * way * u * u * (3.0 - 2.0 * u));
            segment.end_velocity[k] =
                segment.rest ? 0 : static_cast<std::int64_t>(16777216.0 * way * 6.0 * u * (1.0 - u) / count);
        }
    }
    return segments;
}

struct DriveBench {
    DriveBench() { run_us(1000); }

    /// Ticks, each with a round of the main loop.
    void run_us(std::uint32_t us) {
        for (std::uint32_t passed = 0; passed < us; passed += drive_tick_us) {
            steps.tick({estop, false}, [this](Pins lines) {
                for (unsigned k = 0; k < drive_axes; ++k) {
                    const int step = (lines.step >> k & 1U) == 0 ? 0 : (lines.up >> k & 1U) != 0 ? 1 : -1;
                    shaft[k] += step;
                }
            });
            drive.poll(limit);
        }
    }
    /// Until the drive is in this state, at most for a while. Returns how long it took.
    std::uint32_t run_until(PvtState state, std::uint32_t longest_us = 5'000'000) {
        std::uint32_t us = 0;
        for (; drive.state() != state && us < longest_us; us += drive_tick_us) {
            run_us(drive_tick_us);
        }
        return us;
    }
    /// The answer to a frame; empty: none.
    std::vector<std::uint8_t> ask(const std::vector<std::uint8_t>& request) {
        RtuBytes reply{};
        const std::size_t size = answer_request(request, 1, registers, reply);
        return {reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(size)};
    }
    modbus::PvtStatus status() {
        std::array<std::uint16_t, modbus::pvt::status_registers(drive_axes)> raw{};
        static_cast<void>(registers.read(modbus::pvt::status_address, raw));
        return modbus::decode_status(raw, drive_axes);
    }
    /// A block as a frame of function 23, and the status of its answer.
    modbus::PvtStatus send(const modbus::PvtBlock& head, std::span<const PvtSegment> segments = {}) {
        modbus::PvtBlock block = head;
        block.nonce = ++nonce;
        block.count = static_cast<std::uint16_t>(segments.size());
        modbus::PvtBlockRegisters raw{};
        const std::size_t size = encode(block, segments, drive_axes, raw);
        last_frame = exchange_request(std::span<const std::uint16_t>(raw).first(size));
        return status_of(ask(last_frame));
    }
    static modbus::PvtStatus status_of(const std::vector<std::uint8_t>& answer) {
        std::array<std::uint16_t, modbus::pvt::status_registers(drive_axes)> raw{};
        if (answer.size() != 5 + 2 * raw.size() || answer[1] != 23) {
            return {};
        }
        for (std::size_t i = 0; i < raw.size(); ++i) {
            raw[i] = static_cast<std::uint16_t>(answer[3 + 2 * i] << 8U | answer[4 + 2 * i]);
        }
        return modbus::status_holds(raw) ? modbus::decode_status(raw, drive_axes) : modbus::PvtStatus{};
    }
    modbus::PvtStatus command(PvtCommand command, std::uint32_t argument = 0) {
        modbus::PvtBlock block;
        block.session = session;
        block.command = command;
        block.command_counter = ++counter;
        block.argument = argument;
        return send(block);
    }
    modbus::PvtStatus give(std::uint32_t first, std::span<const PvtSegment> segments) {
        modbus::PvtBlock block;
        block.session = session;
        block.command_counter = counter;
        block.first = first;
        return send(block, segments);
    }
    /// As many at a time as a block takes.
    void give_all(std::uint32_t first, std::span<const PvtSegment> segments) {
        constexpr std::size_t most = modbus::pvt::most_segments(drive_axes);
        for (std::size_t i = 0; i < segments.size(); i += most) {
            give(first + static_cast<std::uint32_t>(i), segments.subspan(i, std::min(most, segments.size() - i)));
        }
    }
    /// A motion that begins at once.
    void start(std::span<const PvtSegment> segments) {
        enable_and_begin();
        give_all(0, segments);
        command(PvtCommand::start);
    }
    void enable_and_begin(std::uint32_t first = 0) {
        command(PvtCommand::enable);
        command(PvtCommand::begin, first);
    }

    std::array<MotionPart, slots_ahead + 1> parts{};
    std::array<PvtSegment, drive_ring> ring{};
    DriveSteps steps{parts, no_lookahead};
    PvtDrive drive{steps, ring};
    PvtRegisters registers{drive, 7};
    std::array<std::int32_t, drive_axes> shaft{}; // pulses, counted
    std::vector<std::uint8_t> last_frame;
    std::uint16_t session = 4711;
    std::uint16_t counter = 0;
    std::uint16_t nonce = 0;
    bool estop = false;
    bool limit = false;
};

} // namespace firmware
