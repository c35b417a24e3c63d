// SPDX-License-Identifier: MIT
// DriveModel: a simulated drive with registers and time, but without a line: its answers, and the motion of its shafts.
// ModelFaults: what it says or does that it should not, at present.
#pragma once

#include "splinefeed/hal/modbus/pvt_drive/modbus_exception.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <span>

namespace splinefeed::host {

struct ModelFaults {
    bool refuses_stops = false;           ///< quick stop, halt and hold; of a spindle: stop
    bool stuck_state = false;             ///< its state is told as it was
    bool stuck_place = false;             ///< its position and progress are told as they were
    bool no_room = false;                 ///< its ring is told to be full
    std::optional<std::uint16_t> state{}; ///< told instead of its state
    int dither_counts = 0;                ///< its position is told up to so far off, another way each time

    [[nodiscard]] bool operator==(const ModelFaults&) const = default;
};

/// The noise of an encoder: whole counts, up to `most` to each side. The same in each run.
class CountNoise {
public:
    [[nodiscard]] int next(int most) {
        return most == 0 ? 0 : static_cast<int>(random_() % (2U * static_cast<unsigned>(most) + 1U)) - most;
    }

private:
    std::minstd_rand random_{1};
};

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
    /// Reads registers, all or none. @param place  of the first one: its address, or place_in() of another table than
    /// the holding registers. A bit is a register of 0 or 1.
    [[nodiscard]] virtual ModbusException read(int place, std::span<std::uint16_t> out) = 0;
    /// Writes registers as one frame: all or none.
    [[nodiscard]] virtual ModbusException write(int place, std::span<const std::uint16_t> values) = 0;
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
