// SPDX-License-Identifier: MIT
// Axes are numbered X Y Z A B C U V W. Lengths are in mm, but #5401 and #5420 ff. in the units of the program, and
// #5061 ff. in those that it had when it probed. In dialects with macros #5221 ff. are in those of the program, too.
#include "splinefeed/s0_program/system_parameters.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // without strlen

namespace {

constexpr std::string_view axis_order = "xyzabcuvw";
constexpr std::int32_t system_step = 20;

/// A number that stands for a value of one axis, or for something else of its block.
struct Number {
    std::int32_t block = 0; // its first number
    std::int32_t index = 0; // from 0
};

constexpr std::int32_t probe_block = 5061;
constexpr std::int32_t g28_block = 5161;
constexpr std::int32_t g30_block = 5181;
constexpr std::int32_t g92_block = 5210;
constexpr std::int32_t system_block = 5220;
constexpr std::int32_t input_number = 5399;
constexpr std::int32_t tool_block = 5400;
constexpr std::int32_t position_block = 5420;

Number number_of(std::int32_t number) noexcept {
    struct Range {
        std::int32_t first;
        std::int32_t last;
    };
    constexpr Range ranges[] = {{probe_block, 5070}, {g28_block, 5169},     {g30_block, 5189},
                                {g92_block, 5219},   {system_block, 5390},  {input_number, input_number},
                                {tool_block, 5413},  {position_block, 5428}};
    for (const Range& range : ranges) {
        if (number >= range.first && number <= range.last) {
            return {range.first, number - range.first};
        }
    }
    return {};
}

Decimal whole(std::int32_t value) noexcept {
    return Decimal::from_integer(value);
}

} // namespace

bool SystemParameters::owns(std::int32_t number) noexcept {
    return number_of(number).block != 0;
}

bool SystemParameters::can_write(std::int32_t number) noexcept {
    const Number place = number_of(number);
    if (place.block == g28_block || place.block == g30_block || place.block == probe_block ||
        place.block == input_number) {
        return true;
    }
    return place.block == system_block && place.index > 0 && (place.index - 1) % system_step < 10;
}

Decimal SystemParameters::of_axis(const AxisPoint& point, std::int32_t index) const noexcept {
    const int axis =
        index >= 0 && index < 9 ? interpreter_->letters_.index(axis_order[static_cast<unsigned>(index)]) : -1;
    return axis >= 0 ? point[static_cast<unsigned>(axis)] : Decimal{};
}

Decimal SystemParameters::in_units(Decimal value, std::int32_t index) const noexcept {
    const bool length = index < 3 || index > 5;
    return length ? interpreter_->modal_.in_units(value) : value;
}

Decimal SystemParameters::read(std::int32_t number) const noexcept {
    const Number place = number_of(number);
    const WorkOffsets& offsets = interpreter_->frame_.offsets();
    switch (place.block) {
    case probe_block:
        return place.index == 9 ? whole(interpreter_->results_.probe_contact ? 1 : 0)
                                : of_axis(interpreter_->results_.probe_at, place.index);
    case g28_block: return of_axis(offsets.g28, place.index);
    case g30_block: return of_axis(offsets.g30, place.index);
    case g92_block:
        return place.index == 0 ? whole(offsets.g92_applies ? 1 : 0) : of_axis(offsets.g92, place.index - 1);
    case system_block: {
        if (place.index == 0) {
            return whole(offsets.active + 1);
        }
        const WorkSystem& system =
            offsets.systems[static_cast<unsigned>((place.index - 1) / system_step) % work_systems];
        const std::int32_t index = (place.index - 1) % system_step;
        const bool converts = interpreter_->rules().macros;
        const Decimal origin = of_axis(system.origin, index);
        return index == 9 ? system.rotation_deg : converts ? in_units(origin, index) : origin;
    }
    case input_number: return interpreter_->results_.input;
    case tool_block:
        return place.index == 0 ? whole(offsets.tool_number)
                                : in_units(of_axis(offsets.tool, place.index - 1), place.index - 1);
    case position_block: return in_units(of_axis(interpreter_->place_.program, place.index), place.index);
    default: return {};
    }
}

void SystemParameters::write(BlockInterpreter& interpreter, std::int32_t number, Decimal value) noexcept {
    const Number place = number_of(number);
    WorkOffsets& offsets = interpreter.frame_.offsets();
    const auto set_axis = [&](AxisPoint& point, std::int32_t index) {
        const int axis = interpreter.letters_.index(axis_order[static_cast<unsigned>(index)]);
        if (axis >= 0) {
            point[static_cast<unsigned>(axis)] = value;
        }
    };
    if (place.block == input_number) {
        interpreter.results_.input = value;
        return;
    }
    if (place.block == probe_block) { // programs clear it before they probe
        if (place.index == 9) {
            interpreter.results_.probe_contact = value.raw != 0;
        } else {
            set_axis(interpreter.results_.probe_at, place.index);
        }
        return;
    }
    if (place.block != system_block) {
        set_axis(place.block == g28_block ? offsets.g28 : offsets.g30, place.index);
    } else {
        WorkSystem& system = offsets.systems[static_cast<unsigned>((place.index - 1) / system_step) % work_systems];
        const std::int32_t index = (place.index - 1) % system_step;
        const bool length = index < 3 || index > 5;
        value = length && interpreter.rules().macros ? interpreter.modal_.in_mm(value) : value;
        if (index == 9) {
            system.rotation_deg = value;
        } else {
            set_axis(system.origin, index);
        }
        interpreter.frame_changed();
    }
    interpreter.offsets_changed_ = true;
}

namespace {

/// Whether the text is that word, in any case and with any blanks.
bool is_word(TextCursor text, std::string_view word) noexcept {
    return text.take(word) && text.at_end();
}

} // namespace

bool SystemParameters::read_mode(const TextCursor& text, bool& applies) const noexcept {
    struct Mode {
        std::string_view name;
        bool applies;
    };
    const ModalState& modal = interpreter_->modal_;
    const Mode modes[] = {{"metric"sv, !modal.inches},
                          {"imperial"sv, modal.inches},
                          {"absolute"sv, !modal.incremental},
                          {"incremental"sv, modal.incremental},
                          {"inverse_time"sv, modal.inverse_time},
                          {"units_per_minute"sv, !modal.inverse_time && !modal.per_turn},
                          {"units_per_rev"sv, modal.per_turn},
                          {"lathe_diameter_mode"sv, modal.diameter},
                          {"lathe_radius_mode"sv, !modal.diameter},
                          {"spindle_css_mode"sv, modal.surface.applies()},
                          {"spindle_rpm_mode"sv, !modal.surface.applies()},
                          {"spindle_on"sv, modal.spindle != SpindleState::stopped},
                          {"spindle_cw"sv, modal.spindle == SpindleState::clockwise}};
    for (const Mode& mode : modes) {
        if (is_word(text, mode.name)) {
            applies = mode.applies;
            return true;
        }
    }
    return false;
}

bool SystemParameters::read(std::string_view name, Decimal& out) const noexcept {
    TextCursor begin(name);
    if (!begin.take('_')) {
        return false;
    }
    const auto is = [&](std::string_view word) {
        return is_word(begin, word);
    };
    if (bool applies = false; read_mode(begin, applies)) {
        out = whole(applies ? 1 : 0);
        return true;
    }
    for (std::int32_t k = 0; k < 9; ++k) {
        if (is({axis_order.data() + k, 1})) {
            out = read(position_block + k);
            return true;
        }
    }
    if (is("feed"sv)) {
        out = interpreter_->modal_.feed_word();
    } else if (is("rpm"sv)) {
        out = interpreter_->modal_.speed;
    } else if (is("line"sv)) {
        out = whole(static_cast<std::int32_t>(interpreter_->line_));
    } else if (is("coord_system"sv)) {
        const std::int32_t active = interpreter_->frame_.offsets().active;
        out = whole(active < 6 ? 540 + 10 * active : 585 + active);
    } else if (is("motion_mode"sv)) {
        out = whole(interpreter_->modal_.motion);
    } else if (is("plane"sv)) {
        out = whole(interpreter_->modal_.plane == Plane::xy   ? 170
                    : interpreter_->modal_.plane == Plane::zx ? 180
                                                              : 190);
    } else if (is("current_tool"sv)) {
        out = whole(interpreter_->frame_.offsets().tool_number);
    } else if (is("selected_tool"sv)) {
        out = whole(interpreter_->modal_.selected_tool);
    } else {
        return false;
    }
    return true;
}

} // namespace splinefeed
