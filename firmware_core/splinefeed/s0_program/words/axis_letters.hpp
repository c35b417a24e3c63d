// SPDX-License-Identifier: MIT
// AxisLetters: which axis of the machine a letter of the program means.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s0_program/dialects/program_settings.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed {

/// How the feed of a move counts an axis: x, y, z before u, v, w before a, b, c; the extruder only where it is alone.
enum class AxisKind : std::uint8_t { linear, second_linear, rotary, extruder };

class AxisLetters {
public:
    explicit constexpr AxisLetters(const ProgramSettings& settings) noexcept : count_(settings.axes) {
        for (const unsigned k : indices(max_axes)) {
            letters_[k] = static_cast<int>(k) < count_ ? lower_case(settings.letters[k]) : '\0';
            bits_ |= static_cast<int>(k) < count_ ? 1U << (static_cast<unsigned>(letters_[k] - 'a') % 32U) : 0U;
        }
    }

    [[nodiscard]] constexpr int count() const noexcept { return count_; }
    /// In lower case, 0 to count() - 1.
    [[nodiscard]] constexpr char letter(int axis) const noexcept { return letters_[static_cast<unsigned>(axis)]; }
    /// -1: the machine does not have it. @param letter  in lower case
    [[nodiscard]] constexpr int index(char letter) const noexcept {
        for (const unsigned k : indices(max_axes)) {
            if (letters_[k] == letter) {
                return static_cast<int>(k) < count_ ? static_cast<int>(k) : -1;
            }
        }
        return -1;
    }
    /// @pre the machine has it
    [[nodiscard]] constexpr unsigned place(char letter) const noexcept {
        const int axis = index(letter);
        SPLINEFEED_ASSERT(axis >= 0);
        return axis < 0 ? 0U : static_cast<unsigned>(axis); // where a compiler cannot see that, it warns of -1
    }
    /// Bit n for the n-th letter of the alphabet, of all axes.
    [[nodiscard]] constexpr std::uint32_t bits() const noexcept { return bits_; }
    [[nodiscard]] constexpr AxisKind kind(int axis) const noexcept {
        const char c = letter(axis);
        return c == 'e'               ? AxisKind::extruder
               : c <= 'c'             ? AxisKind::rotary
               : c >= 'u' && c <= 'w' ? AxisKind::second_linear
                                      : AxisKind::linear;
    }
    /// Where x, y and z stand among the first three axes; one that the machine lacks takes a place that is left. @pre
    /// those that it has stand there
    [[nodiscard]] constexpr std::array<int, 3> space_places() const noexcept {
        const std::array<int, 3> axes{index('x'), index('y'), index('z')};
        std::array<int, 3> places = axes;
        int free = 0;
        for (int& place : places) {
            while (place < 0 && (free == axes[0] || free == axes[1] || free == axes[2])) {
                ++free;
            }
            place = place < 0 ? free++ : place;
        }
        return places;
    }

private:
    int count_ = 0;
    std::uint32_t bits_ = 0;
    std::array<char, static_cast<unsigned>(max_axes)> letters_{};
};

} // namespace splinefeed
