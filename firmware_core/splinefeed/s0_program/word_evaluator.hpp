// SPDX-License-Identifier: MIT
// WordEvaluator: values that are not plain numbers. The interpreter works without one; it then refuses # and [.
#pragma once

#include "splinefeed/s0_program/parameter_table.hpp"
#include "splinefeed/s0_program/text_cursor.hpp"

#include "splinefeed/base/status.hpp"

namespace splinefeed {

class BlockInterpreter;

/// `control` is the interpreter, whose own parameters a value may name. Expression is the one of this library; a chip
/// leaves it out and saves its code.
class WordEvaluator {
public:
    /// A value that begins with #, [ or the name of a function. After an error the cursor is at the character that is
    /// wrong.
    virtual Status value(TextCursor& text, const BlockInterpreter& control, Decimal& out) noexcept = 0;
    /// "#1 = value", from the #. It is kept until commit(): values in a block are those before the block.
    virtual Status assignment(TextCursor& text, const BlockInterpreter& control) noexcept = 0;
    /// Whether commit() has something to do.
    [[nodiscard]] virtual bool has_assignments() const noexcept = 0;
    /// Gives the parameters of the block their values. After an error none has its value, but for those of the
    /// interpreter, which puts them back itself.
    virtual Status commit(BlockInterpreter& control) noexcept = 0;
    /// Forgets the assignments of a block that is not executed.
    virtual void discard() noexcept = 0;

protected:
    ~WordEvaluator() = default;
};

} // namespace splinefeed
