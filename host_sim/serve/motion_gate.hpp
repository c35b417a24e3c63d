// SPDX-License-Identifier: MIT
// MotionGate: lets nothing of a served machine move before the state file says that its place is not known.
#pragma once

#include "host_sim/run/state_keeper.hpp"
#include "host_sim/serve/served_machine.hpp"

#include <optional>

namespace splinefeed::host {

/// Between a controller and its machine. What begins a motion, a segment or homing, waits here until the file is on the
/// disk, and nobody waits for it: stops go through, and what waits is then forgotten. For the thread of the server.
class MotionGate final : public ControlledMachine {
public:
    /// Both must outlive it. @param state  null: nothing is kept, and it is open
    MotionGate(ServedMachine& machine, StateKeeper* state) : machine_(&machine), state_(state) {}

    /// Lets through what waits, as soon as it may. Once a millisecond. Throws OutputError where something waits and the
    /// file cannot be written.
    void advance();
    [[nodiscard]] bool has_room() const { return !segment_ && machine_->has_room(); }
    /// @pre has_room()
    void submit(const FeedSegment& segment);
    [[nodiscard]] bool stands() const { return !segment_ && home_ == 0 && machine_->stands(); }
    /// Whether something may have moved since the last call of rested().
    [[nodiscard]] bool has_moved() const noexcept { return moved_; }
    void rested() noexcept { moved_ = false; }
    /// Whether the last order to the spindle was to turn.
    [[nodiscard]] bool spindle_turns() const noexcept { return spindle_turns_; }

    MachineReading read() noexcept override;
    void obey(const ProgramEvent& event) noexcept override;
    [[nodiscard]] bool has_input(std::int32_t number) const noexcept override { return machine_->has_input(number); }
    void forget_input() noexcept override { machine_->forget_input(); }
    void watch_probe(bool away) noexcept override { machine_->watch_probe(away); }
    void home(std::uint32_t axes) noexcept override;
    bool halt() noexcept override { return machine_->halt(); }
    void quick_stop() noexcept override;
    void enable(bool on) noexcept override { machine_->enable(on); }
    void reset_faults() noexcept override { machine_->reset_faults(); }
    void offsets_changed() noexcept override { machine_->offsets_changed(); }

private:
    ServedMachine* machine_;
    StateKeeper* state_;
    std::optional<FeedSegment> segment_; // these wait:
    std::uint32_t home_ = 0;
    bool gave_up_ = false; // homing, before it began
    bool moved_ = false;
    bool spindle_turns_ = false;
};

} // namespace splinefeed::host
