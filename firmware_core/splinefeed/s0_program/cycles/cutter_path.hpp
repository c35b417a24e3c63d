// SPDX-License-Identifier: MIT
// CutterPath: what cutter compensation holds back until the next move shows where the last one ends.
#pragma once

#include "splinefeed/s0_program/cycles/contour_element.hpp"
#include "splinefeed/s0_program/words/block_motion.hpp"

namespace splinefeed {

/// The last element of a contour, and what the program does behind it. A block is planned, and kept if all of it is
/// right.
class CutterPath {
public:
    static constexpr std::uint8_t most_items = 8;

    /// A move, a dwell or an event that waits. The first one is the move along the element.
    struct Item {
        ItemKind kind = ItemKind::move;
        MoveKind move = MoveKind::feed;
        bool stops_before = false;
        std::uint32_t line = 0;
        MoveManner manner{};
        AxisPoint to{}; ///< the axes of the plane do not count: they are the tool's
        Decimal dwell_s{};
        ProgramEvent event{};
    };

    /// Whether the contour has been entered and not left.
    [[nodiscard]] bool has_entered() const noexcept { return entered_; }
    /// Whether something waits; whether all of that may be given.
    [[nodiscard]] bool holds() const noexcept { return given_ < count_; }
    [[nodiscard]] bool gives() const noexcept { return releasing_ && holds(); }
    [[nodiscard]] bool has_room(int items) const noexcept { return count_ + items <= most_items; }

    /// The contour goes on with `next`, or begins with it: then its `from` is where the tool is.
    /// Errors: cutter_gouge, cutter_arc_too_small, cutter_entry_too_short.
    ProgramStatus plan_element(const ContourElement& next, CutterOffset offset) noexcept;
    /// Whether the element that was planned, or else the last one, may be the end. Error: cutter_gouge.
    [[nodiscard]] ProgramStatus check_end() const noexcept;
    /// The contour ends with the last element. Error: as above.
    ProgramStatus plan_end() noexcept;
    void drop_plan() noexcept { plan_ = {}; }
    /// What was planned holds from now on.
    void keep_plan() noexcept;
    /// Without giving what waits.
    void clear() noexcept { *this = {}; }

    /// Of the element that was planned: around its first corner, and about which point.
    [[nodiscard]] bool goes_around() const noexcept { return corner_.around; }
    [[nodiscard]] PlanePoint corner_end() const noexcept { return corner_.tool_at; }
    [[nodiscard]] PlanePoint corner() const noexcept { return last_.programmed_from; }

    /// @pre has_room(1)
    void hold(const Item& item) noexcept { items_[count_++] = item; }
    /// The contour ends, and what waits may be given.
    void leave() noexcept;
    /// The next item, and the element that it belongs to; whether it is the move along that. @pre gives()
    [[nodiscard]] const Item& give() noexcept;
    [[nodiscard]] const ContourElement& given_element() const noexcept { return leaving_; }
    [[nodiscard]] const CutterOffset& offset() const noexcept { return offset_; }
    [[nodiscard]] bool gives_element() const noexcept { return given_ == 0; }

private:
    struct Plan {
        bool has_element = false;
        bool ends = false;
        ContourElement next{};
        CornerPlace corner{};
        CutterOffset offset{};
    };

    void release() noexcept;

    Plan plan_{};
    ContourElement last_{};
    ContourElement leaving_{};
    CornerPlace corner_{};
    CutterOffset offset_{};
    bool entered_ = false;
    bool releasing_ = false;
    std::uint8_t count_ = 0;
    std::uint8_t given_ = 0;
    std::array<Item, most_items> items_{};
};

} // namespace splinefeed
