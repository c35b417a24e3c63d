// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/adapt_words.hpp"

namespace splinefeed {

namespace {

constexpr std::string_view length_letters = "xyzuvwijkqr";
constexpr std::string_view angle_letters = "abc";

// Fanuc's IS-B: 0.001 mm or degrees, 0.0001 inches.
void count_increments(Block& block, const ModalState& modal, bool cycle) noexcept {
    const std::int16_t units = block.code(CodeGroup::units);
    const bool inches = units == Block::no_code ? modal.inches : units == 200;
    const auto count = [&](char letter, std::int64_t parts) {
        if (block.has(letter) && block.is_whole(letter)) {
            block.change(letter, {block.value(letter).raw / parts});
        }
    };
    for (const char letter : length_letters) {
        if (letter != 'k' || !cycle) { // there it counts holes
            count(letter, inches ? 10000 : 1000);
        }
    }
    for (const char letter : angle_letters) {
        count(letter, 1000);
    }
}

// P, a time.
void count_milliseconds(Block& block, const DialectRules& rules) noexcept {
    const bool seconds = rules.dwell == DwellUnit::second || (rules.dwell_point_seconds && block.has_dwell_point());
    if (!seconds && block.has('p')) {
        block.change('p', {block.value('p').raw / 1000});
    }
}

BlockStatus adapt_dwell(Block& block, const DialectRules& rules) noexcept {
    for (const char letter : {'x', 'u', 's'}) {
        if (block.has(letter) && (letter == 's' ? rules.dwell_speed : rules.dwell_words)) {
            if (letter != 's' && block.has('p')) {
                return block.at(ProgramError::word_repeated, letter);
            }
            block.rename(letter, 'p', block.value(letter)); // S before P, as in Marlin
            return {};
        }
    }
    count_milliseconds(block, rules);
    return {};
}

BlockStatus adapt_steps(Block& block, const AxisLetters& letters) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
        const char from = "uvw"[k];
        const char to = "xyz"[k];
        if (!block.has(from) || letters.index(from) >= 0) {
            continue;
        }
        if (block.has(to)) {
            return block.at(ProgramError::word_repeated, from);
        }
        block.rename(from, to, block.value(from));
        block.set_step(to);
    }
    return {};
}

} // namespace

BlockStatus adapt_words(Block& block, const ModalState& modal, const AxisLetters& letters,
                        const ProgramSettings& settings) noexcept {
    const DialectRules& rules = rules_of(settings.dialect);
    const std::int16_t modeless = block.code(CodeGroup::non_modal);
    const std::int16_t motion = block.has(CodeGroup::motion) ? block.code(CodeGroup::motion) : modal.motion;
    const bool cycle = is_cycle(motion);
    const std::int16_t lathe = block.code(CodeGroup::lathe_diameter);
    if (block.has('x') && (lathe == Block::no_code ? modal.diameter : lathe == 70)) {
        block.change('x', {block.value('x').raw / 2});
    }
    if (settings.increments) {
        count_increments(block, modal, cycle);
    }
    if (modeless == 40) {
        return adapt_dwell(block, rules);
    }
    if (cycle) {
        count_milliseconds(block, rules);
    }
    if (rules.lead_is_feed && motion == 330 && block.has('f') && !block.has('k')) {
        block.rename('f', 'k', block.value('f'));
    }
    if (!rules.uvw_steps) {
        return {};
    }
    if (cycle && block.has('k') && !block.has('l')) {
        block.rename('k', 'l', block.value('k'));
    }
    const bool sets_offsets =
        modeless == 100 || modeless == 520 || modeless == 920 || block.code(CodeGroup::tool_length) == 431;
    return cycle || sets_offsets ? BlockStatus{} : adapt_steps(block, letters);
}

} // namespace splinefeed
