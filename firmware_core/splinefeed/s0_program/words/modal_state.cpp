// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/modal_state.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/words/lathe_sign.hpp"

namespace splinefeed {

namespace {

constexpr std::int64_t least_feed = 60 * Decimal::one / 1000; // 0.001 mm/s in mm/min
constexpr std::int64_t most_feed = 600'000 * Decimal::one;    // 10000 mm/s

// Q where a program states none.
constexpr Decimal usual_chain_tolerance(Decimal tolerance_mm, const ProgramSettings& settings) noexcept {
    return {tolerance_mm.raw / 4 * settings.chain_quarters};
}

} // namespace

ModalState ModalState::at_start(const ProgramSettings& settings) noexcept {
    ModalState state;
    const DialectRules& rules = rules_of(settings.dialect);
    state.retract_to_r = rules.retracts_to_r;
    state.motion = state.before_cycle = rules.first_motion;
    state.feed = rules.first_feed;
    state.tolerance_mm = settings.default_tolerance_mm;
    state.chain_tolerance_mm = usual_chain_tolerance(state.tolerance_mm, settings);
    return state;
}

void ModalState::set_motion(std::int16_t code, const DialectRules& rules) noexcept {
    motion = code == no_motion && rules.cycles_apart ? before_cycle : code;
    before_cycle = rules.cycles_apart && !is_cycle(motion) ? motion : before_cycle;
}

void ModalState::end_program(const ProgramSettings& settings) noexcept {
    plane = Plane::xy;
    incremental = false;
    const bool keeps_feed = !inverse_time && !per_turn; // as apply()
    feed = keeps_feed ? feed : rules_of(settings.dialect).first_feed;
    feed_in_inches = feed_in_inches && keeps_feed;
    inverse_time = per_turn = false;
    needs_straight = false;
    cutter = {};
    motion = before_cycle = rules_of(settings.dialect).last_motion;
    spindle = SpindleState::stopped;
}

bool states_speed(const Block& block, const DialectRules& rules) noexcept {
    const bool is_time = rules.dwell_speed && (block.code(CodeGroup::non_modal) == 40 || block.has(CodeGroup::stop));
    return block.has('s') && !block.has(CodeGroup::printer) && !is_time;
}

BlockStatus ModalState::apply(const Block& block, const ProgramSettings& settings) noexcept {
    // The order is that of execution: F is in the units of the blocks before, all lengths in those of this one.
    if (const std::int16_t mode = block.code(CodeGroup::feed_mode); mode != Block::no_code) {
        const bool same = inverse_time == (mode == 930) && per_turn == (mode == 950);
        feed = same ? feed : Decimal{};
        feed_in_inches = feed_in_inches && same;
        inverse_time = mode == 930;
        per_turn = mode == 950;
    }
    if (block.has(CodeGroup::units) && rules_of(settings.dialect).units_before_feed) {
        inches = block.code(CodeGroup::units) == 200;
    }
    if (const BlockStatus status = apply_feed(block); !status.ok()) {
        return status;
    }
    if (const BlockStatus status = apply_speed(block, settings); !status.ok()) {
        return status;
    }
    if (block.has('t') && (!to_integer(block.value('t'), selected_tool) || selected_tool < 0)) {
        return block.at(ProgramError::tool_unknown, 't');
    }
    lathe_tool = block.has('t') || block.has(CodeGroup::tool_change) ? has_tool_and_offset(block) : lathe_tool;
    if (const std::int16_t code = block.code(CodeGroup::spindle); code != Block::no_code) {
        spindle = code == 3   ? SpindleState::clockwise
                  : code == 4 ? SpindleState::counterclockwise
                              : SpindleState::stopped;
    }
    if (const std::int16_t code = block.code(CodeGroup::plane); code != Block::no_code) {
        plane = code == 170 ? Plane::xy : code == 180 ? Plane::zx : Plane::yz;
    }
    if (const std::int16_t code = block.code(CodeGroup::units); code != Block::no_code) {
        inches = code == 200;
    }
    if (const std::int16_t code = block.code(CodeGroup::distance); code != Block::no_code) {
        incremental = code == 910;
        extruder_incremental = incremental;
    }
    if (const std::int16_t code = block.code(CodeGroup::printer); code == 82 || code == 83) {
        extruder_incremental = code == 83;
    }
    if (const std::int16_t code = block.code(CodeGroup::centre_distance); code != Block::no_code) {
        centre_absolute = code == 901;
    }
    if (const std::int16_t code = block.code(CodeGroup::retract); code != Block::no_code) {
        retract_to_r = code == 990;
    }
    if (const std::int16_t code = block.code(CodeGroup::lathe_diameter); code != Block::no_code) {
        diameter = code == 70;
    }
    return apply_path_mode(block, settings);
}

bool ModalState::feed_of_turns(Decimal way, Decimal& out) const noexcept {
    const detail::Checked product = product_quotient(way.raw, speed.raw, static_cast<std::uint64_t>(Decimal::one));
    out.raw = product.raw;
    return product.fits && product.raw >= least_feed && product.raw <= most_feed;
}

BlockStatus ModalState::apply_feed(const Block& block) noexcept {
    if (!block.has('f') || block.has(CodeGroup::printer)) {
        return {};
    }
    const Decimal value = inverse_time ? block.value('f') : in_mm(block.value('f'));
    if (value.raw < 0) {
        return block.at(ProgramError::feed_negative, 'f');
    }
    if (!inverse_time && !per_turn && value.raw > 0 && value.raw < least_feed) {
        return block.at(ProgramError::feed_out_of_range, 'f');
    }
    feed = value;
    feed_in_inches = inches && !inverse_time;
    return {};
}

// The units are those of the blocks before, as those of F are.
BlockStatus ModalState::apply_speed(const Block& block, const ProgramSettings& settings) noexcept {
    const std::int16_t mode = block.code(CodeGroup::spindle_mode);
    const bool stated = states_speed(block, rules_of(settings.dialect));
    if (mode == 960 && (!stated || (block.has('d') && block.value('d').raw == 0))) {
        return block.at(ProgramError::surface_speed_missing, CodeGroup::spindle_mode);
    }
    if (mode != Block::no_code) {
        const Decimal most{static_cast<std::int64_t>(detail::magnitude(block.value('d').raw))};
        surface.most = mode == 970                                    ? Decimal{}
                       : block.has('d') && most < settings.most_speed ? most
                                                                      : settings.most_speed;
    }
    if (stated && block.value('s').raw < 0) {
        return block.at(ProgramError::speed_negative, 's');
    }
    if (stated) {
        speed = block.value('s');
        surface.set(speed, inches);
    }
    surface = surface.applies() ? surface : SurfaceSpeed{};
    return {};
}

BlockStatus ModalState::apply_path_mode(const Block& block, const ProgramSettings& settings) noexcept {
    const std::int16_t code = block.code(CodeGroup::path_mode);
    if (code == Block::no_code) {
        return {};
    }
    constexpr Decimal most = Decimal::from_integer(100);
    tolerance_mm = block.has('p') ? in_mm(block.value('p')) : settings.default_tolerance_mm;
    chain_tolerance_mm = block.has('q') ? in_mm(block.value('q')) : usual_chain_tolerance(tolerance_mm, settings);
    for (const char letter : {'p', 'q'}) {
        if (code == 640 && block.has(letter) && (block.value(letter).raw < 0 || in_mm(block.value(letter)) > most)) {
            return block.at(ProgramError::tolerance_out_of_range, letter);
        }
    }
    path_mode = code == 611                            ? PathMode::exact_stop
                : code == 610 || tolerance_mm.raw == 0 ? PathMode::exact_path
                                                       : PathMode::continuous;
    return {};
}

} // namespace splinefeed
