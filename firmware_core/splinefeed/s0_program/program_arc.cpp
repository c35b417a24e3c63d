// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/program_arc.hpp"

#include "splinefeed/s0_program/decimal_text.hpp"
#include "splinefeed/s0_program/elementary.hpp"

#include "splinefeed/number/wide_root.hpp"

namespace splinefeed {

namespace {

constexpr Decimal most_mismatch{Decimal::one / 2};          // mm
constexpr Decimal free_mismatch{Decimal::one / 200};        // 0.005 mm
constexpr std::int64_t relative_mismatch = 1000;            // 0.1 % of the radius
constexpr Decimal least_radius{2 * (Decimal::one / 10000)}; // 0.2 um, above what a move keeps
constexpr std::int64_t core_mismatch = 32;
constexpr std::int64_t least_sweep = 57296; // 1e-6 rad in 1e-9 degrees: less is a whole turn
constexpr std::int32_t most_turns = 10000;

Decimal size(Decimal value) noexcept {
    return value.raw < 0 ? -value : value;
}

// From the chord's middle to its left at right angles: `distance` along the normal of a chord of length `chord`.
PlanePoint beside(PlanePoint from, PlanePoint to, Decimal distance, Decimal chord) noexcept {
    const Decimal x = to.first - from.first;
    const Decimal y = to.second - from.second;
    const auto length = static_cast<std::uint64_t>(chord.raw);
    return {{from.first.raw + x.raw / 2 - product_quotient(y.raw, distance.raw, length).raw},
            {from.second.raw + y.raw / 2 + product_quotient(x.raw, distance.raw, length).raw}};
}

BlockStatus centre_by_radius(const Block& block, const ModalState& modal, PlanePoint from, PlanePoint to,
                             bool clockwise, PlanePoint& out) noexcept {
    const Decimal radius = modal.in_mm(block.value('r'));
    const Decimal chord = plane_distance(from, to);
    if (chord.raw == 0) {
        return block.at(ProgramError::arc_end_is_start, 'r');
    }
    const std::int64_t half = (chord.raw + 1) / 2;
    const auto arm = static_cast<std::int64_t>(detail::magnitude(radius.raw));
    if (half - arm > free_mismatch.raw || arm < least_radius.raw) {
        return block.at(ProgramError::arc_radius_too_small, 'r');
    }
    Decimal apart{}; // of the centre from the chord; a semicircle's is 0
    if (arm > half) {
        const Wide square = subtract(multiply(static_cast<std::uint64_t>(arm), static_cast<std::uint64_t>(arm)),
                                     multiply(static_cast<std::uint64_t>(half), static_cast<std::uint64_t>(half)));
        apart.raw = static_cast<std::int64_t>(square_root_rounded(square));
    }
    const bool to_left = clockwise == (radius.raw < 0); // of the chord
    out = beside(from, to, to_left ? apart : -apart, chord);
    return {};
}

BlockStatus centre_by_offsets(const Block& block, const ModalState& modal, PlanePoint from, PlanePoint to,
                              PlanePoint& out) noexcept {
    const PlaneLetters letters = letters_of(modal.plane);
    const char i = letters.offsets[0];
    const char j = letters.offsets[1];
    if (block.has(letters.offsets[2])) {
        return block.at(ProgramError::arc_offset_unused, letters.offsets[2]);
    }
    if (modal.centre_absolute && !(block.has(i) && block.has(j))) {
        return block.at(ProgramError::arc_centre_missing, block.has(i) ? i : j);
    }
    out = {modal.in_mm(block.value(i)), modal.in_mm(block.value(j))};
    if (!modal.centre_absolute) {
        out.first += from.first;
        out.second += from.second;
    }
    const Decimal start = plane_distance(out, from);
    const Decimal end = plane_distance(out, to);
    if (start < least_radius || end < least_radius) {
        return block.at(ProgramError::arc_radius_zero, block.has(i) ? i : j);
    }
    const Decimal mismatch = size(start - end);
    if (mismatch > most_mismatch ||
        (mismatch > free_mismatch && mismatch.raw > (start > end ? start : end).raw / relative_mismatch)) {
        return block.at(ProgramError::arc_radius_mismatch, block.has(i) ? i : j);
    }
    const Decimal chord = plane_distance(from, to);
    if (mismatch.raw > start.raw / core_mismatch && chord.raw > 0) {
        // The way of the centre along the chord's normal: (to - from) x (centre - from) / chord
        const Decimal x = to.first - from.first;
        const Decimal y = to.second - from.second;
        const auto length = static_cast<std::uint64_t>(chord.raw);
        const std::int64_t across = product_quotient(x.raw, (out.second - from.second).raw, length).raw -
                                    product_quotient(y.raw, (out.first - from.first).raw, length).raw;
        out = beside(from, to, {across}, chord);
    }
    return {};
}

} // namespace

PlaneLetters letters_of(Plane plane) noexcept {
    switch (plane) {
    case Plane::yz: return {{'y', 'z', 'x'}, {'j', 'k', 'i'}};
    case Plane::zx: return {{'z', 'x', 'y'}, {'k', 'i', 'j'}};
    case Plane::xy: break;
    }
    return {{'x', 'y', 'z'}, {'i', 'j', 'k'}};
}

BlockStatus find_arc(const Block& block, const ModalState& modal, PlanePoint from, PlanePoint to,
                     ArcGeometry& out) noexcept {
    const bool clockwise = modal.motion == 20;
    const bool by_offsets = block.has_any(Block::bits("ijk"));
    if (by_offsets == block.has('r')) {
        return by_offsets ? block.at(ProgramError::arc_centre_and_radius, 'r')
                          : block.at(ProgramError::arc_centre_missing, CodeGroup::motion);
    }
    std::int32_t turns = 1;
    if (block.has('p') && (!to_integer(block.value('p'), turns) || turns < 1 || turns > most_turns)) {
        return block.at(ProgramError::arc_turns_invalid, 'p');
    }
    const BlockStatus status = by_offsets ? centre_by_offsets(block, modal, from, to, out.centre)
                                          : centre_by_radius(block, modal, from, to, clockwise, out.centre);
    if (!status.ok()) {
        return status;
    }
    const Decimal begin = angle_of(from.first - out.centre.first, from.second - out.centre.second);
    const Decimal end = angle_of(to.first - out.centre.first, to.second - out.centre.second);
    std::int64_t sweep = (clockwise ? begin - end : end - begin).raw % Decimal::full_turn;
    sweep += sweep < 0 ? Decimal::full_turn : 0;
    sweep += sweep <= least_sweep ? Decimal::full_turn : 0;
    sweep += (turns - 1) * Decimal::full_turn;
    out.sweep_deg.raw = clockwise ? -sweep : sweep;
    return {};
}

} // namespace splinefeed
