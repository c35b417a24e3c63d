// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/pin_changes.hpp"

#include <algorithm>
#include <cerrno>

namespace splinefeed::hal::gpio {

void PinChanges::begin() noexcept {
    drop();
    now_.up = written_.up = {};
    base_ = now_.step;
}

void PinChanges::drop() noexcept {
    std::fill(change_.begin(), change_.end(), Change{});
    now_ = written_;
}

void PinChanges::take(std::size_t chip, const LevelMasks& lines, bool level) noexcept {
    change_[chip].mask |= lines.mask;
    change_[chip].levels |= level ? lines.mask & ~lines.inverted : lines.mask & lines.inverted;
}

bool PinChanges::enable(bool on) noexcept {
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        const ChipOutputs& chip = chips_[c];
        take(c, chip.enable, on);
        if (!on) {
            take(c, chip.brake, false);
        }
        // With step_on_edge every change of a step line is a step, so they keep their level.
        for (const unsigned k : indices(axes_)) {
            if (!step_on_edge_) {
                take(c, chip.step[k], false);
            }
            if (on) {
                take(c, chip.direction[k], false);
            }
        }
    }
    return write();
}

bool PinChanges::brake(bool released) noexcept {
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        take(c, chips_[c].brake, released);
    }
    return write();
}

void PinChanges::add(const Edge& edge) noexcept {
    // With step_on_edge the line keeps its level from the previous motion.
    const bool turned = edge.line == Line::step && step_on_edge_ && base_[edge.axis];
    const bool level = edge.level != turned;
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        take(c, edge.line == Line::step ? chips_[c].step[edge.axis] : chips_[c].direction[edge.axis], level);
    }
    (edge.line == Line::direction ? now_.up : now_.step)[edge.axis] = level;
}

bool PinChanges::write() noexcept {
    int error = 0;
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        Change& change = change_[c];
        if (change.mask != 0 && !chips_[c].writer->set(change.mask, change.levels)) {
            error = errno;
        }
        change = {};
    }
    written_ = now_;
    errno = error != 0 ? error : errno;
    return error == 0;
}

} // namespace splinefeed::hal::gpio
