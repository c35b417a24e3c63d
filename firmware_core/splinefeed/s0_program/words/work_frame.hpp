// SPDX-License-Identifier: MIT
// WorkFrame: from coordinates of the program to those of the machine, and back.
#pragma once

#include "splinefeed/s0_program/text/elementary.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

namespace splinefeed {

/// A point of all axes; in mm or degrees, whatever units the program has.
using AxisPoint = PerAxis<Decimal>;

/// machine = turned(program + G92) + origin of the work system + tool. Whoever changes offsets() calls update().
class WorkFrame {
public:
    explicit WorkFrame(const AxisLetters& letters) noexcept
        : x_(letters.index('x')), y_(letters.index('y')), axes_(letters.count()) {
        update();
    }

    [[nodiscard]] WorkOffsets& offsets() noexcept { return offsets_; }
    [[nodiscard]] const WorkOffsets& offsets() const noexcept { return offsets_; }
    void update() noexcept;

    [[nodiscard]] AxisPoint to_machine(const AxisPoint& program) const noexcept;
    /// The inverse within 1e-9 mm; exact without rotation.
    [[nodiscard]] AxisPoint to_program(const AxisPoint& machine) const noexcept;
    /// The same with another work system.
    [[nodiscard]] AxisPoint to_program(const AxisPoint& machine, int system) const noexcept;
    /// Directions x and y of the work system, in the axes x and y of the machine.
    [[nodiscard]] const SineCosine& rotation() const noexcept { return turn_; }
    [[nodiscard]] bool is_turned() const noexcept { return turned_; }

    /// G10 L20: the origin for which the present place is `values`.
    void set_place(int system, const AxisPoint& machine, const AxisPoint& values) noexcept;
    /// G92: `value` is where the axis stands. G52: the offset itself.
    void begin_g92() noexcept;

    /// The offset of an axis that applies.
    [[nodiscard]] Decimal g92(int axis) const noexcept {
        return offsets_.g92_applies ? offsets_.g92[static_cast<unsigned>(axis)] : Decimal{};
    }

private:
    void turn(AxisPoint& point, const SineCosine& by, bool back) const noexcept;

    WorkOffsets offsets_{};
    SineCosine turn_{};
    bool turned_ = false;
    int x_;
    int y_;
    int axes_;
};

} // namespace splinefeed
