// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/polar_words.hpp"

namespace splinefeed {

namespace {

constexpr char polar_radius = '@';
constexpr char polar_angle = '^';

Decimal stretched(Decimal value, Decimal to, Decimal from) noexcept {
    return {product_quotient(value.raw, to.raw, static_cast<std::uint64_t>(from.raw)).raw};
}

PlanePoint rotated(PlanePoint point, Decimal degrees) noexcept {
    const SineCosine by = sine_cosine(degrees);
    return {turned(point.first, by.cosine) - turned(point.second, by.sine),
            turned(point.first, by.sine) + turned(point.second, by.cosine)};
}

// Whether the words mean a place at all.
bool is_suited(const Block& block, const ModalState& modal, const AxisLetters& letters, std::int16_t motion) noexcept {
    const std::int16_t modeless = block.code(CodeGroup::non_modal);
    return modal.plane == Plane::xy && letters.index('x') >= 0 && letters.index('y') >= 0 &&
           !block.has_any(Block::bits("xy")) && (modeless == Block::no_code || modeless == 40) &&
           block.code(CodeGroup::tool_length) != 431 && motion != ModalState::no_motion;
}

} // namespace

PlanePoint polar_step(PlanePoint from, Decimal radius, Decimal degrees) noexcept {
    const Decimal before = hypotenuse(from.first, from.second);
    const Decimal size = before + radius;
    const PlanePoint to{stretched(from.first, size, before), stretched(from.second, size, before)};
    return degrees.raw == 0 ? to : rotated(to, degrees);
}

BlockStatus adapt_polar(Block& block, const ModalState& modal, const AxisLetters& letters, PlanePoint from) noexcept {
    const bool has_radius = block.has(polar_radius);
    const bool has_angle = block.has(polar_angle);
    if (!has_radius && !has_angle) {
        return {};
    }
    const std::int16_t distance = block.code(CodeGroup::distance);
    const std::int16_t units = block.code(CodeGroup::units);
    const bool incremental = distance == Block::no_code ? modal.incremental : distance == 910;
    const std::int16_t motion = block.has(CodeGroup::motion) ? block.code(CodeGroup::motion) : modal.motion;
    ModalState lengths = modal;
    lengths.inches = units == Block::no_code ? modal.inches : units == 200;
    const Decimal stated = lengths.in_mm(block.value(polar_radius));
    const Decimal before = hypotenuse(from.first, from.second);
    const bool needs_direction = incremental || !has_angle;
    const char word = has_radius ? polar_radius : polar_angle;
    if (!is_suited(block, modal, letters, motion) || (needs_direction && before.raw == 0)) {
        return block.at(ProgramError::polar_unsuited, word);
    }
    const Decimal more = incremental || !has_radius ? stated : stated - before;
    PlanePoint to = needs_direction ? polar_step(from, more, block.value(polar_angle))
                                    : rotated({has_radius ? stated : before, {}}, block.value(polar_angle));
    if (incremental) {
        to = {to.first - from.first, to.second - from.second};
    }
    const std::size_t column = block.at(ProgramError::none, word).column;
    block.set('x', lengths.in_units(to.first), column);
    block.set('y', lengths.in_units(to.second), column);
    const bool repeats = incremental && is_cycle(motion) && block.has('l');
    block.keep(repeats ? block.letters() : ~Block::bits("@^"));
    return {};
}

} // namespace splinefeed
