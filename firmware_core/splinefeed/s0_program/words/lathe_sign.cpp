// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/lathe_sign.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr std::uint32_t turned_axes = Block::bits("xzuw");
constexpr std::uint32_t milled_axes = Block::bits("yvabc");
constexpr Decimal least_mill_feed = Decimal::from_integer(2); // of a mill [mm/min]; a lathe's F is 0.05 to 2 mm a turn

// F of G99 is the way of a turn, unless cycles are retracted by it.
bool is_turning_feed(const Block& block, const ModalState& modal) noexcept {
    const std::int16_t motion = block.has(CodeGroup::motion) ? block.code(CodeGroup::motion) : modal.motion;
    const bool per_minute = block.has(CodeGroup::feed_mode) ? block.code(CodeGroup::feed_mode) == 940
                                                            : !modal.per_turn && !modal.inverse_time;
    const bool retracts = block.has(CodeGroup::retract) ? block.code(CodeGroup::retract) == 990 : modal.retract_to_r;
    const bool small = block.has('f') && block.value('f').raw > 0 && modal.in_mm(block.value('f')) < least_mill_feed;
    return retracts && per_minute && small && !is_cycle(motion) && motion != 330;
}

} // namespace

bool has_tool_and_offset(const Block& block) noexcept {
    constexpr std::int32_t offsets = 100; // and one more than the last
    std::int32_t number = 0;
    return block.has('t') && !block.has(CodeGroup::tool_change) && to_integer(block.value('t'), number) &&
           number >= offsets &&
           (block.has_padded_tool() || (number > 10 * offsets && number / offsets == number % offsets));
}

BlockStatus check_lathe(const Block& block, const ModalState& modal, const DialectRules& rules) noexcept {
    if (!rules.mills_only && !modal.lathe_tool) { // most programs
        return {};
    }
    const bool has_turned = block.has_any(turned_axes);
    const bool has_motion = block.has(CodeGroup::motion);
    CodeGroup sign = CodeGroup::none;
    if (has_turned && block.has('f') && !block.has_any(milled_axes)) {
        if (block.code(CodeGroup::non_modal) == 920) {
            sign = CodeGroup::non_modal;
        } else if (!has_motion && !block.has(CodeGroup::non_modal) && modal.motion == 0) { // a mill would go by a rapid
            sign = block.code(CodeGroup::distance) == 900    ? CodeGroup::distance
                   : block.code(CodeGroup::feed_mode) == 940 ? CodeGroup::feed_mode
                                                             : sign;
        }
    }
    if (rules.mills_only && block.code(CodeGroup::without_effect) == 500 && !has_motion &&
        !block.has(CodeGroup::spindle) && (block.has('s') || has_turned)) {
        sign = CodeGroup::without_effect;
    }
    if (sign != CodeGroup::none) {
        return block.at(ProgramError::lathe_word, sign);
    }
    if (!rules.mills_only) {
        return {};
    }
    return has_tool_and_offset(block)      ? block.at(ProgramError::lathe_word, 't')
           : is_turning_feed(block, modal) ? block.at(ProgramError::lathe_word, 'f')
                                           : BlockStatus{};
}

} // namespace splinefeed
