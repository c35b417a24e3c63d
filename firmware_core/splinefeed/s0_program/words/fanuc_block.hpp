// SPDX-License-Identifier: MIT
// FanucBlock: a block as words of coordinates read it, before its modes are in effect.
#pragma once

#include "splinefeed/s0_program/words/word_extension.hpp"

#include <array>

namespace splinefeed {

/// The letters of its axes: the first, the second, the one across it.
[[nodiscard]] constexpr std::array<char, 3> letters_of_plane(Plane plane) noexcept {
    return plane == Plane::yz   ? std::array{'y', 'z', 'x'}
           : plane == Plane::zx ? std::array{'z', 'x', 'y'}
                                : std::array{'x', 'y', 'z'};
}

/// A block, with its own modes; places in the axes of the machine.
struct FanucBlock {
    Block& block;
    const ModalState& modal;
    const AxisLetters& letters;
    const ProgramPlace& place;
    unsigned words;
    std::int16_t modeless = block.code(CodeGroup::non_modal);
    std::int16_t motion = block.has(CodeGroup::motion) ? block.code(CodeGroup::motion) : modal.motion;
    bool inches = block.has(CodeGroup::units) ? block.code(CodeGroup::units) == 200 : modal.inches;
    bool steps = block.has(CodeGroup::distance) ? block.code(CodeGroup::distance) == 910 : modal.incremental;
    Plane plane = !block.has(CodeGroup::plane)          ? modal.plane
                  : block.code(CodeGroup::plane) == 170 ? Plane::xy
                  : block.code(CodeGroup::plane) == 180 ? Plane::zx
                                                        : Plane::yz;

    [[nodiscard]] bool has(unsigned axis) const noexcept { return block.has(letter(axis)); }
    [[nodiscard]] char letter(unsigned axis) const noexcept { return letters.letter(static_cast<int>(axis)); }
    [[nodiscard]] unsigned count() const noexcept { return static_cast<unsigned>(letters.count()); }
    [[nodiscard]] bool has_axes() const noexcept { return block.has_any(letters.bits()); }
    [[nodiscard]] bool is_space(unsigned axis) const noexcept {
        return letters.kind(static_cast<int>(axis)) == AxisKind::linear;
    }
    /// Of the word of an axis [mm or degrees].
    [[nodiscard]] Decimal value(unsigned axis) const noexcept {
        const Decimal stated = block.value(letter(axis));
        const bool converts = inches && letters.kind(static_cast<int>(axis)) != AxisKind::rotary;
        return converts ? Decimal{product_quotient(stated.raw, 254, 10).raw} : stated;
    }
    /// P as it stands: beside a cycle it has been taken for a time.
    [[nodiscard]] Decimal parameter() const noexcept {
        const Decimal p = block.value('p');
        return is_cycle(motion) && !block.has_dwell_point() ? Decimal{p.raw * 1000} : p;
    }
    [[nodiscard]] bool is_across(unsigned axis) const noexcept { return letter(axis) == letters_of_plane(plane)[2]; }
    [[nodiscard]] bool in_plane(unsigned axis) const noexcept {
        const std::array<char, 3> of = letters_of_plane(plane);
        return letter(axis) == of[0] || letter(axis) == of[1];
    }
};

} // namespace splinefeed
