// SPDX-License-Identifier: MIT
// LineSpindle: a spindle that GPIO lines turn on and off.
#pragma once

#include "host_sim/ports/gpio/program_chips.hpp"
#include "host_sim/ports/run_spindle.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <mutex>

namespace splinefeed::host {

/// Its speed is reached spin_up_s after it was turned on, and then when its input says so. It stands spin_down_s after
/// it was turned off, and is turned in the other direction only then.
class LineSpindle final : public RunSpindle {
public:
    /// @param lines  with the spindle's; these and the spindle must outlive it   @param chips  of these lines, which
    /// are off
    LineSpindle(const SpindleLines& spindle, const ProgramLines& lines, double at_speed_timeout_s, ProgramChips chips,
                hal::Clock& clock = hal::system_clock());

    void order(int direction, double rpm) override;
    void update() override;
    void end() override;
    [[nodiscard]] bool reached() const override;
    [[nodiscard]] bool stands() const override;
    [[nodiscard]] std::string trouble() const override;
    [[nodiscard]] double stop_timeout_s() const override { return spindle_->spin_down_s + 0.5; }

private:
    [[nodiscard]] bool set(const SwitchedLine& line, bool on);
    void turn_off();
    void follow();
    void watch();
    void fail(const std::string& what);
    [[nodiscard]] bool passed(double s) const noexcept;

    const SpindleLines* spindle_;
    const ProgramLines* lines_;
    double at_speed_timeout_s_;
    ProgramChips chips_;
    hal::Clock* clock_;
    mutable std::mutex mutex_; // of what follows
    int wanted_ = 0;
    int on_ = 0;            // as the lines are: 1, -1 or 0
    int turned_ = 0;        // the last direction; 0: unknown
    bool reverse_ = false;  // level of that line
    bool is_on_ = false;    // it was on in this run
    bool obeys_ = true;     // the line that turns it off could be set
    bool at_speed_ = false; // by the input, if there is one
    bool had_speed_ = false;
    std::uint64_t changed_us_; // a line changed last
    std::uint64_t slow_us_ = 0;
    bool ended_ = false;
    std::string trouble_;
};

} // namespace splinefeed::host
