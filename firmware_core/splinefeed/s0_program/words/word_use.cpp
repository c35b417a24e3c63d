// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/word_use.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

namespace {

constexpr std::uint32_t axis_bits = Block::bits("xyzabcuvw");
constexpr std::uint32_t no_cycle_bits = Block::bits("abcuvwe");

bool is_arc(std::int16_t motion) noexcept {
    return motion == 20 || motion == 30;
}

// The letters that the codes of the block take beside axes, F, S, T and N.
std::uint32_t letters_used(const Block& block, const DialectRules& rules, std::int16_t motion) noexcept {
    std::uint32_t used = Block::bits("fnst");
    const std::int16_t modeless = block.code(CodeGroup::non_modal);
    const std::int16_t input_output = block.code(CodeGroup::input_output);
    if (is_arc(motion)) {
        used |= Block::bits("ijkpr");
    } else if (motion == 50) {
        used |= Block::bits("ijpq");
    } else if (motion == 51) {
        used |= Block::bits("ij");
    } else if (motion == 52) {
        used |= Block::bits("lp");
    } else if (motion == 330 || motion == 331) {
        used |= motion == 330 ? Block::bits("k") : Block::bits("ik");
    } else if (motion == 760) {
        used |= Block::bits("ehijklpqr");
    } else if (is_cycle(motion)) {
        used |= Block::bits("lr@^");
        used |= motion == 730 || motion == 830 ? Block::bits("q") : 0;
        const bool dwells = motion == 820 || motion == 860 || motion == 890 || taps(motion);
        used |= dwells || rules.idle_cycles ? Block::bits("p") : 0;
    }
    used |= modeless == 40 ? Block::bits("p") : modeless == 100 ? Block::bits("lpr") : 0;
    used |= block.has(CodeGroup::without_effect) ? Block::bits("pqr") : 0;
    used |= rules.keeps_cutter_number ? Block::bits("d") : 0;
    used |= block.code(CodeGroup::path_mode) == 640 ? Block::bits("pq") : 0;
    used |= block.code(CodeGroup::tool_length) == 430 ? Block::bits("h") : 0;
    used |= block.code(CodeGroup::cutter_radius) > 400 ? Block::bits("dl") : 0;
    used |= rules.one_command && block.has(CodeGroup::spindle) ? Block::bits("iop") : 0;
    used |= block.code(CodeGroup::spindle) == 19 ? Block::bits("pqr") : 0;
    used |= block.code(CodeGroup::spindle_mode) == 960 ? Block::bits("d") : 0;
    used |= block.code(CodeGroup::override_mode) >= 50 ? Block::bits("p") : 0;
    used |= block.code(CodeGroup::tool_change) == 61 ? Block::bits("q") : 0;
    if (input_output != Block::no_code) {
        used |= input_output == 66 ? Block::bits("elpq") : input_output > 66 ? Block::bits("eq") : Block::bits("p");
    }
    return used;
}

BlockStatus check_axes(const Block& block, const AxisLetters& letters, const DialectRules& rules) noexcept {
    const std::uint32_t axes = axis_bits | (rules.extruder ? Block::letter_bit('e') : 0);
    const std::uint32_t missing = block.letters() & axes & ~letters.bits();
    for (char letter = 'a'; letter <= 'z' && missing != 0; ++letter) {
        if ((missing & Block::letter_bit(letter)) != 0) {
            return block.at(ProgramError::axis_missing, letter);
        }
    }
    return {};
}

BlockStatus require_count(const Block& block, char letter, std::int32_t most, ProgramError missing) noexcept {
    std::int32_t number = 0;
    if (!block.has(letter)) {
        return {missing, 0, 0};
    }
    if (!to_integer(block.value(letter), number)) {
        return block.at(ProgramError::integer_needed, letter);
    }
    return number < 0 || number > most ? block.at(ProgramError::count_out_of_range, letter) : BlockStatus{};
}

BlockStatus check_input(const Block& block) noexcept {
    const bool analog = block.has('e');
    std::int32_t wait = 0;
    if (analog == block.has('p') || (block.has('l') && !to_integer(block.value('l'), wait)) || wait < 0 || wait > 4 ||
        (analog && wait != 0) || block.value('q').raw < 0 || (wait > 0 && block.value('q').raw == 0)) {
        return block.at(ProgramError::input_word_invalid, CodeGroup::input_output);
    }
    return require_count(block, analog ? 'e' : 'p', 63, ProgramError::input_word_invalid);
}

BlockStatus check_orientation(const Block& block) noexcept {
    constexpr Decimal full_turn{Decimal::full_turn};
    std::int32_t way = 0;
    if (block.value('r').raw < 0 || block.value('r') > full_turn ||
        (block.has('p') && !to_integer(block.value('p'), way)) || way < 0 || way > 2 ||
        (block.has('q') && block.value('q').raw <= 0)) {
        return block.at(ProgramError::orient_word_invalid, CodeGroup::spindle);
    }
    return {};
}

// Words that a code cannot do without.
BlockStatus check_needs(const Block& block, const DialectRules& rules) noexcept {
    constexpr std::int32_t most_outputs = 63;
    constexpr std::int32_t most_tools = 99999;
    if (block.code(CodeGroup::non_modal) == 40 &&
        ((!block.has('p') && !rules.one_command) || block.value('p').raw < 0)) {
        return block.at(ProgramError::dwell_invalid, CodeGroup::non_modal);
    }
    if (block.code(CodeGroup::non_modal) == 100) {
        std::int32_t what = 0;
        std::int32_t system = 0;
        if (!to_integer(block.value('l'), what) || (what != 2 && what != 20) || !block.has('p') ||
            !to_integer(block.value('p'), system) || system < (rules.macros ? 1 : 0) || system > 9 ||
            (what == 20 && (block.has('r') || rules.macros))) { // Fanuc's are of an extension
            return block.at(ProgramError::g10_invalid, CodeGroup::non_modal);
        }
    }
    if (const std::int16_t code = block.code(CodeGroup::input_output); code != Block::no_code) {
        const BlockStatus status =
            code == 66       ? check_input(block)
            : code <= 65     ? require_count(block, 'p', most_outputs, ProgramError::count_out_of_range)
            : block.has('q') ? require_count(block, 'e', most_outputs, ProgramError::analog_output_invalid)
                             : BlockStatus{ProgramError::analog_output_invalid, 0, 0};
        if (!status.ok()) {
            return status.column > 0 ? status : block.at(status.error, CodeGroup::input_output);
        }
    }
    if (block.code(CodeGroup::spindle) == 19) {
        return check_orientation(block);
    }
    if (block.code(CodeGroup::tool_change) == 61) {
        return require_count(block, 'q', most_tools, ProgramError::tool_unknown);
    }
    return {};
}

// Beside G80. Where cycles are of a group of their own, the motion from before them goes on.
BlockStatus find_use_behind(const Block& block, const ModalState& modal, const DialectRules& rules, bool axes,
                            BlockUse& out) noexcept {
    if (axes && (!rules.cycles_apart || modal.before_cycle == ModalState::no_motion)) {
        return block.at(ProgramError::axis_word_unused, CodeGroup::motion);
    }
    if (axes) {
        out.motion = modal.before_cycle;
        out.axes = AxisUse::motion;
    }
    return {};
}

// A printer's curve to where it stands: G5 alone.
bool is_bare_curve(const Block& block, const DialectRules& rules, bool axes) noexcept {
    const std::int16_t motion = block.code(CodeGroup::motion);
    return rules.one_command && (motion == 50 || motion == 51) && !axes && !block.has_any(Block::bits("ijpq"));
}

BlockStatus find_axis_use(const Block& block, const ModalState& modal, const DialectRules& rules, bool axes,
                          BlockUse& out) noexcept {
    const std::int16_t motion = block.code(CodeGroup::motion);
    const std::int16_t modeless = block.code(CodeGroup::non_modal);
    const bool tool_offset = block.code(CodeGroup::tool_length) == 431;
    const bool offsets =
        tool_offset || modeless == 100 || modeless == 280 || modeless == 300 || modeless == 520 || modeless == 920;
    if (offsets) {
        const bool mode_only =
            motion == ModalState::no_motion || (rules.motion_beside_offsets && motion <= 30 && !tool_offset);
        if (motion != Block::no_code && !mode_only) {
            return block.at(ProgramError::axis_words_twice, CodeGroup::motion);
        }
        if (tool_offset && modeless != Block::no_code && axes) {
            return block.at(ProgramError::axis_words_twice, CodeGroup::non_modal);
        }
        const bool needs_axes = modeless == 520 || (modeless == 920 && !rules.bare_g92) || tool_offset;
        if (!axes && needs_axes) {
            return block.at(ProgramError::g92_axes_missing,
                            tool_offset ? CodeGroup::tool_length : CodeGroup::non_modal);
        }
        out.axes = AxisUse::offsets;
        return {};
    }
    if (motion == ModalState::no_motion) {
        return find_use_behind(block, modal, rules, axes, out);
    }
    if (is_bare_curve(block, rules, axes)) {
        return {};
    }
    if (motion != Block::no_code) {
        const bool free = motion <= 30 || motion == 52;
        if (!axes && !free) {
            return block.at(ProgramError::axis_words_missing, CodeGroup::motion);
        }
        out.motion = motion;
    } else if (axes) {
        out.motion = modal.motion;
        if (modal.motion == ModalState::no_motion && modeless == 530) {
            return block.at(ProgramError::g53_unsuited, CodeGroup::non_modal);
        }
        if (modal.motion == ModalState::no_motion) {
            return {ProgramError::axis_word_unused, 0, 0};
        }
    } else if ((is_arc(modal.motion) && block.has_any(Block::bits("ijk"))) || (modal.motion == 52 && block.has('p'))) {
        out.motion = modal.motion; // a whole turn by I and J alone; a weight of a NURBS
    }
    out.axes = out.motion == ModalState::no_motion ? AxisUse::none : AxisUse::motion;
    return {};
}

// G10 of LinuxCNC's that needs a table which can be written: its other letters say nothing then.
bool writes_tool_table(const Block& block) noexcept {
    std::int32_t what = 0;
    return block.code(CodeGroup::non_modal) == 100 && to_integer(block.value('l'), what) &&
           (what == 1 || what == 10 || what == 11);
}

} // namespace

BlockStatus find_use(const Block& block, const ModalState& modal, const AxisLetters& letters, const DialectRules& rules,
                     BlockUse& out) noexcept {
    if (block.has(CodeGroup::printer)) { // its words are its own
        for (const unsigned group : indices(CodeGroup::printer)) {
            if (block.has(static_cast<CodeGroup>(group))) {
                return block.at(ProgramError::modal_group_conflict, static_cast<CodeGroup>(group));
            }
        }
        return {};
    }
    if (block.code(CodeGroup::stop) >= 97 || block.code(CodeGroup::spindle) >= 70) { // and G65
        return block.at(ProgramError::o_word, block.code(CodeGroup::stop) >= 97 ? CodeGroup::stop : CodeGroup::spindle);
    }
    if (writes_tool_table(block)) {
        return block.at(ProgramError::g10_tool_table, 'l');
    }
    if (modal.motion == ModalState::lost_motion && !block.has(CodeGroup::motion) && !block.has(CodeGroup::non_modal)) {
        return {}; // whose words they are is not known
    }
    if (const BlockStatus status = check_axes(block, letters, rules); !status.ok()) {
        return status;
    }
    const std::uint32_t axes = axis_bits | (rules.extruder ? Block::letter_bit('e') : 0);
    if (const BlockStatus status = find_axis_use(block, modal, rules, block.has_any(axes), out); !status.ok()) {
        return status;
    }
    if (block.code(CodeGroup::non_modal) == 530) {
        const bool incremental =
            block.has(CodeGroup::distance) ? block.code(CodeGroup::distance) == 910 : modal.incremental;
        if ((out.motion != 0 && out.motion != 10) || (incremental && !rules.g53_incremental)) {
            return block.at(ProgramError::g53_unsuited, CodeGroup::non_modal);
        }
    }
    if (is_cycle(out.motion) && block.has_any(no_cycle_bits)) {
        return block.at(ProgramError::cycle_axis_word, CodeGroup::motion);
    }
    const std::uint32_t unused = block.letters() & ~(axes | letters_used(block, rules, out.motion));
    for (char letter = 'a'; letter <= 'z' && unused != 0 && !block.has_left_out(); ++letter) {
        if ((unused & Block::letter_bit(letter)) != 0) {
            return block.at(ProgramError::word_unused, letter);
        }
    }
    return check_needs(block, rules);
}

} // namespace splinefeed
