// SPDX-License-Identifier: MIT
// WordExtension: coordinates of a control beside those of the interpreter. It works without one; it then refuses them.
#pragma once

#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

namespace splinefeed {

/// Where the program stands, and what has led there.
struct ProgramPlace {
    const PerAxis<Decimal>& program;
    const WorkOffsets& offsets;
};

/// FanucWords is the one of this library, with memory of the caller; a chip leaves it out and saves its code. For a
/// block take() is called for each of its G words, then adapt() and apply(). What apply() has done take_back() undoes.
class WordExtension {
public:
    /// A G word is read: what it is here. @param block  has the words before it. @param tenths  ten times its number
    virtual void take(std::int32_t tenths, const Block& block, CodeInfo& info) noexcept = 0;
    /// Takes its words out of the block, which is then what the interpreter knows.
    virtual BlockStatus adapt(Block& block, const ModalState& modal, const AxisLetters& letters,
                              const ProgramPlace& place) noexcept = 0;
    /// Executes them. True: the coordinates are others.
    virtual bool apply(WorkOffsets& offsets) noexcept = 0;
    virtual void take_back() noexcept = 0;
    /// M2, M30.
    virtual void end_program() noexcept = 0;
    /// The work system that is in effect instead of the one of WorkOffsets; null: none is.
    [[nodiscard]] virtual const WorkSystem* system() const noexcept = 0;
    /// From coordinates of the program to those of the work system, and back.
    virtual void turn(PerAxis<Decimal>& point, bool back) const noexcept = 0;
    /// The same for the size of an arc, and for its angle, which a mirror turns round. False: it is too small then.
    [[nodiscard]] virtual bool turn_arc(Decimal& radius, Decimal& sweep_deg) const noexcept = 0;

protected:
    ~WordExtension() = default;
};

} // namespace splinefeed
