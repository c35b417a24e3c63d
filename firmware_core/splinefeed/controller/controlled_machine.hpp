// SPDX-License-Identifier: MIT
// ControlledMachine: what a controller knows of its machine, and orders beside segments.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/controller/alarm.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/s0_program/words/output_list.hpp"

namespace splinefeed {

enum class HomingPhase : std::uint8_t {
    none,
    busy,
    done,
    failed,
    not_cleared, ///< failed: a switch acts where its axis should be off it
};

/// Inputs as the status shows them, by bits; those of the axes' limit switches are bits 0 to 5.
struct InputBits {
    static constexpr std::uint32_t probe = 1U << 8;
    static constexpr std::uint32_t door = 1U << 9;
    static constexpr std::uint32_t hold = 1U << 10;
    static constexpr std::uint32_t reset = 1U << 11;
    static constexpr std::uint32_t emergency_stop = 1U << 12;
};

/// The machine at an instant.
struct MachineReading {
    PerAxis<Position> position{}; ///< where the axes are
    bool stands = true;           ///< all segments that were submitted are executed, and nothing moves
    bool executes = false;        ///< a segment, of this waypoint:
    std::uint32_t waypoint = 0;
    bool known = true;         ///< the position is that of the machine; false: it has to home
    bool spindle_ready = true; ///< the orders are carried out: the spindle has its speed; the input of M66 has answered
    bool spindle_stands = true; ///< it is known to; counts where it was told to
    std::int32_t input = 0;     ///< that answer: 0, 1, or -1 after its time
    std::uint32_t inputs = 0;   ///< those that are active, InputBits
    bool touched = false;       ///< the probe has changed as watch_probe() said, at touched_at
    PerAxis<Position> touched_at{};
    HomingPhase homing = HomingPhase::none;
    Alarm alarm = Alarm::none;       ///< as long as its cause lasts
    std::string_view alarm_sentence; ///< what the machine says of it; empty: what row_of() says
    std::string_view note;           ///< what else its operator should know now; empty: nothing
    Decimal feed_mm_min{};           ///< speed along the path
};

class ControlledMachine : public OutputList {
public:
    [[nodiscard]] virtual MachineReading read() noexcept = 0;
    /// Spindle, coolant, outputs: at once, or when the segments that were submitted before are executed, as the event's
    /// kind says. What it does not have it ignores.
    virtual void obey(const ProgramEvent& event) noexcept = 0;
    /// By default it has none: what would switch one is refused. Of an input that it has obey() begins the wait.
    [[nodiscard]] bool has_output(EventKind /*kind*/, std::int32_t /*number*/) const noexcept override { return false; }
    /// That wait is given up. Other orders do not end it.
    virtual void forget_input() noexcept {}
    /// From now on the next contact, or the loss of it, is to be noted with its place.
    virtual void watch_probe(bool away) noexcept = 0;
    /// Begins homing; read() says how it goes. @param axes  bits of the axes
    virtual void home(std::uint32_t axes) noexcept = 0;
    /// Stops all axes on the path, sooner than the motion could brake: segments that it has are forgotten, and read()
    /// says where it then stands. false: it does not do so, and the motion has to brake.
    virtual bool halt() noexcept = 0;
    /// Stops all axes as hard as it can, off the path: segments that it has are forgotten.
    virtual void quick_stop() noexcept = 0;
    /// Switches the drives. @pre the machine stands
    virtual void enable(bool on) noexcept = 0;
    /// Tries to end what `alarm` reports: faults of drives. The machine does not stand until it has tried.
    virtual void reset_faults() noexcept = 0;

protected:
    ControlledMachine() = default;
    ControlledMachine(const ControlledMachine&) = default;
    ControlledMachine& operator=(const ControlledMachine&) = default;
    ~ControlledMachine() = default;
};

} // namespace splinefeed
