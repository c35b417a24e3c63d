// SPDX-License-Identifier: MIT
// StepperMachine: the board's machine, as the controller knows it: segments to parts of motion, stops, where it stands.
#pragma once

#include "machine.hpp"

#include "splinefeed/controller/controlled_machine.hpp"
#include "splinefeed/s5_pulse_train/dda_loader.hpp"

namespace firmware {

/// It has no spindle, no probe and no home switches. Steps are counted, so a stop along the path loses no position; one
/// by the emergency stop, or by a second reset, may.
class StepperMachine final : public splinefeed::ControlledMachine {
public:
    /// @param known  false: the steps that were made are lost, and $X has to unlock the machine
    StepperMachine(Steps& steps, bool known) noexcept : steps_(steps), known_(known) {}

    /// Once in a round of the main loop, before the controller is called.
    /// @param inputs  as the last tick read them   @param bytes_lost  by the UART
    void look(Inputs inputs, bool bytes_lost) noexcept;
    [[nodiscard]] bool has_room() const noexcept { return steps_.room() > 0; }
    /// Hardly any motion lies ahead; or it has not begun, because the ring is to be fuller, and no more comes.
    [[nodiscard]] bool is_dry() const noexcept {
        return steps_.level() <= enough || (!steps_.active() && steps_.ticks() - submitted_ > longest_pause);
    }
    /// @pre has_room()
    void submit(const splinefeed::FeedSegment& segment) noexcept;

    [[nodiscard]] splinefeed::MachineReading read() noexcept override;
    void obey(const splinefeed::ProgramEvent& /*event*/) noexcept override {}
    void watch_probe(bool /*away*/) noexcept override {}
    void home(std::uint32_t /*axes*/) noexcept override {}
    bool halt() noexcept override;
    void quick_stop() noexcept override { steps_.order(Stop::cut); }
    void enable(bool on) noexcept override;
    void reset_faults() noexcept override {}

private:
    // More than the reserve, with which it slows down: what is planned until then is to be in time.
    static constexpr std::size_t enough = (std::size_t{5} << lookahead.reserve_log2) / 4;
    static_assert(enough < lookahead.start);
    static constexpr std::uint32_t longest_pause = 50'000 / board::tick_us; // of segments

    Steps& steps_;
    static constexpr splinefeed::DdaLoader first_loader{static_cast<int>(axes), tick_ticks, board::Lines::samples};
    splinefeed::DdaLoader loader_ = first_loader;
    MotionPart part_;
    Inputs inputs_;
    std::uint32_t submitted_ = 0; // the tick of the last segment
    std::uint32_t waypoint_ = 0;  // of that
    static_assert(board::parts < 256, "the generator knows as many digits of a waypoint");
    splinefeed::Alarm alarm_ = splinefeed::Alarm::none;
    bool known_;
    bool has_stopped_ = false; // on the path, as this round shows: where it stands is to be asked for
};

} // namespace firmware
