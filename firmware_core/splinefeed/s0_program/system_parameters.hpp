// SPDX-License-Identifier: MIT
// SystemParameters: the parameters of the control.
#pragma once

#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

/// Parameters that the interpreter itself holds. They are #5061 to #5069 and #5070 (probe), #5161, #5181 (G28, G30),
/// #5210 to #5390 (offsets), #5399 (M66), #5400 to #5428 (tool, position), and names such as `#<_x>`. A view: programs
/// without expressions do not link it.
class SystemParameters {
public:
    explicit SystemParameters(const BlockInterpreter& interpreter) noexcept : interpreter_(&interpreter) {}

    /// Whether the number is one of them; the ParameterTable is not asked for those.
    [[nodiscard]] static bool owns(std::int32_t number) noexcept;
    [[nodiscard]] Decimal read(std::int32_t number) const noexcept;
    /// False: it is none of the control's names.
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept;
    [[nodiscard]] static bool can_write(std::int32_t number) noexcept;
    /// @pre can_write(number), is_position(value)
    static void write(BlockInterpreter& interpreter, std::int32_t number, Decimal value) noexcept;

private:
    /// Whether the mode that the text names applies. False: there is none.
    [[nodiscard]] bool read_mode(const TextCursor& text, bool& applies) const noexcept;
    [[nodiscard]] Decimal of_axis(const AxisPoint& point, std::int32_t index) const noexcept;
    [[nodiscard]] Decimal in_units(Decimal value, std::int32_t index) const noexcept;

    const BlockInterpreter* interpreter_;
};

} // namespace splinefeed
