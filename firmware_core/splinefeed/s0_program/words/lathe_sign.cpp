// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/lathe_sign.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr std::uint32_t turned_axes = Block::bits("xzuw");
constexpr std::uint32_t milled_axes = Block::bits("yvabc");
constexpr Decimal least_mill_feed = Decimal::from_integer(2); // of a mill [mm/min]; a lathe's F is 0.05 to 2 mm a turn

// "G90 X38. Z-20. F0.2" behind a rapid: a mill would go there by one.
bool is_turning_cycle(const Block& block, const ModalState& modal) noexcept {
    const std::int16_t distance = block.code(CodeGroup::distance);
    const std::int16_t feed = block.code(CodeGroup::feed_mode);
    return (distance == 900 || feed == 940) && block.has('f') && block.has_any(turned_axes) &&
           !block.has_any(milled_axes) && !block.has(CodeGroup::motion) && !block.has(CodeGroup::non_modal) &&
           modal.motion == 0;
}

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
    constexpr std::int32_t digits = 100; // of the tool, and of the offset
    std::int32_t number = 0;
    if (!block.has_long_tool() || !to_integer(block.value('t'), number) || block.has(CodeGroup::tool_change)) {
        return false;
    }
    const std::int32_t tool = number / digits;
    return tool > 0 && (tool < 10 || number % digits == tool);
}

BlockStatus check_lathe(const Block& block, const ModalState& modal, const DialectRules& rules) noexcept {
    const bool shifts = block.code(CodeGroup::non_modal) == 920 && !block.has_any(milled_axes);
    const bool cuts = shifts && block.has('f');
    const CodeGroup cycle = block.has(CodeGroup::distance) ? CodeGroup::distance : CodeGroup::feed_mode;
    if (!rules.mills_only && !modal.lathe_tool) {
        return {};
    }
    if (cuts && block.has_any(turned_axes)) {
        return block.at(ProgramError::lathe_word, CodeGroup::non_modal);
    }
    if (is_turning_cycle(block, modal)) {
        return block.at(ProgramError::lathe_word, cycle);
    }
    if (!rules.mills_only) {
        return {};
    }
    const bool limits = block.code(CodeGroup::without_effect) == 500 && !block.has(CodeGroup::motion) &&
                        !block.has(CodeGroup::spindle) && (block.has('s') || block.has_any(turned_axes));
    if (limits) {
        return block.at(ProgramError::lathe_word, CodeGroup::without_effect);
    }
    if (shifts && block.has('s') && !block.has_any(turned_axes)) {
        return block.at(ProgramError::lathe_word, CodeGroup::non_modal);
    }
    if (has_tool_and_offset(block)) {
        return block.at(ProgramError::lathe_word, 't');
    }
    const std::int16_t motion = block.code(CodeGroup::motion);
    if ((motion == 730 || motion == 740) &&
        (block.has_any(Block::bits("uw")) || !block.has_any(turned_axes | milled_axes))) {
        return block.at(ProgramError::lathe_word, CodeGroup::motion);
    }
    return is_turning_feed(block, modal) ? block.at(ProgramError::lathe_word, 'f') : BlockStatus{};
}

} // namespace splinefeed
