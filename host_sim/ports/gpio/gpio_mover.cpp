// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/gpio_mover.hpp"

#include "splinefeed/hal/motion/straight_motion.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double search_mm = 2000.0; // of an axis without travel limits
constexpr double beyond = 1.2;       // of its travel
constexpr std::uint64_t poll_every_us = 1000;

} // namespace

GpioMover::GpioMover(const MachineDescription& machine, const hal::gpio::LineMap& map, GpioInputs& inputs,
                     hal::gpio::StepPort& port, std::function<int()> interrupts, std::function<void()> quick_stop,
                     hal::Clock& clock)
    : machine_(&machine), map_(&map), inputs_(&inputs), port_(&port), interrupts_(std::move(interrupts)),
      quick_stop_(std::move(quick_stop)), time_(&clock) {}

double GpioMover::mm_of(int axis, std::int64_t count) const noexcept {
    return static_cast<double>(count) / machine_->settings.axis[static_cast<unsigned>(axis)].steps_per_mm;
}

void GpioMover::preset_position(int axis, std::int64_t count) noexcept {
    origin_[static_cast<unsigned>(axis)] = count - port_->counts(axis);
    referenced_[static_cast<unsigned>(axis)] = true;
}

// What a move must not go on with, but the switch that it waits for, and limits that are this switch or share its line.
bool GpioMover::ends_move(std::size_t input, const std::optional<Until>& until) const noexcept {
    const hal::gpio::InputRole role = map_->inputs[input].role;
    return (role == hal::gpio::InputRole::drive_fault || role == hal::gpio::InputRole::limit) &&
           !(until && map_->inputs[until->input].line == map_->inputs[input].line);
}

// What acts already: a limit of an axis that does not move is no news, and one that is left may act for a while.
void GpioMover::begin(const PerAxis<bool>& moves, Way way, const std::optional<Until>& until, Moved& moved) const {
    moved.tolerated.assign(map_->inputs.size(), false);
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const hal::gpio::MappedInput& input = map_->inputs[i];
        if (!ends_move(i, until) || !inputs_->active(i)) {
            continue;
        }
        const bool limit = input.role == hal::gpio::InputRole::limit;
        const bool stays = limit && input.axis >= 0 && !moves[static_cast<unsigned>(input.axis)];
        moved.tolerated[i] = stays || (limit && way == Way::off);
        if (!moved.tolerated[i] && moved.trouble.empty()) {
            moved.trouble =
                fmt::format("the {} acts{}", inputs_->name(i), limit ? " already; move the axis off it by hand" : "");
        }
    }
    if (interrupts_() > 0) {
        moved.trouble = "interrupted";
    }
}

// Takes what the switches tell: changes, and levels, since a change may have come before the move. False: the move
// shall be held.
bool GpioMover::check_inputs(const std::optional<Until>& until, Moved& moved) {
    const auto acts = [&](std::size_t input) {
        if (ends_move(input, until) && !moved.came && moved.trouble.empty()) {
            moved.trouble = fmt::format("the {} acts", inputs_->name(input));
        }
    };
    while (const auto change = inputs_->take()) {
        if (until && change->input == until->input && change->active == until->active && !moved.came) {
            moved.came = true;
            moved.counts_at = change->counts;
        } else if (change->active) {
            acts(change->input);
        }
    }
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const bool active = inputs_->active(i);
        if (active && !moved.tolerated[i]) {
            acts(i);
        }
        moved.tolerated[i] = moved.tolerated[i] && active;
    }
    const int interrupts = interrupts_();
    if (interrupts > 0 && moved.trouble.empty()) {
        moved.trouble = "interrupted";
    }
    if (interrupts > 1) {
        quick_stop_();
    }
    return !moved.came && moved.trouble.empty();
}

GpioMover::Moved GpioMover::move(const PerAxis<double>& to_mm, double feed_mm_s, Way way, std::optional<Until> until) {
    PerAxis<double> from{};
    PerAxis<bool> moves{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        from[axis] = position(k);
        moves[axis] = from[axis] != to_mm[axis];
    }
    Moved moved;
    begin(moves, way, until, moved);
    if (!moved.trouble.empty()) {
        return moved;
    }
    hal::StraightMotion motion(machine_->settings, from, to_mm, feed_mm_s);
    port_->close();
    port_->reset();
    static_cast<void>(port_->start());
    const auto stopped = [this] {
        const hal::PortPhase phase = port_->poll().phase;
        return phase == hal::PortPhase::fault || phase == hal::PortPhase::halted;
    };
    FeedSegment segment;
    bool over = false;
    while (!over && motion.next(segment)) {
        for (;;) {
            if (!check_inputs(until, moved)) {
                motion.hold();
            }
            over = stopped();
            if (over || port_->room() > 0) {
                break;
            }
            time_->sleep_us(poll_every_us);
        }
        over = over || !port_->submit(segment);
    }
    port_->complete();
    while (!over && port_->poll().phase != hal::PortPhase::idle) {
        static_cast<void>(check_inputs(until, moved));
        over = stopped();
        time_->sleep_us(poll_every_us);
    }
    if (port_->poll().phase == hal::PortPhase::fault) {
        moved.trouble = inputs_->trouble().empty() ? port_->failure().what : inputs_->trouble();
    } else if (port_->halted() && moved.trouble.empty()) {
        moved.trouble = "the port stopped before the end of the move: " + port_->failure().what;
    }
    return moved;
}

GpioMover::Moved GpioMover::move_by(int axis, double mm, double feed_mm_s, Way way, std::optional<Until> until) {
    PerAxis<double> to{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        to[static_cast<unsigned>(k)] = position(k) + (k == axis ? mm : 0.0);
    }
    return move(to, feed_mm_s, way, until);
}

std::string GpioMover::home(std::uint32_t axes) {
    for (int axis = machine_->settings.axes - 1; axis >= 0; --axis) {
        if (map_->home[static_cast<unsigned>(axis)] && (axes >> static_cast<unsigned>(axis) & 1U) != 0) {
            if (const std::string what = home_axis(axis); !what.empty()) {
                return fmt::format("axis {} does not find its reference: {}",
                                   machine_->axis_name[static_cast<unsigned>(axis)], what);
            }
        }
    }
    return {};
}

std::string GpioMover::home_axis(int axis) {
    const auto k = static_cast<unsigned>(axis);
    const hal::gpio::HomeSearch& search = *map_->home[k];
    const std::size_t input = *inputs_->home_of(axis);
    const auto& travel = machine_->travel[k];
    const double span = travel ? beyond * (travel->high - travel->low) : search_mm;
    const double towards = search.towards_high ? 1.0 : -1.0;
    Moved moved;
    if (inputs_->active(input)) { // it stands on its switch
        moved = move_by(axis, -towards * span, search.latch_mm_s, Way::off, Until{input, false});
        if (moved.trouble.empty() && !moved.came) {
            moved.trouble =
                fmt::format("the {} acts all along {} mm; look at its wire and `active`", inputs_->name(input), span);
        }
        if (moved.trouble.empty()) {
            moved = move_by(axis, -towards * search.pull_off_mm, search.latch_mm_s, Way::off);
        }
        if (!moved.trouble.empty()) {
            return moved.trouble;
        }
    }
    moved = move_by(axis, towards * span, search.seek_mm_s, Way::on, Until{input, true});
    if (!moved.trouble.empty() || !moved.came) {
        return !moved.trouble.empty() ? moved.trouble
                                      : fmt::format("the {} does not act within {} mm; look at `towards` and its wire",
                                                    inputs_->name(input), span);
    }
    const double over = moved.counts_at ? std::fabs(position(axis) - position_at(axis, (*moved.counts_at)[k])) : 0.0;
    moved = move_by(axis, -towards * (over + search.pull_off_mm), search.seek_mm_s, Way::off);
    if (!moved.trouble.empty() || inputs_->active(input)) {
        return !moved.trouble.empty() ? moved.trouble
                                      : fmt::format("the {} still acts {} mm off its edge; raise pull_off_mm",
                                                    inputs_->name(input), search.pull_off_mm);
    }
    moved = move_by(axis, 2.0 * towards * search.pull_off_mm, search.latch_mm_s, Way::on, Until{input, true});
    if (!moved.trouble.empty() || !moved.counts_at) {
        return !moved.trouble.empty() ? moved.trouble
               : moved.came           ? "the instant of its switch's edge was lost"
                                      : fmt::format("the {} acted once and does not any more", inputs_->name(input));
    }
    const double steps_per_mm = machine_->settings.axis[k].steps_per_mm;
    origin_[k] = std::llround(search.position_mm * steps_per_mm) - (*moved.counts_at)[k];
    referenced_[k] = true;
    const double clear = search.position_mm - towards * search.pull_off_mm;
    return move_by(axis, clear - position(axis), search.seek_mm_s, Way::off).trouble;
}

std::string GpioMover::go_to(const PerAxis<double>& mm) {
    return move(mm, machine_->settings.max_feed_mm_s, Way::on, std::nullopt).trouble;
}

} // namespace splinefeed::host
