// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/canned_cycle.hpp"

#include "splinefeed/s0_program/cycles/program_arc.hpp"
#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/words/polar_words.hpp"

namespace splinefeed {

namespace {

constexpr Decimal peck_clearance{254 * (Decimal::one / 1000)}; // 0.01 inch above the last peck
constexpr std::int32_t most_repeats = 100000;
constexpr std::int64_t most_pecks = 100000;
constexpr std::int64_t whole_turn = 360 * Decimal::one; // [degrees]

} // namespace

// The words of the block, or those that are still in effect.
BlockStatus CannedCycle::read_words(const Block& block, const ModalState& modal, bool fresh, bool placed, char normal,
                                    CycleWords& words) noexcept {
    if (!placed && !block.has(normal)) {
        return block.at(ProgramError::cycle_depth_missing, CodeGroup::motion);
    }
    if (!placed && !block.has('r')) {
        return block.at(ProgramError::cycle_radius_missing, CodeGroup::motion);
    }
    if (dwells() && ((fresh && !block.has('p')) || block.value('p').raw < 0)) {
        return block.at(ProgramError::cycle_dwell_missing, CodeGroup::motion);
    }
    if (pecks() && ((fresh && !block.has('q')) || (block.has('q') && modal.in_mm(block.value('q')).raw < 1000))) {
        return block.at(ProgramError::cycle_peck_invalid, block.has('q') ? 'q' : 'r');
    }
    repeats_ = 1;
    if (block.has('l') && (!to_integer(block.value('l'), repeats_) || repeats_ < 1 || repeats_ > most_repeats)) {
        return block.at(ProgramError::cycle_repeats_invalid, 'l');
    }
    const SpindleState needed = code_ == 740 ? SpindleState::counterclockwise : SpindleState::clockwise;
    if (taps(code_) && modal.spindle != needed) {
        return block.at(ProgramError::tapping_direction, CodeGroup::motion);
    }
    if (block.value('p').raw < 0) {
        return block.at(ProgramError::cycle_dwell_missing, 'p');
    }
    if (code_ == 860 && modal.spindle == SpindleState::stopped) {
        return block.at(ProgramError::cycle_spindle_stopped, CodeGroup::motion);
    }
    words.depth = block.has(normal) ? modal.in_mm(block.value(normal)) : words.depth;
    words.clearance = block.has('r') ? modal.in_mm(block.value('r')) : words.clearance;
    const bool may_dwell = dwells() || taps(code_) || pecks();
    words.dwell_s = may_dwell && block.has('p') ? block.value('p') : fresh && pecks() ? Decimal{} : words.dwell_s;
    words.peck = block.has('q') ? modal.in_mm(block.value('q')) : words.peck;
    dwell_s_ = words.dwell_s;
    peck_ = words.peck;
    words.motion = code_;
    return {};
}

BlockStatus CannedCycle::begin(const Block& block, const ModalState& modal, const ModalState& before,
                               const AxisLetters& letters, const AxisPoint& at, bool series,
                               CycleWords& words) noexcept {
    const PlaneLetters plane = letters_of(modal.plane);
    const char normal = plane.axes[2];
    for (unsigned k = 0; k < 3; ++k) {
        axes_[k] = letters.index(plane.axes[k]);
        if (axes_[k] < 0) {
            return block.at(ProgramError::axis_missing, CodeGroup::motion);
        }
    }
    code_ = modal.motion;
    const bool fresh = before.motion != code_ || words.motion != code_; // a refused cycle has the mode, but no words
    const bool placed = !fresh || (series && words.begun);
    if (const BlockStatus status = read_words(block, modal, fresh, placed, normal, words); !status.ok()) {
        return status;
    }
    const auto n = static_cast<unsigned>(axes_[2]);
    if (!words.begun) {
        words.initial = at[n];
        words.begun = true;
    }
    place_ = at;
    level_ = at[n];
    first_step_ = second_step_ = {};
    start_ = {at[static_cast<unsigned>(axes_[0])], at[static_cast<unsigned>(axes_[1])]};
    clearance_ = words.clearance;
    bottom_ = words.depth;
    const std::array<Decimal*, 2> steps{&first_step_, &second_step_};
    for (unsigned k = 0; k < 2; ++k) {
        const char letter = plane.axes[k];
        if (block.has(letter)) {
            (modal.incremental ? *steps[k] : place_[static_cast<unsigned>(axes_[k])]) =
                modal.in_mm(block.value(letter));
        }
    }
    polar_ = block.has_any(Block::bits("@^"));
    if (polar_) {
        first_step_ = modal.in_mm(block.value('@'));
        second_step_ = {block.value('^').raw % whole_turn};
    }
    holes_ = 0;
    if (modal.incremental) {
        clearance_ += words.initial;
        bottom_ += clearance_;
    }
    if (clearance_ < bottom_) {
        return block.at(ProgramError::cycle_below_depth, block.has('r') ? 'r' : normal);
    }
    if (const BlockStatus status = check_steps(block, plane.axes[0]); !status.ok()) {
        return status;
    }
    if (pecks() && (clearance_ - bottom_).raw / words.peck.raw > most_pecks) {
        return block.at(ProgramError::cycle_peck_invalid, block.has('q') ? 'q' : 'r');
    }
    phase_ = words.initial < clearance_ ? Phase::lift : Phase::across;
    clear_ = modal.retract_to_r || words.initial < clearance_ ? clearance_ : words.initial;
    return {};
}

BlockStatus CannedCycle::check_steps(const Block& block, char first) const noexcept {
    for (const Decimal step : {first_step_, polar_ ? Decimal{} : second_step_}) {
        if (detail::magnitude(step.raw) > static_cast<std::uint64_t>(largest_position.raw / repeats_)) {
            return block.at(ProgramError::move_too_long, block.has('l') ? 'l' : first);
        }
    }
    if (polar_ && hypotenuse(start_[0], start_[1]).raw + first_step_.raw * repeats_ < 0) {
        return block.at(ProgramError::polar_unsuited, '@');
    }
    return {};
}

Decimal CannedCycle::radius() const noexcept {
    const Decimal begin = hypotenuse(start_[0], start_[1]);
    return !polar_ ? Decimal{} : first_step_.raw > 0 ? Decimal{begin.raw + first_step_.raw * repeats_} : begin;
}

// Polar steps are counted from the start, so that roundings do not add up.
void CannedCycle::step_to(AxisPoint& place, std::int32_t steps) const noexcept {
    const Decimal first{first_step_.raw * steps};
    const Decimal second{second_step_.raw * steps};
    const PlanePoint to = polar_ ? polar_step({start_[0], start_[1]}, first, second) : PlanePoint{first, second};
    Decimal& x = place[static_cast<unsigned>(axes_[0])];
    Decimal& y = place[static_cast<unsigned>(axes_[1])];
    x = polar_ ? to.first : x + to.first;
    y = polar_ ? to.second : y + to.second;
}

AxisPoint CannedCycle::end() const noexcept {
    AxisPoint at = place_;
    step_to(at, repeats_);
    at[static_cast<unsigned>(axes_[2])] = clear_;
    return at;
}

CycleStep CannedCycle::go(AxisPoint& at, Decimal level, CycleStep how) const noexcept {
    at = place_;
    at[static_cast<unsigned>(axes_[2])] = level;
    return how;
}

CycleStep CannedCycle::next(AxisPoint& at) noexcept {
    switch (phase_) {
    case Phase::lift:
        phase_ = Phase::across;
        level_ = clearance_;
        go(at, level_, CycleStep::rapid);
        for (unsigned k = 0; k < 2; ++k) {
            at[static_cast<unsigned>(axes_[k])] = start_[k];
        }
        return CycleStep::lift;
    case Phase::across:
        step_to(place_, polar_ ? ++holes_ : 1);
        level_ = level_ < clear_ ? clear_ : level_;
        phase_ = level_ == clearance_ ? Phase::hole : Phase::to_clearance;
        hole_step_ = 0;
        depth_ = clearance_ - peck_;
        return go(at, level_, CycleStep::rapid);
    case Phase::to_clearance: phase_ = Phase::hole; return go(at, clearance_, CycleStep::rapid);
    case Phase::hole:
        if (pecks() && depth_ > bottom_) {
            return next_peck(at);
        }
        phase_ = Phase::retract;
        hole_step_ = 0;
        return go(at, bottom_, CycleStep::feed);
    case Phase::retract:
        if (taps(code_)) {
            return next_of_tap(at);
        }
        if (hole_step_ == 0 && (dwells() || (pecks() && dwell_s_.raw > 0))) {
            hole_step_ = 1;
            return CycleStep::dwell;
        }
        if (hole_step_ == 1 && code_ == 860) {
            hole_step_ = 2;
            return CycleStep::spindle_stop;
        }
        if (hole_step_ == 0 && code_ == 850) { // it leaves the hole by feed
            hole_step_ = 1;
            return go(at, clearance_, CycleStep::feed);
        }
        --repeats_;
        level_ = clear_;
        phase_ = code_ == 860 ? Phase::restart : repeats_ > 0 ? Phase::across : Phase::finished;
        return go(at, clear_, code_ == 890 ? CycleStep::feed : CycleStep::rapid);
    case Phase::restart: phase_ = repeats_ > 0 ? Phase::across : Phase::finished; return CycleStep::spindle_start;
    case Phase::finished: break;
    }
    return CycleStep::finished;
}

// With a floating chuck, as LinuxCNC does it: in the hole the spindle is reversed, and the feed leads out.
CycleStep CannedCycle::next_of_tap(AxisPoint& at) noexcept {
    ++hole_step_;
    if (hole_step_ == 3 && dwell_s_.raw == 0) {
        ++hole_step_;
    }
    switch (hole_step_) {
    case 1:
    case 5: return CycleStep::spindle_stop;
    case 2: return CycleStep::spindle_reverse;
    case 3: return CycleStep::dwell;
    case 4: return go(at, clear_, CycleStep::feed);
    default: break;
    }
    --repeats_;
    level_ = clear_;
    phase_ = repeats_ > 0 ? Phase::across : Phase::finished;
    return CycleStep::spindle_start;
}

// Down by a peck, up to break or to clear the chip, and back to just above it.
CycleStep CannedCycle::next_peck(AxisPoint& at) noexcept {
    const std::uint8_t step = hole_step_;
    hole_step_ = static_cast<std::uint8_t>(step + 1U);
    if (step == 0) {
        hole_step_ = code_ == 730 ? 2 : 1; // G73 only breaks it
        return go(at, depth_, CycleStep::feed);
    }
    if (step == 1) {
        return go(at, clearance_, CycleStep::rapid);
    }
    hole_step_ = 0;
    const Decimal above = depth_ + peck_clearance;
    depth_ -= peck_;
    return go(at, above, CycleStep::rapid);
}

} // namespace splinefeed
