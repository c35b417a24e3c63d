// SPDX-License-Identifier: MIT
// BlockInterpreter: the words that move coordinate systems, and the reference positions.
#include "splinefeed/s0_program/block_interpreter.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

BlockStatus BlockInterpreter::set_tool_length() noexcept {
    const std::int16_t code = block_.code(CodeGroup::tool_length);
    if (code == Block::no_code) {
        return {};
    }
    AxisPoint& tool = frame_.offsets().tool;
    if (code == 490) {
        tool = {};
    } else if (code == 431) {
        for (int k = 0; k < letters_.count(); ++k) {
            tool[static_cast<unsigned>(k)] = has_axis(k) ? axis_value(k) : tool[static_cast<unsigned>(k)];
        }
    } else {
        std::int32_t number = frame_.offsets().tool_number;
        if (block_.has('h') && (!to_integer(block_.value('h'), number) || number < 0)) {
            return block_.at(ProgramError::tool_unknown, 'h');
        }
        ToolOffset found;
        if (number > 0 && settings_.tools == nullptr) {
            return block_.at(ProgramError::tool_table_missing, CodeGroup::tool_length);
        }
        if (number > 0 && !settings_.tools->find(number, found)) {
            return block_.has('h') ? block_.at(ProgramError::tool_unknown, 'h')
                                   : block_.at(ProgramError::tool_unknown, CodeGroup::tool_length);
        }
        tool = found.offset;
    }
    offsets_changed_ = true;
    return check_offsets(CodeGroup::tool_length);
}

BlockStatus BlockInterpreter::set_offsets() noexcept {
    const std::int16_t code = block_.code(CodeGroup::non_modal);
    const bool use_all = rules().bare_g92 && !block_.has_any(letters_.bits()); // G92 alone
    WorkOffsets& offsets = frame_.offsets();
    switch (code) {
    case 100: {
        std::int32_t what = 0;
        std::int32_t number = 0;
        static_cast<void>(to_integer(block_.value('l'), what));
        static_cast<void>(to_integer(block_.value('p'), number));
        const int system = number == 0 ? offsets.active : number - 1;
        AxisPoint values = frame_.to_program(place_.machine, system);
        for (int k = 0; k < letters_.count(); ++k) {
            if (has_axis(k)) {
                values[static_cast<unsigned>(k)] = axis_value(k);
                if (what == 2) {
                    offsets.systems[static_cast<unsigned>(system)].origin[static_cast<unsigned>(k)] = axis_value(k);
                }
            }
        }
        if (what == 20) {
            frame_.set_place(system, place_.machine, values);
        } else if (block_.has('r')) {
            offsets.systems[static_cast<unsigned>(system)].rotation_deg = block_.value('r');
        }
        break;
    }
    case 281: offsets.g28 = place_.machine; break;
    case 301: offsets.g30 = place_.machine; break;
    case 520:
    case 920:
        frame_.begin_g92();
        for (int k = 0; k < letters_.count(); ++k) {
            if (has_axis(k) || use_all) {
                const auto n = static_cast<unsigned>(k);
                offsets.g92[n] = code == 520 ? axis_value(k) : place_.program[n] + frame_.g92(k) - axis_value(k);
            }
        }
        break;
    case 921:
        offsets.g92 = {};
        offsets.g92_applies = false;
        break;
    case 922: offsets.g92_applies = false; break;
    case 923: offsets.g92_applies = true; break;
    default: return {};
    }
    offsets_changed_ = true;
    return check_offsets(CodeGroup::non_modal);
}

BlockStatus BlockInterpreter::check_offsets(CodeGroup group) noexcept {
    const auto is_far = [&](const AxisPoint& point) {
        bool far = false;
        for (int k = 0; k < letters_.count(); ++k) {
            far = far || !is_position(point[static_cast<unsigned>(k)]);
        }
        return far;
    };
    const WorkOffsets& offsets = frame_.offsets();
    bool far = is_far(offsets.g92) || is_far(offsets.tool) || is_far(offsets.g28) || is_far(offsets.g30);
    for (const WorkSystem& system : offsets.systems) {
        far = far || is_far(system.origin);
    }
    if (far) {
        return block_.at(ProgramError::position_out_of_range, group);
    }
    frame_changed();
    return {};
}

// G28, G30: by the point of the words to the stored position; with words only those axes go there.
BlockStatus BlockInterpreter::plan_reference_move() noexcept {
    const AxisPoint& stored = block_.code(CodeGroup::non_modal) == 280 ? frame_.offsets().g28 : frame_.offsets().g30;
    const AxisPoint machine = find_end().machine;
    std::uint32_t axes = 0;
    for (int k = 0; k < letters_.count(); ++k) {
        axes |= has_axis(k) ? 1U << static_cast<unsigned>(k) : 0U;
    }
    if (block_.has(CodeGroup::motion)) { // it is a mode only
        modal_.set_motion(block_.code(CodeGroup::motion), rules());
    }
    if (rules().g28_homes) {
        plan_homing(axes);
        end_shift(plan_.home_axes);
        return {};
    }
    AxisPoint to = machine;
    for (int k = 0; k < letters_.count(); ++k) {
        const auto n = static_cast<unsigned>(k);
        to[n] = axes == 0 || (axes >> n & 1U) != 0 ? stored[n] : machine[n];
    }
    if (const BlockStatus status = check_reach(machine); !status.ok()) {
        return status;
    }
    plan_.kind = PlanKind::line_by_way;
    plan_.move = MoveKind::rapid;
    plan_.stops_before = true;
    plan_.stop_at_end = true;
    plan_.way = machine;
    return move_to({frame_.to_program(to), to});
}

// Marlin's homing says where the axes are: G92 ends for them.
void BlockInterpreter::end_shift(std::uint32_t axes) noexcept {
    for (unsigned k = 0; k < static_cast<unsigned>(letters_.count()); ++k) {
        Decimal& shift = frame_.offsets().g92[k];
        if ((axes >> k & 1U) != 0 && shift.raw != 0) {
            shift = {};
            offsets_changed_ = true;
        }
    }
    frame_changed();
}

/// @param axes  bits of the axes that go home; none: all
void BlockInterpreter::plan_homing(std::uint32_t axes) noexcept {
    plan_.kind = PlanKind::line;
    plan_.move = MoveKind::home;
    plan_.stops_before = true;
    plan_.stop_at_end = true;
    plan_.manner.mode = PathMode::exact_path;
    plan_.home_axes = axes != 0 ? axes : (1U << static_cast<unsigned>(letters_.count())) - 1U;
    for (int k = 0; k < letters_.count(); ++k) {
        const auto n = static_cast<unsigned>(k);
        const bool extruder = letters_.kind(k) == AxisKind::extruder;
        if (extruder) {
            plan_.home_axes &= ~(1U << n);
        } else if ((plan_.home_axes >> n & 1U) != 0) {
            place_.machine[n] = frame_.offsets().g28[n];
        }
    }
    plan_.to = place_.machine;
    frame_changed();
}

} // namespace splinefeed
