// SPDX-License-Identifier: MIT
// BlockConditions: which lines of a stream are executed: O words if, elseif, else and endif.
#pragma once

#include "splinefeed/s0_program/text/word_evaluator.hpp"
#include "splinefeed/s0_program/words/block_status.hpp"

#include <array>

namespace splinefeed {

/// Lines come one by one and are not kept, so what goes back, loops and subprograms, is refused: grblHAL does the same
/// outside of files (ngc_flowctrl.c). Unlike there a condition within lines that are left out may have any label.
/// Memory: 0.2 KB.
class BlockConditions {
public:
    static constexpr std::size_t deepest = 10; ///< conditions within conditions

    /// Takes a line if it is such a word. After an error nothing has changed.
    /// @param control   its parameters may be named
    /// @param executes  whether the line is to be executed; it is not if it is such a word
    /// Errors: o_word, condition_not_open, conditions_too_deep, those of the expression.
    BlockStatus take(std::string_view line, WordEvaluator& values, const BlockInterpreter& control,
                     bool& executes) noexcept;
    void clear() noexcept { count_ = 0; }

private:
    enum class Branch : std::uint8_t {
        sought,   ///< none was taken so far
        executes, ///< this one
        over,     ///< what is left has no turn
    };
    struct Condition {
        std::uint64_t label = 0; // of its text
        Branch branch = Branch::sought;
        bool has_else = false;
    };

    [[nodiscard]] bool executes() const noexcept;

    std::array<Condition, deepest> open_{};
    std::size_t count_ = 0;
};

} // namespace splinefeed
