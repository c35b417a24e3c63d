// SPDX-License-Identifier: MIT
// WorkFrame: from coordinates of the program to those of the machine, and back.
#pragma once

#include "splinefeed/s0_program/text/elementary.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/word_extension.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

namespace splinefeed {

/// A point of all axes; in mm or degrees, whatever units the program has.
using AxisPoint = PerAxis<Decimal>;

/// machine = turned(program + G92) + origin of the work system + tool. An extension turns the program before, and may
/// have another work system. Whoever changes offsets() calls update().
class WorkFrame {
public:
    explicit WorkFrame(const AxisLetters& letters, const WordExtension* extension = nullptr) noexcept
        : extension_(extension), x_(static_cast<std::int8_t>(letters.index('x'))),
          y_(static_cast<std::int8_t>(letters.index('y'))), axes_(static_cast<std::int8_t>(letters.count())) {
        update();
    }

    [[nodiscard]] WorkOffsets& offsets() noexcept { return offsets_; }
    [[nodiscard]] const WorkOffsets& offsets() const noexcept { return offsets_; }
    void update() noexcept;

    [[nodiscard]] AxisPoint to_machine(const AxisPoint& program) const noexcept;
    /// The inverse within 1e-9 mm; exact without rotation.
    [[nodiscard]] AxisPoint to_program(const AxisPoint& machine) const noexcept;
    /// The same with another work system, and without the extension.
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
    [[nodiscard]] const WorkSystem& system() const noexcept;
    [[nodiscard]] AxisPoint leave(const WorkSystem& of, const AxisPoint& machine) const noexcept;

    WorkOffsets offsets_{};
    const WordExtension* extension_;
    SineCosine turn_{};
    bool turned_ = false;
    std::int8_t x_; // -1: the machine does not have it
    std::int8_t y_;
    std::int8_t axes_;
};

} // namespace splinefeed
