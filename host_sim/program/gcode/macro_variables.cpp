// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/macro_variables.hpp"

#include "splinefeed/s0_program/system_parameters.hpp"

namespace splinefeed::host {

namespace {

constexpr std::int32_t program_positions = 5420; // of SystemParameters
constexpr std::int32_t origins = 5221;           // of G54, and every 20 numbers of the next one
constexpr std::int32_t behind_origins = 5390;
constexpr std::int32_t tools = 5400; // of LinuxCNC; of Haas' controls the times of tools, of others none
constexpr std::int32_t last_place = 5428;

Decimal whole(std::int32_t value) noexcept {
    return Decimal::from_integer(value);
}

} // namespace

// Fanuc counts the axes of the machine, others name them.
bool MacroVariables::has_axis(std::int32_t index) const noexcept {
    constexpr std::string_view letters = "xyzabc";
    const auto k = static_cast<std::size_t>(index);
    return index >= 0 && k < letters.size() && k < axes_->size() && (*axes_)[k] == letters.substr(k, 1);
}

std::optional<Decimal> MacroVariables::mode(std::int32_t number) const noexcept {
    const ModalState& modal = control_->modal();
    const std::int16_t motion = is_cycle(modal.motion) ? modal.before_cycle : modal.motion;
    switch (number) {
    case 4001: return motion <= 30 || motion == 330 ? std::optional(whole(motion / 10)) : std::nullopt;
    case 4002: return whole(modal.plane == Plane::xy ? 17 : modal.plane == Plane::zx ? 18 : 19);
    case 4003: return whole(modal.incremental ? 91 : 90);
    case 4005: return whole(modal.inverse_time ? 93 : modal.per_turn ? 95 : 94);
    case 4006: return whole(modal.inches ? 20 : 21);
    case 4007: return whole(modal.cutter.side == 0 ? 40 : modal.cutter.side > 0 ? 41 : 42);
    case 4009: return whole(is_cycle(modal.motion) ? modal.motion / 10 : 80);
    case 4010: return whole(modal.retract_to_r ? 99 : 98);
    case 4014: {
        const std::int32_t active = control_->offsets().active;
        return active < 6 && !is_further() ? std::optional(whole(54 + active)) : std::nullopt;
    }
    case 4109: return modal.feed_word();
    case 4119: return modal.speed;
    case 4120: return whole(modal.selected_tool);
    default: return std::nullopt;
    }
}

// #5041 has the offsets of the tool in it, #5021 is in the units of the machine. Controls do not agree on what the
// others are in shifted and turned coordinates.
std::optional<Decimal> MacroVariables::position(std::int32_t block, std::int32_t index) const noexcept {
    const ModalState& modal = control_->modal();
    if (!has_axis(index) || (block == 5021 && modal.inches) ||
        (block != 5021 && words_ != nullptr && words_->moves_program()) ||
        (block == 5041 && (modal.cutter.side != 0 || control_->offsets().tool != AxisPoint{}))) {
        return std::nullopt;
    }
    return block == 5021 ? to_decimal(control_->position()[static_cast<std::size_t>(index)])
                         : SystemParameters(*control_).read(program_positions + index);
}

std::optional<Decimal> MacroVariables::of_control(std::int32_t number) const noexcept {
    for (const std::int32_t block : {5001, 5021, 5041}) {
        if (number >= block && number < block + 6) {
            return position(block, number - block);
        }
    }
    return mode(number);
}

bool MacroVariables::read(std::int32_t number, Decimal& out) const noexcept {
    if (number < first_of_control || !has_macros()) {
        return memory_->read(number, out);
    }
    const std::optional<Decimal> value = of_control(number);
    out = value.value_or(out);
    return value.has_value();
}

bool MacroVariables::write(std::int32_t number, Decimal value) noexcept {
    if (number >= first_kept && number < first_of_control) {
        is_set_.set(static_cast<std::size_t>(number - first_kept));
    }
    return memory_->write(number, value);
}

bool MacroVariables::refuses(std::int32_t number, ParameterAccess access, bool owned) const noexcept {
    if (owned) {
        const std::int32_t index = (number - origins) % 20;
        return (number >= tools && number <= last_place) || (number == origins - 1 && is_further()) ||
               (number >= origins && number < behind_origins && index < 9 && !has_axis(index));
    }
    if (number < first_of_control) {
        return access == ParameterAccess::read && number >= first_kept &&
               !is_set_.test(static_cast<std::size_t>(number - first_kept));
    }
    return access == ParameterAccess::write || !of_control(number);
}

} // namespace splinefeed::host
