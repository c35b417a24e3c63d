// SPDX-License-Identifier: MIT
// PvtBench: a simulated drive, spoken to through its registers.
#pragma once

#include "host_sim/drive/pvt_drive.hpp"

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace splinefeed_test {

using splinefeed::host::ExecutedSegment;
using splinefeed::host::ModbusException;
using splinefeed::host::PvtDrive;
using splinefeed::host::PvtDriveParameters;
using namespace splinefeed::hal::modbus;

struct PvtBench {
    explicit PvtBench(int axes = 2, PvtDriveParameters parameters = {}) : drive(sized(std::move(parameters), axes)) {
        drive.machine().observe([this](const ExecutedSegment& segment) { executed.push_back(segment); });
    }

    static PvtDriveParameters sized(PvtDriveParameters parameters, int axes) {
        parameters.axes.resize(static_cast<std::size_t>(axes), parameters.axes.front());
        return parameters;
    }

    std::vector<std::uint16_t> registers_of(PvtBlock block, const std::vector<PvtSegment>& segments = {}) {
        block.nonce = ++nonce;
        block.count = static_cast<std::uint16_t>(segments.size());
        PvtBlockRegisters registers{};
        const std::size_t size = encode(block, segments, drive.axes(), registers);
        return {registers.begin(), registers.begin() + static_cast<std::ptrdiff_t>(size)};
    }

    PvtStatus status() {
        std::vector<std::uint16_t> registers(pvt::status_registers(drive.axes()));
        if (drive.read(pvt::status_address, registers) != ModbusException::none || !status_holds(registers)) {
            throw std::runtime_error("the status cannot be read");
        }
        return decode_status(registers, drive.axes());
    }

    PvtStatus send(const PvtBlock& block, const std::vector<PvtSegment>& segments = {}) {
        if (drive.write(pvt::block_address, registers_of(block, segments)) != ModbusException::none) {
            throw std::runtime_error("the block is answered by an exception");
        }
        return status();
    }
    PvtStatus command(PvtCommand command, std::uint32_t argument = 0, const std::vector<PvtSegment>& segments = {}) {
        return send({.session = session, .command = command, .command_counter = ++counter, .argument = argument},
                    segments);
    }
    PvtStatus feed(std::uint32_t first, const std::vector<PvtSegment>& segments) {
        return send({.session = session, .first = first}, segments);
    }
    /// Enabled, a session that begins with this number.
    void begin(std::uint32_t first = 0) {
        static_cast<void>(command(PvtCommand::enable));
        static_cast<void>(command(PvtCommand::begin, first));
    }
    void start_now() { static_cast<void>(command(PvtCommand::start, drive.machine().clock_us())); }
    void wait_us(std::uint64_t us) { drive.advance(now_us += us); }
    PvtState state() { return status().state; }

    PvtDrive drive;
    std::vector<ExecutedSegment> executed;
    std::uint64_t now_us = 0;
    std::uint16_t session = 77;
    std::uint16_t counter = 0;
    std::uint16_t nonce = 0;
};

/// The same velocity all along, so many counts a second on each axis (doubled, tripled ... on the others).
inline std::vector<PvtSegment> steady(int axes, std::size_t count, std::uint32_t ticks, double counts_per_s,
                                      std::size_t first = 0) {
    std::vector<PvtSegment> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        out[i].duration_ticks = ticks;
        for (const unsigned k : splinefeed::indices(axes)) {
            const double way = counts_per_s * (k + 1) * ticks / splinefeed::ticks_per_s;
            out[i].end[k] = std::llround(way * 65536.0) * static_cast<std::int64_t>(first + i + 1);
            out[i].end_velocity[k] = std::llround(way * 65536.0) * 256;
        }
    }
    return out;
}

/// Random ends within +-`reach` counts of where the last one ended, the last at rest.
inline std::vector<PvtSegment> random_segments(std::mt19937_64& random, int axes, std::size_t count, double reach) {
    const auto uniform = [&] {
        return static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0;
    };
    std::vector<PvtSegment> out(count);
    splinefeed::PerAxis<std::int64_t> at{};
    for (PvtSegment& segment : out) {
        segment.duration_ticks = pvt::shortest_ticks + static_cast<std::uint32_t>(random() % 40000);
        segment.rest = &segment == &out.back();
        for (const unsigned k : splinefeed::indices(axes)) {
            at[k] += std::llround(uniform() * reach * 65536.0);
            segment.end[k] = at[k];
            segment.end_velocity[k] = segment.rest ? 0 : std::llround(uniform() * reach * 16777216.0);
        }
    }
    return out;
}

/// Where the motion through the segments from rest at 0 is, by the document's formula alone. [counts]
inline long double hermite(const std::vector<PvtSegment>& segments, unsigned axis, long double ticks) {
    long double p0 = 0.0L;
    long double v0_per_tick = 0.0L;
    for (const PvtSegment& segment : segments) {
        const long double duration = segment.duration_ticks;
        const long double p1 = static_cast<long double>(segment.end[axis]) / 65536.0L;
        const long double v1 = static_cast<long double>(segment.end_velocity[axis]) / 16777216.0L;
        if (ticks <= duration) {
            const long double u = ticks / duration;
            const long double v0 = v0_per_tick * duration;
            return p0 + v0 * u + (3.0L * (p1 - p0) - 2.0L * v0 - v1) * u * u + (2.0L * (p0 - p1) + v0 + v1) * u * u * u;
        }
        ticks -= duration;
        p0 = p1;
        v0_per_tick = v1 / duration;
    }
    return p0;
}

} // namespace splinefeed_test
