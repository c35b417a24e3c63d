// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/pin_outputs.hpp"

#include "host_sim/ports/switch_turns.hpp"

#include "splinefeed/base/units.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <utility>

namespace splinefeed::host {

namespace {

constexpr double relay_s = 0.05; // from the direction to the line that turns it on: two relays, one after the other
constexpr double lost_s = 0.1;   // an input that does not act for so long is no bounce

/// A spindle. Its speed is reached spin_up_s after it was turned on, and then when its input says so. It stands
/// spin_down_s after it was turned off, and is turned in the other direction only then.
class PinSpindle final : public OutputPart {
public:
    PinSpindle(const SpindlePins& spindle, const ProgramPins& lines, double at_speed_timeout_s, ProgramChips chips,
               hal::Clock& clock)
        : spindle_(&spindle), lines_(&lines), at_speed_timeout_s_(at_speed_timeout_s), chips_(std::move(chips)),
          clock_(&clock), turned_(spindle.reverse ? 0 : 1), changed_us_(clock.now_us()) {}

    // Its speed is set elsewhere.
    void act(const ProgramAction& action) override {
        const std::lock_guard lock(mutex_);
        if (action.spindle && !ended_ && trouble_.empty()) {
            wanted_ = action.spindle->direction;
            follow();
        }
    }

    void update() override {
        const std::lock_guard lock(mutex_);
        if (!ended_ && trouble_.empty()) {
            follow();
            watch();
        } else if (!obeys_) {
            turn_off();
        }
    }

    void end() noexcept override {
        const std::lock_guard lock(mutex_);
        if (std::exchange(ended_, true)) {
            return;
        }
        const bool was_on = on_ != 0;
        const std::uint64_t off_us = changed_us_;
        wanted_ = 0;
        turn_off();
        changed_us_ = was_on ? changed_us_ : off_us; // since then it comes to a standstill
    }

    [[nodiscard]] Progress progress() const override {
        const std::lock_guard lock(mutex_);
        const bool has_speed = on_ == 0 || (passed(spindle_->spin_up_s) && (!spindle_->at_speed || at_speed_));
        return {.carried_out = !ended_ && trouble_.empty() && on_ == wanted_ && has_speed,
                .stands = !is_on_ || (on_ == 0 && obeys_ && passed(spindle_->spin_down_s)),
                .stop_timeout_s = spindle_->spin_down_s + 0.5,
                .coasts_s = spindle_->spin_down_s};
    }

    [[nodiscard]] std::string trouble() const override {
        const std::lock_guard lock(mutex_);
        return trouble_;
    }

private:
    [[nodiscard]] bool set(const SwitchedPin& line, bool on) {
        const bool done = chips_.set(line, on);
        if (!done && trouble_.empty()) {
            trouble_ = fmt::format("{} cannot be set: {}", name_of_output(*lines_, line.line), std::strerror(errno));
        }
        changed_us_ = clock_->now_us();
        return done;
    }

    void turn_off() {
        on_ = 0;
        at_speed_ = had_speed_ = false;
        slow_us_ = 0;
        obeys_ = set(spindle_->enable, false);
    }

    // The lines, one step at a time.
    void follow() {
        if (on_ == wanted_) {
            return;
        }
        if (on_ != 0) {
            turn_off();
            return;
        }
        if (turned_ != wanted_ && !passed(spindle_->spin_down_s)) {
            return;
        }
        turned_ = wanted_;
        if (spindle_->reverse && reverse_ != (wanted_ < 0)) {
            reverse_ = wanted_ < 0;
            static_cast<void>(set(*spindle_->reverse, reverse_));
            return;
        }
        if (spindle_->reverse && !passed(relay_s)) {
            return;
        }
        on_ = wanted_;
        is_on_ = true;
        static_cast<void>(set(spindle_->enable, true));
    }

    // The input, while the spindle is on.
    void watch() {
        const std::optional<SensedPin>& sensed = spindle_->at_speed;
        if (!sensed || on_ == 0) {
            return;
        }
        const auto levels = chips_.source[sensed->line.chip]->levels();
        if (!levels) {
            fail(fmt::format("the spindle's at_speed line cannot be read: {}", std::strerror(errno)));
            return;
        }
        at_speed_ = ((*levels & sensed->line.mask()) != 0) == sensed->active_level;
        const std::uint64_t now_us = clock_->now_us();
        slow_us_ = at_speed_ ? 0 : slow_us_ == 0 ? now_us : slow_us_;
        had_speed_ = had_speed_ || (at_speed_ && passed(spindle_->spin_up_s));
        if (had_speed_ && slow_us_ != 0 && static_cast<double>(now_us - slow_us_) > lost_s * us_per_s) {
            fail("the spindle has lost its speed: its line at_speed does not act any more");
        } else if (!had_speed_ && passed(spindle_->spin_up_s + at_speed_timeout_s_)) {
            fail(fmt::format("the spindle has not reached its speed in {:g} s: its line at_speed does not act",
                             spindle_->spin_up_s + at_speed_timeout_s_));
        }
    }

    // Whatever the trouble is, the spindle ends.
    void fail(const std::string& what) {
        if (trouble_.empty()) {
            trouble_ = what;
        }
        wanted_ = 0;
        turn_off();
    }

    [[nodiscard]] bool passed(double s) const noexcept {
        return static_cast<double>(clock_->now_us() - changed_us_) >= s * us_per_s;
    }

    const SpindlePins* spindle_;
    const ProgramPins* lines_;
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

/// Coolant and digital outputs.
class GpioSwitches final : public OutputPart {
public:
    GpioSwitches(const ProgramPins& lines, ProgramChips chips) : lines_(&lines), chips_(std::move(chips)) {}
    ~GpioSwitches() override { GpioSwitches::end(); }

    void act(const ProgramAction& action) override {
        const std::lock_guard lock(mutex_);
        if (ended_ || !trouble_.empty()) {
            return;
        }
        for (const SwitchTurn& each : switch_turns(*lines_, action.kind, action.number)) {
            turn(each);
        }
    }

    // A line that fails does not keep the others from being safe.
    void end() noexcept override {
        const std::lock_guard lock(mutex_);
        if (std::exchange(ended_, true)) {
            return;
        }
        for (const SwitchTurn& each : safe_turns(*lines_)) {
            const std::string name = turn(each);
            unset_ = unset_.empty() ? name : unset_;
        }
    }

    [[nodiscard]] std::string trouble() const override {
        const std::lock_guard lock(mutex_);
        return trouble_;
    }

    [[nodiscard]] std::string unconfirmed() const override {
        const std::lock_guard lock(mutex_);
        return unset_;
    }

private:
    /// Returns the line that cannot be set; empty: it is set, or another's.
    // The first trouble is told. Coils are those of others.
    std::string turn(const SwitchTurn& turn) {
        const auto* const line = std::get_if<SwitchedPin>(turn.line);
        if (line == nullptr || chips_.set(*line, turn.on)) {
            return {};
        }
        const int error = errno;
        std::string name = name_of_output(*lines_, line->line);
        if (trouble_.empty()) {
            trouble_ = fmt::format("{} cannot be set: {}", name, std::strerror(error));
        }
        return name;
    }

    const ProgramPins* lines_;
    ProgramChips chips_;
    mutable std::mutex mutex_;
    bool ended_ = false;
    std::string trouble_;
    std::string unset_; // the first line that end() could not set
};

/// Digital inputs. Each take() reads the line: a level that lasts for less than the time between two of them may be
/// missed.
class PinInputs final : public OutputPart {
public:
    PinInputs(const ProgramPins& lines, ProgramChips chips, hal::Clock& clock)
        : lines_(&lines), chips_(std::move(chips)), clock_(&clock) {}

    void act(const ProgramAction& action) override {
        if (action.kind == EventKind::input_wait) {
            const DigitalInput* const input = lines_->input(action.number);
            watched_ = input != nullptr ? std::get_if<SensedPin>(&input->line) : nullptr;
            number_ = action.number;
        }
    }

    [[nodiscard]] std::optional<InputReading> take() override {
        if (watched_ == nullptr) {
            return std::nullopt;
        }
        const std::uint64_t asked_us = clock_->now_us();
        const auto levels = chips_.source[watched_->line.chip]->levels();
        if (!levels) {
            const std::lock_guard lock(mutex_);
            trouble_ = fmt::format("the line of input {} cannot be read: {}", number_, std::strerror(errno));
            return std::nullopt;
        }
        return InputReading{((*levels & watched_->line.mask()) != 0) == watched_->active_level, asked_us};
    }

    [[nodiscard]] std::string trouble() const override {
        const std::lock_guard lock(mutex_);
        return trouble_;
    }

private:
    const ProgramPins* lines_;
    ProgramChips chips_;
    hal::Clock* clock_;
    const SensedPin* watched_ = nullptr;
    std::int32_t number_ = 0;
    mutable std::mutex mutex_;
    std::string trouble_; // protected by it
};

} // namespace

OutputParts pin_outputs(const MachineDescription& machine, const ProgramChips& chips, hal::Clock& clock) {
    OutputParts out;
    if (machine.spindle && machine.spindle->lines) {
        out.push_back(std::make_shared<PinSpindle>(*machine.spindle->lines, machine.lines,
                                                   machine.spindle->at_speed_timeout_s, chips, clock));
    }
    out.push_back(std::make_shared<GpioSwitches>(machine.lines, chips));
    out.push_back(std::make_shared<PinInputs>(machine.lines, chips, clock));
    return out;
}

OutputParts make_pin_outputs(const MachineDescription& machine) {
    return machine.lines.empty() ? OutputParts{} : pin_outputs(machine, open_program_chips(machine.lines));
}

} // namespace splinefeed::host
