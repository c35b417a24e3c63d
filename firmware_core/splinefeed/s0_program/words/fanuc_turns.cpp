// SPDX-License-Identifier: MIT
// FanucWords: G68, G69, G50, G51, G50.1 and G51.1, and what goes on in turned coordinates.
#include "splinefeed/s0_program/words/fanuc_words.hpp"

namespace splinefeed {

namespace {

constexpr Decimal least_factor{Decimal::one / 100};
constexpr Decimal most_factor = Decimal::from_integer(10);
constexpr Decimal same_place{1000}; // 1e-6 mm: what turning there and back may change

constexpr std::uint32_t bit(unsigned axis) noexcept {
    return 1U << axis;
}

} // namespace

// They end before all else of their block.
BlockStatus FanucWords::read_ends(const FanucBlock& in) noexcept {
    CoordinateTurn& turn = next_.turn;
    if ((in.words & end_rotate_word) != 0) {
        turn.end_rotation();
    }
    if ((in.words & end_scale_word) != 0 && turn.scales()) {
        if (turn.rotates()) {
            return wrong(in, FanucFault::order, CodeGroup::without_effect);
        }
        turn.end_scale();
    }
    if ((in.words & end_mirror_word) != 0) {
        if (turn.mirrors() && !in.has_axes()) {
            return wrong(in, FanucFault::mirror_axes, CodeGroup::without_effect);
        }
        for (unsigned k = 0; k < in.count(); ++k) {
            if (in.has(k)) {
                turn.end_mirror(k);
            }
        }
        in.block.keep(~in.letters.bits());
    }
    if (turn.axes() != state_.turn.axes()) {
        turned(in, true);
    }
    return {};
}

// What goes on in coordinates that are turned already.
BlockStatus FanucWords::check_turned(const FanucBlock& in) noexcept {
    const CoordinateTurn& turn = next_.turn;
    if (!turn.applies()) {
        return {};
    }
    if (in.plane != in.modal.plane) {
        return wrong(in, FanucFault::with_turned, CodeGroup::plane);
    }
    if (in.block.has(CodeGroup::work_system)) {
        return wrong(in, FanucFault::with_turned, CodeGroup::work_system);
    }
    std::uint32_t stated = 0;
    std::uint32_t across = 0;
    for (unsigned k = 0; k < in.count(); ++k) {
        stated |= in.has(k) ? bit(k) : 0;
        across |= in.is_across(k) ? bit(k) : 0;
    }
    const bool is_apart = (stated & turn.axes()) == 0 && stated != 0;
    const bool refers = in.modeless == 280 || in.modeless == 300 || in.modeless == 530;
    if (in.modeless != Block::no_code && in.modeless != 40 && !(refers && is_apart)) {
        return wrong(in, FanucFault::with_turned, CodeGroup::non_modal);
    }
    if (is_cycle(in.motion) && (turn.scales() || (turn.axes() & across) != 0)) {
        return wrong(in, FanucFault::scaled_cycle, CodeGroup::motion);
    }
    if (turn.mirrors() && in.block.code(CodeGroup::cutter_radius) > 400) {
        return wrong(in, FanucFault::mirrored_side, CodeGroup::cutter_radius);
    }
    return {};
}

BlockStatus FanucWords::read_rotation(const FanucBlock& in) noexcept {
    if ((in.words & rotate_word) == 0) {
        return {};
    }
    const std::array<char, 3> letters = letters_of_plane(in.plane);
    const int first = in.letters.index(letters[0]);
    const int second = in.letters.index(letters[1]);
    CoordinateTurn& turn = next_.turn;
    if (first < 0 || second < 0) {
        return in.block.at(ProgramError::axis_missing, CodeGroup::without_effect);
    }
    if (turn.mirrors()) {
        return wrong(in, FanucFault::order, CodeGroup::without_effect);
    }
    if (!in.block.has('r')) {
        return wrong(in, FanucFault::rotation_angle, CodeGroup::without_effect);
    }
    const bool has_centre = in.block.has(letters[0]);
    const std::uint32_t of_plane = Block::letter_bit(letters[0]) | Block::letter_bit(letters[1]);
    if (has_centre != in.block.has(letters[1]) || in.block.has_any(in.letters.bits() & ~of_plane) ||
        (!has_centre && in.block.has(CodeGroup::work_system))) {
        return wrong(in, FanucFault::rotation_centre, CodeGroup::without_effect);
    }
    if (in.steps && turn.rotates()) {
        return wrong(in, FanucFault::rotation_step, 'r');
    }
    PerAxis<Decimal> centre = in.place.program;
    for (const int axis : {first, second}) {
        const auto k = static_cast<unsigned>(axis);
        centre[k] = has_centre ? in.value(k) : centre[k];
        if (!is_position(centre[k])) {
            return in.block.at(ProgramError::position_out_of_range, in.letter(k));
        }
    }
    const CoordinateTurn before = turn;
    turn.rotate(static_cast<unsigned>(first), static_cast<unsigned>(second), centre, in.block.value('r'));
    if (before.rotates() && (!has_centre || !turn.is_about(before))) {
        return wrong(in, FanucFault::rotation_again, CodeGroup::without_effect);
    }
    turned(in, false);
    return finish(in, CodeGroup::without_effect, of_plane | Block::bits("r"));
}

BlockStatus FanucWords::read_scale(const FanucBlock& in) noexcept {
    if ((in.words & scale_word) == 0) {
        return {};
    }
    const Decimal factor = in.parameter();
    if (next_.turn.applies()) {
        return wrong(in, FanucFault::order, CodeGroup::without_effect);
    }
    if (in.block.has_any(Block::bits("ijk"))) {
        return wrong(in, FanucFault::scale_parts, CodeGroup::without_effect);
    }
    if (!in.block.has('p') || in.block.is_whole('p') || factor < least_factor || factor > most_factor) {
        return wrong(in, FanucFault::scale_factor, CodeGroup::without_effect);
    }
    if (is_cycle(in.motion)) {
        return wrong(in, FanucFault::scaled_cycle, CodeGroup::without_effect);
    }
    if (in.block.has(CodeGroup::work_system) ||
        in.block.has(CodeGroup::tool_length)) { // the tool's place is the centre
        return wrong(in, FanucFault::with_turned, CodeGroup::without_effect);
    }
    PerAxis<Decimal> centre = in.place.program;
    std::uint32_t axes = 0;
    for (unsigned k = 0; k < in.count(); ++k) {
        if (in.has(k) && !in.is_space(k)) {
            return in.block.at(ProgramError::word_unused, in.letter(k));
        }
        axes |= in.is_space(k) ? bit(k) : 0;
        centre[k] = in.has(k) ? in.value(k) : centre[k];
        if (!is_position(centre[k])) {
            return in.block.at(ProgramError::position_out_of_range, in.letter(k));
        }
    }
    next_.turn.scale(axes, centre, factor);
    turned(in, false);
    return finish(in, CodeGroup::without_effect, in.letters.bits() | Block::bits("p"));
}

BlockStatus FanucWords::begin_mirror(const FanucBlock& in) noexcept {
    if ((in.words & mirror_word) == 0) {
        return {};
    }
    if (next_.turn.rotates() || next_.turn.scales()) {
        return wrong(in, FanucFault::order, CodeGroup::without_effect);
    }
    if (in.steps) {
        return wrong(in, FanucFault::local_step, CodeGroup::without_effect);
    }
    if (!in.has_axes()) {
        return wrong(in, FanucFault::mirror_axes, CodeGroup::without_effect);
    }
    for (unsigned k = 0; k < in.count(); ++k) {
        if (!in.has(k)) {
            continue;
        }
        if (!in.is_space(k) || !is_position(in.value(k))) {
            return wrong(in, FanucFault::mirror_axes, in.letter(k));
        }
        next_.turn.mirror(k, in.value(k), in.in_plane(k));
    }
    turned(in, false);
    return finish(in, CodeGroup::without_effect, in.letters.bits());
}

// The turn is another one: where the machine stands has other coordinates, on some axes.
void FanucWords::turned(const FanucBlock& in, bool ends) noexcept {
    moves_ = true;
    PerAxis<Decimal> point = in.place.program;
    state_.turn.apply(point);
    next_.turn.undo(point);
    const std::uint32_t axes = state_.turn.axes() | next_.turn.axes();
    for (unsigned k = 0; k < in.count(); ++k) {
        const Decimal way = point[k] - in.place.program[k];
        const bool differs = way > same_place || way < -same_place || in.block.has(CodeGroup::work_system);
        next_.unstated |= differs ? axes & bit(k) : 0;
        next_.lost |= differs && ends ? axes & bit(k) : 0;
    }
}

// Whether it is known where the block leads to.
BlockStatus FanucWords::check_motion(const FanucBlock& in) noexcept {
    const bool moves = in.block.code(CodeGroup::non_modal) == Block::no_code &&
                       in.block.code(CodeGroup::tool_length) != 431; // and it is no shift
    const bool refers = in.modeless == 280 || in.modeless == 300;
    if (next_.unstated == 0 || !(moves || refers)) {
        return {};
    }
    std::uint32_t stated = 0;
    for (unsigned k = 0; k < in.count(); ++k) {
        const bool is_step = in.steps || in.block.is_step(in.letter(k));
        if (in.has(k) && is_step && (next_.lost & bit(k)) != 0 && in.value(k).raw != 0) {
            return wrong(in, FanucFault::step_behind_end, in.letter(k));
        }
        if (in.has(k) && !is_step && next_.turn.couples(k)) {
            const unsigned other = next_.turn.other(k);
            if ((next_.unstated & bit(other)) != 0 && !in.has(other)) {
                return wrong(in, FanucFault::place_unstated, in.letter(k));
            }
        }
        stated |= in.has(k) && !is_step ? bit(k) : 0;
    }
    next_.unstated &= ~stated;
    next_.lost &= ~stated;
    return {};
}

} // namespace splinefeed
