// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/cycles/program_arc.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/text/elementary.hpp"

#include "splinefeed/number/wide_root.hpp"

namespace splinefeed {

namespace {

constexpr Decimal free_mismatch{Decimal::one / 200};        // 0.005 mm
constexpr std::int64_t relative_mismatch = 1000;            // 0.1 % of the radius
constexpr Decimal least_radius{2 * (Decimal::one / 10000)}; // 0.2 um, above what a move keeps
constexpr Decimal flat_radius = Decimal::from_integer(32768);
constexpr Decimal flat_chord = Decimal::from_integer(256); // (c/2)^4 / (8 r^3) < 1e-6 mm
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

bool is_mismatch(const ArcTolerance& tolerance, Decimal start, Decimal end) noexcept {
    const Decimal mismatch = size(start - end);
    return mismatch > tolerance.most || (tolerance.relative && mismatch > tolerance.least &&
                                         mismatch.raw > (start > end ? start : end).raw / relative_mismatch);
}

BlockStatus centre_by_radius(const Block& block, const ModalState& modal, const DialectRules& rules, PlanePoint from,
                             PlanePoint to, bool clockwise, PlanePoint& out) noexcept {
    const Decimal radius = modal.in_mm(block.value('r'));
    const Decimal chord = plane_distance(from, to);
    if (chord.raw == 0) {
        return block.at(ProgramError::arc_end_is_start, 'r');
    }
    const std::int64_t half = (chord.raw + 1) / 2;
    const auto arm = static_cast<std::int64_t>(detail::magnitude(radius.raw));
    if ((half - arm > free_mismatch.raw && !rules.small_radius) || arm < least_radius.raw) {
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

BlockStatus centre_by_offsets(const Block& block, const ModalState& modal, const DialectRules& rules, PlanePoint from,
                              PlanePoint to, PlanePoint& out) noexcept {
    const PlaneLetters letters = letters_of(modal.plane);
    const char i = letters.offsets[0];
    const char j = letters.offsets[1];
    if (block.has(letters.offsets[2]) && !rules.free_third_offset) {
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
    if (is_mismatch(modal.inches ? rules.arc_in_inches : rules.arc, start, end)) {
        return block.at(ProgramError::arc_radius_mismatch, block.has(i) ? i : j);
    }
    const Decimal chord = plane_distance(from, to);
    if (size(start - end).raw > start.raw / core_mismatch && chord.raw > 0) {
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

// The control point is where the tangents of both ends meet.
void flatten(PlanePoint from, PlanePoint to, ArcGeometry& out) noexcept {
    const Decimal chord = plane_distance(from, to);
    const Decimal radius = plane_distance(out.centre, from);
    const bool is_minor = out.sweep_deg.raw < Decimal::full_turn / 2 && out.sweep_deg.raw > -Decimal::full_turn / 2;
    out.radius = radius;
    out.is_flat = is_minor && radius > flat_radius && chord < flat_chord;
    if (out.is_flat) {
        const std::int64_t half = chord.raw / 2;
        const auto size_of = static_cast<std::uint64_t>(radius.raw);
        const std::int64_t apart = radius.raw - product_quotient(half, half, 2 * size_of).raw; // of centre and chord
        const Decimal height{product_quotient(half, half, static_cast<std::uint64_t>(apart)).raw};
        out.control = beside(from, to, out.sweep_deg.raw < 0 ? height : -height, chord);
    }
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

BlockStatus find_arc(const Block& block, const ModalState& modal, const DialectRules& rules, PlanePoint from,
                     PlanePoint to, ArcGeometry& out) noexcept {
    const bool clockwise = modal.motion == 20;
    const bool by_offsets = block.has_any(Block::bits("ijk"));
    if (by_offsets == block.has('r')) {
        return by_offsets ? block.at(ProgramError::arc_centre_and_radius, 'r')
                          : block.at(ProgramError::arc_centre_missing, CodeGroup::motion);
    }
    const std::int32_t part = rules.turns_before_arc ? 1 : 0; // of a turn, beside those that P counts
    std::int32_t turns = 1 - part;
    if (block.has('p') && (!to_integer(block.value('p'), turns) || turns < 1 - part || turns > most_turns - part)) {
        return block.at(ProgramError::arc_turns_invalid, 'p');
    }
    turns += part;
    const BlockStatus status = by_offsets ? centre_by_offsets(block, modal, rules, from, to, out.centre)
                                          : centre_by_radius(block, modal, rules, from, to, clockwise, out.centre);
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
    flatten(from, to, out);
    return {};
}

} // namespace splinefeed
