// SPDX-License-Identifier: MIT
// LineParts: where the moves of a line end that was programmed as several.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"

/// So many places of LineParts. With less than 288 not all lines of many moves are one.
#ifndef SPLINEFEED_LINE_PARTS
#if SPLINEFEED_MAX_DEGREE > 5
#define SPLINEFEED_LINE_PARTS 288
#else // a microcontroller
#define SPLINEFEED_LINE_PARTS 8
#endif
#endif

namespace splinefeed {

/// The end of a move within a line.
struct LinePart {
    PerAxis<Position> place{};
    std::uint32_t index = 0;   ///< of the move, modulo 2^32
    std::uint32_t element = 0; ///< number of the line among all that is passed on, modulo 2^32
};

/// A ring of them in the order of the path. Whether more fit follows from what was programmed, not from when it was
/// asked for. A place is free as soon as so many elements came behind it that it must have been passed.
/// Memory: 32 bytes for each with three axes.
class LineParts {
public:
    static constexpr std::uint32_t capacity = SPLINEFEED_LINE_PARTS;
    static constexpr std::uint32_t elements_on_the_way = 9; ///< BlendedPath has room for 8

    [[nodiscard]] bool has_room(std::uint32_t count, std::uint32_t element) const noexcept {
        return known_ + count <= capacity ||
               (count <= capacity && element - at(known_ + count - 1).element >= elements_on_the_way);
    }
    /// @pre has_room(1, part.element)
    void add(const LinePart& part) noexcept { ring_[slot(known_++)] = part; }

    /// The first one that was not passed and belongs to moves before this one; nullptr: there is none.
    [[nodiscard]] const LinePart* next_before(std::uint32_t index) const noexcept {
        const LinePart& part = at(passed_);
        return passed_ < known_ && static_cast<std::int32_t>(part.index - index) < 0 ? &part : nullptr;
    }
    void pass() noexcept { ++passed_; }
    void pass_before(std::uint32_t index) noexcept {
        while (next_before(index) != nullptr) {
            pass();
        }
    }

private:
    [[nodiscard]] static std::size_t slot(std::uint64_t i) noexcept { return static_cast<std::size_t>(i % capacity); }
    [[nodiscard]] const LinePart& at(std::uint64_t i) const noexcept { return ring_[slot(i)]; }

    std::array<LinePart, capacity> ring_{};
    std::uint64_t known_ = 0;
    std::uint64_t passed_ = 0;
};

/// Passes those that end before `here`, in a blend, and the next one that ends on the line from there, if there is any.
/// @param there  the line's end, becomes that of the move
/// @param index  of the move at the line's end, likewise
/// @return whether there was one
template <Scalar S>
[[nodiscard]] bool pass_part(LineParts& parts, const PerAxis<Position>& here, int axes, PerAxis<Position>& there,
                             std::uint32_t& index) noexcept;

} // namespace splinefeed
