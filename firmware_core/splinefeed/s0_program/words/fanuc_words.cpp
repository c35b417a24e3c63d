// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/fanuc_words.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace splinefeed {

namespace {

constexpr std::int32_t most_of_fanuc = 48;
constexpr std::int32_t most_of_haas = 99;
constexpr std::int16_t first_named = 1100; // G110 to G129 are G154 P1 to P20
constexpr std::int16_t last_named = 1290;
constexpr Decimal longest_dwell = Decimal::from_integer(60); // in a hole [s]

// G54 P3 is G54.1 P3, where P is no other word's.
bool is_further(const Block& block, std::int16_t motion) noexcept {
    return block.code(CodeGroup::work_system) == 540 && block.has('p') && !block.has(CodeGroup::non_modal) &&
           !block.has(CodeGroup::path_mode) && !block.has(CodeGroup::without_effect) && !is_cycle(motion);
}

} // namespace

BlockStatus FanucWords::wrong(const FanucBlock& in, FanucFault fault, char letter) noexcept {
    fault_ = fault;
    return in.block.at(ProgramError::coordinates_unsuited, letter);
}

BlockStatus FanucWords::wrong(const FanucBlock& in, FanucFault fault, CodeGroup group) noexcept {
    fault_ = fault;
    return in.block.at(ProgramError::coordinates_unsuited, group);
}

void FanucWords::take(std::int32_t tenths, const Block& block, CodeInfo& info) noexcept {
    struct Row {
        std::int32_t tenths;
        Word word;
        CodeGroup group;
    };
    static constexpr Row rows[] = {
        {541, further_word, CodeGroup::work_system},       {1540, further_word, CodeGroup::work_system},
        {520, local_word, CodeGroup::non_modal},           {680, rotate_word, CodeGroup::without_effect},
        {690, end_rotate_word, CodeGroup::without_effect}, {510, scale_word, CodeGroup::without_effect},
        {500, end_scale_word, CodeGroup::without_effect},  {511, mirror_word, CodeGroup::without_effect},
        {501, end_mirror_word, CodeGroup::without_effect}};
    words_ = block.has_codes() ? words_ : 0;
    if (tenths >= first_named && tenths <= last_named && tenths % 10 == 0) {
        info.group = CodeGroup::work_system;
        words_ |= further_word;
    }
    for (const Row& row : rows) {
        if (row.tenths == tenths) {
            info.group = row.group;
            words_ |= row.word;
        }
    }
}

BlockStatus FanucWords::adapt(Block& block, const ModalState& modal, const AxisLetters& letters,
                              const ProgramPlace& place) noexcept {
    const FanucBlock in{block, modal, letters, place, std::exchange(words_, 0U)};
    stores_ = moves_ = applied_ = false;
    origin_.number = 0;
    if (is_cycle(in.motion) && block.has_dwell_point() && block.value('p') > longest_dwell && in.words == 0) {
        return wrong(in, FanucFault::dwell_point, 'p');
    }
    const bool is_other = in.words != 0 || in.modeless == 100 || state_.turn.applies() || state_.unstated != 0 ||
                          (in.modeless == 920 && moves_program()) ||
                          (block.has(CodeGroup::work_system) && state_.further != 0) || is_further(block, in.motion);
    if (!is_other) { // most blocks
        return {};
    }
    next_ = state_;
    stores_ = true;
    const BlockStatus status = read_words(in);
    if (!status.ok()) { // whoever looks for further errors executes the rest of the block
        stores_ = moves_ = false;
        origin_.number = 0;
        leave(in);
    }
    return status;
}

// The words of a refused block are no other code's.
void FanucWords::leave(const FanucBlock& in) noexcept {
    if (in.words != 0 || in.modeless == 100) {
        in.block.keep(Block::bits("fnst"));
    }
    if ((in.words & further_word) != 0) {
        in.block.set_code(CodeGroup::work_system, Block::no_code, 1);
    }
}

BlockStatus FanucWords::read_words(const FanucBlock& in) noexcept {
    constexpr unsigned placing = local_word + rotate_word + scale_word + mirror_word;
    const unsigned taking = in.words & (placing + (in.has_axes() ? end_mirror_word : 0U));
    const bool cutter = in.modal.cutter.applies() && in.block.code(CodeGroup::cutter_radius) != 400;
    const unsigned more = in.modeless != Block::no_code && (in.words & local_word) == 0 ? 1U : 0U;
    for (const unsigned both :
         {rotate_word + end_rotate_word, scale_word + end_scale_word, mirror_word + end_mirror_word}) {
        if ((in.words & both) == both) {
            return wrong(in, FanucFault::order, CodeGroup::without_effect);
        }
    }
    if (taking != 0 && static_cast<unsigned>(std::popcount(taking)) + more > 1) {
        return in.block.at(ProgramError::axis_words_twice, CodeGroup::non_modal);
    }
    using Read = BlockStatus (FanucWords::*)(const FanucBlock&) noexcept;
    constexpr Read reads[] = {&FanucWords::read_ends,   &FanucWords::check_turned, &FanucWords::read_system,
                              &FanucWords::read_origin, &FanucWords::read_local,   &FanucWords::read_rotation,
                              &FanucWords::read_scale,  &FanucWords::begin_mirror, &FanucWords::check_motion};
    for (const Read read : reads) {
        if (const BlockStatus status = (this->*read)(in); !status.ok()) {
            return status;
        }
    }
    if (moves_ && cutter) {
        return in.block.at(ProgramError::cutter_active,
                           in.block.has(CodeGroup::work_system) ? CodeGroup::work_system : CodeGroup::without_effect);
    }
    return {};
}

BlockStatus FanucWords::read_system(const FanucBlock& in) noexcept {
    const std::int16_t code = in.block.code(CodeGroup::work_system);
    if ((in.words & further_word) == 0 && !is_further(in.block, in.motion)) {
        moves_ = moves_ || (in.block.has(CodeGroup::work_system) && state_.further != 0);
        next_.further = in.block.has(CodeGroup::work_system) ? 0 : next_.further;
        return {};
    }
    const bool is_named = code >= first_named && code <= last_named;
    const std::int32_t most = code <= 541 ? most_of_fanuc : most_of_haas;
    const bool takes_p = in.modeless == 40 || in.modeless == 100 || (in.words & scale_word) != 0;
    next_.further = (code - first_named) / 10 + 1;
    if ((!is_named && (takes_p || !to_integer(in.parameter(), next_.further))) || next_.further < 1 ||
        next_.further > most || next_.further > static_cast<std::int32_t>(further_.size())) {
        return wrong(in, FanucFault::system_number, CodeGroup::work_system);
    }
    return finish(in, CodeGroup::work_system, is_named ? 0 : Block::bits("p"));
}

// G10 L2 and L20: what the origin is, under G91 what is added to it.
BlockStatus FanucWords::read_origin(const FanucBlock& in) noexcept {
    std::int32_t what = 0;
    std::int32_t number = 0;
    if (in.modeless != 100 || !to_integer(in.block.value('l'), what) || (what != 2 && what != 20)) {
        return {};
    }
    const std::int32_t most = what == 2 ? 6 : std::min(most_of_haas, static_cast<std::int32_t>(further_.size()));
    if (in.block.has('r') || !in.has_axes() || !to_integer(in.parameter(), number) || number < 1 || number > most) {
        return wrong(in, FanucFault::origin_word, CodeGroup::non_modal);
    }
    const auto place = static_cast<unsigned>(number - 1);
    origin_ = {what == 20, number, what == 20 ? further_[place] : in.place.offsets.systems[place]};
    for (unsigned k = 0; k < in.count(); ++k) {
        if (in.has(k)) {
            Decimal& value = origin_.value.origin[k];
            value = in.steps ? value + in.value(k) : in.value(k);
            if (!is_position(value)) {
                return in.block.at(ProgramError::position_out_of_range, in.letter(k));
            }
        }
    }
    return finish(in, CodeGroup::non_modal, Block::bits("lp") | in.letters.bits());
}

// G52; and G92, which ends the shift of its axes.
BlockStatus FanucWords::read_local(const FanucBlock& in) noexcept {
    const bool shifts = (in.words & local_word) != 0;
    if (!shifts && in.modeless != 920) {
        return {};
    }
    if (!in.has_axes()) {
        return in.block.at(ProgramError::g92_axes_missing, CodeGroup::non_modal);
    }
    for (unsigned k = 0; k < in.count(); ++k) {
        if (!in.has(k)) {
            continue;
        }
        if (shifts && in.steps && next_.local[k].raw != 0) {
            return wrong(in, FanucFault::local_step, CodeGroup::non_modal);
        }
        next_.local[k] = shifts ? in.value(k) : Decimal{};
        if (!is_position(next_.local[k])) {
            return in.block.at(ProgramError::position_out_of_range, in.letter(k));
        }
    }
    moves_ = true;
    return shifts ? finish(in, CodeGroup::non_modal, in.letters.bits()) : BlockStatus{};
}

// The words of the block that have been taken. The interpreter then sees what it may ask for: that coordinates change.
BlockStatus FanucWords::finish(const FanucBlock& in, CodeGroup group, std::uint32_t letters) noexcept {
    constexpr std::uint32_t rest = Block::bits("ijklpqr");
    moves_ = true;
    in.block.keep(~letters);
    const std::uint16_t column = in.block.at(ProgramError::none, group).column;
    if (group == CodeGroup::work_system) { // other words of the block may have the other letters
        in.block.set_code(group, 540, column);
        return {};
    }
    if (group == CodeGroup::non_modal) {
        in.block.set_code(CodeGroup::without_effect, in.block.code(group), column);
        in.block.set_code(group, Block::no_code, column);
    }
    for (char letter = 'i'; letter <= 'r'; ++letter) {
        if (in.block.has(letter) && (rest & Block::letter_bit(letter)) != 0) {
            return in.block.at(ProgramError::word_unused, letter);
        }
    }
    return {};
}

bool FanucWords::apply(WorkOffsets& offsets) noexcept {
    if (!stores_) {
        return false;
    }
    before_ = state_;
    state_ = next_;
    applied_ = true;
    if (origin_.number > 0) {
        const auto place = static_cast<unsigned>(origin_.number - 1);
        old_origin_ = origin_.is_further ? further_[place] : offsets.systems[place];
        (origin_.is_further ? further_[place] : offsets.systems[place]) = origin_.value;
    }
    return moves_;
}

void FanucWords::take_back() noexcept {
    if (!applied_) {
        return;
    }
    applied_ = false;
    state_ = before_;
    if (origin_.number > 0 && origin_.is_further) { // the interpreter puts its own back
        further_[static_cast<unsigned>(origin_.number - 1)] = old_origin_;
    }
}

void FanucWords::end_program() noexcept {
    state_ = {};
}

const WorkSystem* FanucWords::system() const noexcept {
    return state_.further > 0 ? &further_[static_cast<unsigned>(state_.further - 1)] : nullptr;
}

bool FanucWords::moves_program() const noexcept {
    return state_.turn.applies() || state_.local != PerAxis<Decimal>{};
}

void FanucWords::turn(PerAxis<Decimal>& point, bool back) const noexcept {
    if (!moves_program()) {
        return;
    }
    if (!back) {
        state_.turn.apply(point);
    }
    for (const unsigned k : indices(max_axes)) {
        point[k] += back ? -state_.local[k] : state_.local[k];
    }
    if (back) {
        state_.turn.undo(point);
    }
}

bool FanucWords::turn_arc(Decimal& radius, Decimal& sweep_deg) const noexcept {
    return state_.turn.apply_to_arc(radius, sweep_deg);
}

} // namespace splinefeed
