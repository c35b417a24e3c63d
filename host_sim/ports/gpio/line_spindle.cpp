// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/line_spindle.hpp"

#include "splinefeed/base/units.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

constexpr double relay_s = 0.05; // from the direction to the line that turns it on: two relays, one after the other
constexpr double lost_s = 0.1;   // an input that does not act for so long is no bounce

} // namespace

LineSpindle::LineSpindle(const SpindleLines& spindle, const ProgramLines& lines, double at_speed_timeout_s,
                         ProgramChips chips, hal::Clock& clock)
    : spindle_(&spindle), lines_(&lines), at_speed_timeout_s_(at_speed_timeout_s), chips_(std::move(chips)),
      clock_(&clock), turned_(spindle.reverse ? 0 : 1), changed_us_(clock.now_us()) {}

bool LineSpindle::passed(double s) const noexcept {
    return static_cast<double>(clock_->now_us() - changed_us_) >= s * us_per_s;
}

bool LineSpindle::set(const SwitchedLine& line, bool on) {
    const bool done = chips_.set(line, on);
    if (!done && trouble_.empty()) {
        trouble_ = fmt::format("{} cannot be set: {}", name_of_output(*lines_, line.line), std::strerror(errno));
    }
    changed_us_ = clock_->now_us();
    return done;
}

void LineSpindle::turn_off() {
    on_ = 0;
    at_speed_ = had_speed_ = false;
    slow_us_ = 0;
    obeys_ = set(spindle_->enable, false);
}

// Whatever the trouble is, the spindle ends.
void LineSpindle::fail(const std::string& what) {
    if (trouble_.empty()) {
        trouble_ = what;
    }
    wanted_ = 0;
    turn_off();
}

void LineSpindle::order(int direction, double /*rpm*/) {
    const std::lock_guard lock(mutex_);
    if (ended_ || !trouble_.empty()) {
        return;
    }
    wanted_ = direction;
    follow();
}

// The lines, one step at a time.
void LineSpindle::follow() {
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
void LineSpindle::watch() {
    const std::optional<SensedLine>& sensed = spindle_->at_speed;
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

void LineSpindle::update() {
    const std::lock_guard lock(mutex_);
    if (!ended_ && trouble_.empty()) {
        follow();
        watch();
    } else if (!obeys_) {
        turn_off();
    }
}

void LineSpindle::end() {
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

bool LineSpindle::reached() const {
    const std::lock_guard lock(mutex_);
    return !ended_ && trouble_.empty() && on_ == wanted_ &&
           (on_ == 0 || (passed(spindle_->spin_up_s) && (!spindle_->at_speed || at_speed_)));
}

bool LineSpindle::stands() const {
    const std::lock_guard lock(mutex_);
    return !is_on_ || (on_ == 0 && obeys_ && passed(spindle_->spin_down_s));
}

std::string LineSpindle::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

} // namespace splinefeed::host
