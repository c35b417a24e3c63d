// SPDX-License-Identifier: MIT
#include "gpio_mover.hpp"

#include "host_sim/straight_motion.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <thread>

namespace splinefeed::host {

namespace {

constexpr double search_mm = 2000.0; // of an axis without travel limits
constexpr double beyond = 1.2;       // of its travel
constexpr std::chrono::milliseconds poll_every{1};

} // namespace

GpioMover::GpioMover(const MachineDescription& machine, const hal::gpio::LineMap& map, GpioInputs& inputs,
                     hal::gpio::StepPort& port, std::function<int()> interrupts, std::function<void()> quick_stop)
    : machine_(&machine), map_(&map), inputs_(&inputs), port_(&port), interrupts_(std::move(interrupts)),
      quick_stop_(std::move(quick_stop)) {}

double GpioMover::mm_of(int axis, std::int64_t count) const noexcept {
    return static_cast<double>(count) / machine_->settings.axis[static_cast<unsigned>(axis)].steps_per_mm;
}

void GpioMover::stands_at(int axis, std::int64_t count) noexcept {
    origin_[static_cast<unsigned>(axis)] = count - port_->counts(axis);
}

// Takes what the switches tell. False: the move shall be held.
bool GpioMover::look(const std::optional<Until>& until, Moved& moved) {
    while (const auto change = inputs_->take()) {
        if (until && change->input == until->input && change->active == until->active && !moved.came) {
            moved.came = true;
            moved.counts_at = change->counts;
        } else if (const hal::gpio::InputRole role = map_->inputs[change->input].role;
                   change->active && moved.trouble.empty() && !moved.came &&
                   (role == hal::gpio::InputRole::drive_fault || role == hal::gpio::InputRole::limit)) {
            moved.trouble = fmt::format("the {} acts", inputs_->name(change->input));
        }
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

GpioMover::Moved GpioMover::move(const PerAxis<double>& to_mm, double feed_mm_s, std::optional<Until> until) {
    PerAxis<double> from{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        from[static_cast<unsigned>(k)] = position(k);
    }
    StraightMotion motion(*machine_, from, to_mm, feed_mm_s);
    port_->stop();
    port_->reset();
    static_cast<void>(port_->start());
    Moved moved;
    FeedSegment segment;
    bool fault = false;
    while (!fault && motion.next(segment)) {
        for (;;) {
            if (!look(until, moved)) {
                motion.hold();
            }
            fault = port_->poll().phase == hal::PortPhase::fault;
            if (fault || port_->room() > 0) {
                break;
            }
            std::this_thread::sleep_for(poll_every);
        }
        fault = fault || !port_->submit(segment);
    }
    port_->complete();
    while (!fault && port_->poll().phase != hal::PortPhase::idle) {
        static_cast<void>(look(until, moved));
        fault = port_->poll().phase == hal::PortPhase::fault;
        std::this_thread::sleep_for(poll_every);
    }
    if (fault) {
        moved.trouble = inputs_->trouble().empty() ? port_->trouble() : inputs_->trouble();
    }
    return moved;
}

GpioMover::Moved GpioMover::move_by(int axis, double mm, double feed_mm_s, std::optional<Until> until) {
    PerAxis<double> to{};
    for (int k = 0; k < machine_->settings.axes; ++k) {
        to[static_cast<unsigned>(k)] = position(k) + (k == axis ? mm : 0.0);
    }
    return move(to, feed_mm_s, until);
}

std::string GpioMover::home() {
    for (int axis = machine_->settings.axes - 1; axis >= 0; --axis) {
        if (map_->home[static_cast<unsigned>(axis)]) {
            if (const std::string what = home(axis); !what.empty()) {
                return fmt::format("axis {} does not find its reference: {}",
                                   machine_->axis_name[static_cast<unsigned>(axis)], what);
            }
        }
    }
    return {};
}

std::string GpioMover::home(int axis) {
    const auto k = static_cast<unsigned>(axis);
    const hal::gpio::HomeSearch& search = *map_->home[k];
    const std::size_t input = *inputs_->home_of(axis);
    const auto& travel = machine_->travel[k];
    const double span = travel ? beyond * (travel->high - travel->low) : search_mm;
    const double towards = search.towards_high ? 1.0 : -1.0;
    Moved moved;
    if (inputs_->active(input)) { // it stands on its switch
        moved = move_by(axis, -towards * span, search.slow_mm_s, Until{input, false});
        if (moved.trouble.empty() && !moved.came) {
            moved.trouble =
                fmt::format("the {} acts all along {} mm; look at its wire and `active`", inputs_->name(input), span);
        }
        if (moved.trouble.empty()) {
            moved = move_by(axis, -towards * search.back_off_mm, search.slow_mm_s);
        }
        if (!moved.trouble.empty()) {
            return moved.trouble;
        }
    }
    moved = move_by(axis, towards * span, search.fast_mm_s, Until{input, true});
    if (!moved.trouble.empty() || !moved.came) {
        return !moved.trouble.empty() ? moved.trouble
                                      : fmt::format("the {} does not act within {} mm; look at `towards` and its wire",
                                                    inputs_->name(input), span);
    }
    const double over = moved.counts_at ? std::fabs(position(axis) - position_at(axis, (*moved.counts_at)[k])) : 0.0;
    moved = move_by(axis, -towards * (over + search.back_off_mm), search.fast_mm_s);
    if (!moved.trouble.empty() || inputs_->active(input)) {
        return !moved.trouble.empty() ? moved.trouble
                                      : fmt::format("the {} still acts {} mm off its edge; raise back_off_mm",
                                                    inputs_->name(input), search.back_off_mm);
    }
    moved = move_by(axis, 2.0 * towards * search.back_off_mm, search.slow_mm_s, Until{input, true});
    if (!moved.trouble.empty() || !moved.counts_at) {
        return !moved.trouble.empty() ? moved.trouble
               : moved.came           ? "the instant of its switch's edge was lost"
                                      : fmt::format("the {} acted once and does not any more", inputs_->name(input));
    }
    const double steps_per_mm = machine_->settings.axis[k].steps_per_mm;
    origin_[k] = std::llround(search.position_mm * steps_per_mm) - (*moved.counts_at)[k];
    const double clear = search.position_mm - towards * search.back_off_mm;
    return move_by(axis, clear - position(axis), search.fast_mm_s).trouble;
}

std::string GpioMover::go_to(const PerAxis<double>& mm) {
    return move(mm, machine_->settings.max_feed_mm_s, std::nullopt).trouble;
}

} // namespace splinefeed::host
