// SPDX-License-Identifier: MIT
// DriveModel: a simulated drive with registers and time, but without a line: its answers, and the motion of its shafts.
#pragma once

#include "host_sim/drive/model_faults.hpp"

#include "splinefeed/hal/modbus/pvt_drive/modbus_exception.hpp"

#include <span>

namespace splinefeed::host {

using hal::modbus::ModbusException;

/// A drive of one or several axes. Its time is that of its own clock, and passes only in advance().
class DriveModel {
public:
    DriveModel() = default;
    DriveModel(const DriveModel&) = delete;
    DriveModel& operator=(const DriveModel&) = delete;
    virtual ~DriveModel() = default;

    /// Lets its time pass. @pre now_us is not before that of the last call
    virtual void advance(std::uint64_t now_us) = 0;
    /// Reads holding registers, all or none.
    [[nodiscard]] virtual ModbusException read(int address, std::span<std::uint16_t> out) = 0;
    /// Writes holding registers as one frame: all or none.
    [[nodiscard]] virtual ModbusException write(int address, std::span<const std::uint16_t> values) = 0;
    /// Power off and on: the shafts stay where they are; everything that is not in flash is lost.
    virtual void power_cycle() = 0;
    /// A fault: the word order of numbers of several registers is reversed from now on. A second call restores it.
    virtual void swap_words() {}
    /// What it says and does wrong from now on.
    virtual void set_faults(const ModelFaults& /*faults*/) {}
    /// Another master tells it to stop and, where it has sessions, begins one of its own.
    virtual void second_master() {}

    [[nodiscard]] virtual int axes() const = 0;
    /// Position of the shaft. [counts]
    [[nodiscard]] virtual double position_counts(int axis) const = 0;
};

} // namespace splinefeed::host
