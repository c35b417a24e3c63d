// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/port_mover.hpp"

#include "splinefeed/hal/motion/straight_motion.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::gpio {

namespace {

// An axis that stands on its switch may have come to it fast; grbl's search near a switch is as long.
constexpr double most_pull_offs = 5.0;
constexpr std::uint64_t poll_every_us = 1000;

} // namespace

void PortMover::place(int axis, std::int64_t count, Origin origin) noexcept {
    offset_[index(axis)] = count - port_->counts(axis);
    origin_[index(axis)] = origin;
}

// What a move must not go on with, but the switch that it waits for, and limits that are this switch or share its line.
bool PortMover::ends_move(std::size_t input, const std::optional<Until>& until) const noexcept {
    const InputRole role = map_->inputs[input].role;
    return (role == InputRole::drive_fault || role == InputRole::limit) &&
           !(until && map_->inputs[until->input].line == map_->inputs[input].line);
}

// Changes from before are over; what acts now counts. A limit of an axis that does not move is no news, and one that is
// left may act for a while.
void PortMover::begin(const PerAxis<bool>& moves, Way way, const std::optional<Until>& until, Moved& moved) {
    while (inputs_->take()) {
    }
    moved.tolerated.assign(map_->inputs.size(), false);
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const MappedInput& input = map_->inputs[i];
        if (!ends_move(i, until) || !inputs_->active(i)) {
            continue;
        }
        const bool limit = input.role == InputRole::limit;
        const bool stays = limit && input.axis >= 0 && !moves[static_cast<unsigned>(input.axis)];
        moved.tolerated[i] = stays || (limit && way == Way::off);
        if (!moved.tolerated[i] && moved.trouble.empty()) {
            moved.trouble =
                "the " + inputs_->name(i) + (limit ? " acts already; move the axis off it by hand" : " acts");
        }
    }
    look(until, moved);
}

// Takes what the switches tell: changes, and levels, since a change may have come before the move, or not at all.
void PortMover::look(const std::optional<Until>& until, Moved& moved) {
    const bool so = until && inputs_->active(until->input) == until->active; // before its change, which then is there
    const auto acts = [&](std::size_t input) {
        if (ends_move(input, until) && !moved.ends()) {
            moved.trouble = "the " + inputs_->name(input) + " acts";
        }
    };
    while (const auto change = inputs_->take()) {
        if (until && change->input == until->input && change->active == until->active) {
            moved.counts_at = moved.came ? moved.counts_at : change->counts;
            moved.came = true;
        } else if (change->active) {
            acts(change->input);
        }
    }
    moved.came = moved.came || so;
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
        const bool active = inputs_->active(i);
        if (active && !moved.tolerated[i]) {
            acts(i);
        }
        moved.tolerated[i] = moved.tolerated[i] && active;
    }
    if (inputs_->acting({InputRole::e_stop})) {
        port_->disable();
    }
    if (settings_->interrupted()) {
        moved.trouble = moved.trouble.empty() ? "interrupted" : moved.trouble;
        port_->quick_stop();
    }
}

PortMover::Moved PortMover::move(const PerAxis<double>& to_mm, double feed_mm_s, Way way, std::optional<Until> until) {
    PerAxis<double> from{};
    PerAxis<bool> moves{};
    for (int k = 0; k < settings_->machine.axes; ++k) {
        from[index(k)] = position(k);
        moves[index(k)] = from[index(k)] != to_mm[index(k)];
    }
    port_->close();
    port_->reset();
    Moved moved;
    begin(moves, way, until, moved);
    if (moved.ends()) {
        return moved;
    }
    StraightMotion motion(settings_->machine, from, to_mm, feed_mm_s);
    static_cast<void>(port_->start());
    const auto stopped = [this] {
        const PortPhase phase = port_->poll().phase;
        return phase == PortPhase::fault || phase == PortPhase::halted;
    };
    FeedSegment segment;
    bool over = false;
    while (!over && motion.next(segment)) {
        for (;;) {
            look(until, moved);
            if (moved.ends()) {
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
    while (!over && port_->poll().phase != PortPhase::idle) {
        look(until, moved);
        over = stopped();
        time_->sleep_us(poll_every_us);
    }
    if (port_->poll().phase == PortPhase::fault) {
        const std::string what = inputs_->trouble().empty() ? port_->failure().what : inputs_->trouble();
        moved.trouble = what.empty() ? "the drives were disabled" : what;
    } else if (port_->halted() && moved.trouble.empty()) {
        moved.trouble = "the port stopped before the end of the move: " + port_->failure().what;
    }
    return moved;
}

PortMover::Moved PortMover::move_by(int axis, double mm, double feed_mm_s, Way way, std::optional<Until> until) {
    PerAxis<double> to{};
    for (int k = 0; k < settings_->machine.axes; ++k) {
        to[index(k)] = position(k) + (k == axis ? mm : 0.0);
    }
    return move(to, feed_mm_s, way, until);
}

PortFailure PortMover::home(std::uint32_t axes) {
    for (int axis = settings_->machine.axes - 1; axis >= 0; --axis) {
        if (map_->home[index(axis)] && (axes >> static_cast<unsigned>(axis) & 1U) != 0) {
            if (PortFailure failure = home_axis(axis)) {
                failure.what =
                    "axis " + settings_->axis_name[index(axis)] + " does not find its reference: " + failure.what;
                return failure;
            }
        }
    }
    return {};
}

PortFailure PortMover::home_axis(int axis) {
    const std::size_t k = index(axis);
    const HomeSearch& search = *map_->home[k];
    const std::size_t input = *inputs_->find(InputRole::home, axis);
    const double towards = search.towards_high ? 1.0 : -1.0;
    const auto still_acts = [&](double mm, const char* hint) {
        return PortFailure{.what = "the " + inputs_->name(input) + " still acts " + mm_text(mm) + hint,
                           .remedy = Remedy::clear_switch};
    };
    Moved moved;
    if (inputs_->active(input)) { // it stands on its switch
        const double most_mm = std::min(most_pull_offs * search.pull_off_mm, settings_->search_mm[k]);
        moved = move_by(axis, -towards * most_mm, search.latch_mm_s, Way::off, Until{input, false});
        if (moved.trouble.empty() && !moved.came) {
            return still_acts(most_mm, " mm further; look at its wire and `active`, or jog off it");
        }
        if (moved.trouble.empty()) {
            moved = move_by(axis, -towards * search.pull_off_mm, search.latch_mm_s, Way::off);
        }
        if (!moved.trouble.empty()) {
            return {moved.trouble};
        }
    }
    moved = move_by(axis, towards * settings_->search_mm[k], search.seek_mm_s, Way::on, Until{input, true});
    if (!moved.trouble.empty() || !moved.came) {
        return {!moved.trouble.empty() ? moved.trouble
                                       : "the " + inputs_->name(input) + " does not act within " +
                                             mm_text(settings_->search_mm[k]) + " mm; look at `towards` and its wire"};
    }
    const double over = moved.counts_at ? std::fabs(position(axis) - position_at(axis, (*moved.counts_at)[k])) : 0.0;
    moved = move_by(axis, -towards * (over + search.pull_off_mm), search.seek_mm_s, Way::off);
    if (!moved.trouble.empty()) {
        return {moved.trouble};
    }
    if (inputs_->active(input)) {
        return still_acts(search.pull_off_mm, " mm off its edge; raise pull_off_mm, or look at its wire");
    }
    moved = move_by(axis, 2.0 * towards * search.pull_off_mm, search.latch_mm_s, Way::on, Until{input, true});
    if (!moved.trouble.empty() || !moved.counts_at) {
        return {!moved.trouble.empty() ? moved.trouble
                : moved.came           ? "the instant of its switch's edge was lost"
                                       : "the " + inputs_->name(input) + " acted once and does not any more"};
    }
    const double steps_per_mm = settings_->machine.axis[k].steps_per_mm;
    offset_[k] = std::llround(search.position_mm * steps_per_mm) - (*moved.counts_at)[k];
    origin_[k] = Origin::known;
    const double clear = search.position_mm - towards * search.pull_off_mm;
    return {move_by(axis, clear - position(axis), search.seek_mm_s, Way::off).trouble};
}

std::string PortMover::go_to(const PerAxis<double>& mm) {
    return move(mm, settings_->machine.max_feed_mm_s, Way::on, std::nullopt).trouble;
}

} // namespace splinefeed::hal::gpio
