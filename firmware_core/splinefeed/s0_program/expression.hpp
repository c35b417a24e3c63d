// SPDX-License-Identifier: MIT
// Expression: parameters, operators and functions of RS274/NGC.
#pragma once

#include "splinefeed/s0_program/text/word_evaluator.hpp"

#include <array>

namespace splinefeed {

/// Evaluates [ ], + - * / ** MOD AND OR XOR EQ NE GT GE LT LE. Functions: SIN COS TAN ASIN ACOS ATAN[]/[] SQRT ABS EXP
/// LN ROUND FIX FUP EXISTS. Parameters: #1, ##1, #[...], `#<name>`. All by integers alone: the same digits on every
/// target. Angles are in degrees. Values lie within +-9.2e9 (Decimal::largest_raw) and have a resolution of 1e-9. Each
/// operation is rounded to nearest. Functions are within 2e-9 of the exact value of their rounded argument, EXP and **
/// also within 1e-15 of themselves. EQ and NE take values that differ by less than 1e-6 as equal. In dialects with
/// macros operators and functions are those of macro_operation, values may be `vacant`, and an assignment takes an
/// expression without brackets. No recursion: a value takes at most 1.7 KB of the stack of a Cortex-M4F.
class Expression final : public WordEvaluator {
public:
    static constexpr int most_assignments = 16; ///< of a block
    static constexpr int deepest = 10;          ///< brackets within brackets

    /// `table` must outlive it.
    explicit Expression(ParameterTable& table) noexcept : table_(&table) {}

    using WordEvaluator::value;
    ProgramStatus value(TextCursor& text, const BlockInterpreter& control, Decimal& out, char letter) noexcept override;
    ProgramStatus assignment(TextCursor& text, const BlockInterpreter& control) noexcept override;
    [[nodiscard]] bool has_assignments() const noexcept override { return count_ > 0; }
    ProgramStatus commit() noexcept override;
    void finish(BlockInterpreter& control) noexcept override;
    void discard() noexcept override { count_ = 0; }

private:
    struct Assignment {
        std::int32_t number = 0; // 0: by name
        std::string_view name{}; // as the line has it
        Decimal value{};
        Decimal before{}; // while the block is committed
        bool was_set = false;
    };

    bool write(Assignment& of) noexcept;
    void take_back(const Assignment& of) noexcept;

    ParameterTable* table_;
    std::array<Assignment, most_assignments> assignments_{};
    int count_ = 0;
};

} // namespace splinefeed
