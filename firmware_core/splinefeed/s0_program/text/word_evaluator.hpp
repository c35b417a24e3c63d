// SPDX-License-Identifier: MIT
// WordEvaluator: values that are not plain numbers. The interpreter works without one; it then refuses # and [.
#pragma once

#include "splinefeed/s0_program/text/parameter_table.hpp"
#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

class BlockInterpreter;

/// `control` is the interpreter, whose own parameters a value may name. Expression is the one of this library; a chip
/// leaves it out and saves its code.
class WordEvaluator {
public:
    /// A value that begins with #, [ or the name of a function. After an error the cursor is at the character that is
    /// wrong. In dialects with macros it may be `vacant`.
    /// @param letter  of its word, in lower case; 0: it is of none
    virtual ProgramStatus value(TextCursor& text, const BlockInterpreter& control, Decimal& out,
                                char letter) noexcept = 0;
    ProgramStatus value(TextCursor& text, const BlockInterpreter& control, Decimal& out) noexcept {
        return value(text, control, out, '\0');
    }
    /// "#1 = value", from the #. It is kept until commit() and finish(): values in a block are those before the block.
    virtual ProgramStatus assignment(TextCursor& text, const BlockInterpreter& control) noexcept = 0;
    /// Whether finish() may have something to do, and before it commit().
    [[nodiscard]] virtual bool has_assignments() const noexcept = 0;
    /// Gives the parameters of the program that the block assigns their values. After an error none has its value.
    virtual ProgramStatus commit() noexcept = 0;
    /// The same for those of the interpreter, behind the motion of the block: it is made with the offsets before.
    virtual void finish(BlockInterpreter& control) noexcept = 0;
    /// Forgets the assignments of a block that is not executed.
    virtual void discard() noexcept = 0;

protected:
    ~WordEvaluator() = default;
};

} // namespace splinefeed
