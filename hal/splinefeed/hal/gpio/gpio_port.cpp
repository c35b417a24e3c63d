// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/gpio_port.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>

namespace splinefeed::hal::gpio {

GpioPort::GpioPort(const PinMap& map, const GpioPortSettings& settings, MachinePins& lines, Noted noted)
    : map_(&map), settings_(settings), time_(settings.step.clock != nullptr ? settings.step.clock : &system_clock()),
      lines_(&lines), noted_(std::move(noted)), port_(lines.outputs(), settings.step),
      inputs_(map, settings_, lines, port_), mover_(map, settings_, inputs_, port_), stops_(settings_, map, inputs_),
      probe_(inputs_.find(InputRole::probe)), stop_(1, settings.stop), began_ns_(time_->now_ns()) {}

// The lines become safe when nobody sets any more.
GpioPort::~GpioPort() {
    port_.close();
}

PortFailure GpioPort::open() {
    if (std::string what =
            inputs_.trouble().empty() ? inputs_.in_the_way({InputRole::e_stop, InputRole::drive_fault}) : fault();
        !what.empty()) {
        return {what};
    }
    const GpioHold stop = stopped_by();
    const bool given_up = stop.cause == GpioCause::limit && phases_.phase() == GpioPhase::resting;
    if (!orders().reset && stop.cause > GpioCause::touched && !given_up) {
        return {stop.what};
    }
    if (lost()) {
        port_.close();
        if (!port_.clear()) {
            return {fault()};
        }
        doubt_places();
    }
    forget_stop();
    stops_.let_leave();
    return {};
}

PortFailure GpioPort::prepare(const FeedSegment& first) {
    const bool fresh = !began();
    if (fresh) {
        drop_changes();
    }
    if (const auto input = orders().home ? std::nullopt : stops_.acting()) {
        return {inputs_.acts(*input), 0, inputs_.is(*input, InputRole::limit) ? Remedy::home : Remedy::none};
    }
    if (std::string what = inputs_.in_the_way({InputRole::e_stop, InputRole::drive_fault}); !what.empty()) {
        return {what};
    }
    if (settings_.ends_at_probe && inputs_.acting({InputRole::probe})) {
        return {inputs_.acts(*probe_)};
    }
    forget_stop();
    for (const unsigned k : indices(settings_.machine.axes)) {
        if ((orders().placed >> k & 1U) != 0) {
            put(static_cast<int>(k), first);
        }
    }
    if (orders().home) {
        if (PortFailure failure = home(first)) {
            return port_.was_disabled() ? PortFailure{fault()} : failure;
        }
    }
    port_.close();
    port_.reset();
    static_cast<void>(port_.start());
    take(GpioEvent::prepared);
    began_ns_ = fresh ? time_->now_ns() : began_ns_;
    if (settings_.ends_at_probe) {
        watch_probe(false);
    }
    return {};
}

PortFailure GpioPort::renew(const FeedSegment& first) {
    order({.placed = orders().placed});
    return prepare(first);
}

// Where an axis stands whose place is not known is what the motion says. The others keep their counts.
void GpioPort::put(int axis, const FeedSegment& first) noexcept {
    if (mover_.origin(axis) != Origin::known) {
        const bool known = (orders().placed >> static_cast<unsigned>(axis) & 1U) != 0;
        mover_.place(axis, nearest_step(first.start[static_cast<unsigned>(axis)]),
                     known ? Origin::known : Origin::told);
    }
}

PortFailure GpioPort::home(const FeedSegment& first) {
    PerAxis<double> begin_mm{};
    for (const unsigned k : indices(settings_.machine.axes)) {
        begin_mm[k] = settings_.begin_mm(k, first);
        if ((orders().home_axes >> k & 1U) != 0 && map_->home[k]) {
            mover_.forget(static_cast<int>(k));
        }
    }
    take(GpioEvent::search);
    PortFailure failure = mover_.home(orders().home_axes);
    if (!failure) {
        failure.what = inputs_.in_the_way({InputRole::e_stop, InputRole::drive_fault, InputRole::limit});
    }
    if (!failure && !orders().stays) {
        failure.what = mover_.go_to(begin_mm);
    }
    if (failure) {
        take(GpioEvent::give_up);
    }
    drop_changes(); // of the search
    return failure;
}

// A motion that begins a little beside the middle between two counts begins at the count where its axis stands. That
// may be the other one: no step is lost however often it happens.
bool GpioPort::align(const FeedSegment& first) {
    constexpr std::int64_t half = units_per_count / 2;
    constexpr std::int64_t most = units_per_count / 100;
    for (const unsigned k : indices(settings_.machine.axes)) {
        put(static_cast<int>(k), first); // behind a search of others
        const std::int64_t at = mover_.count(static_cast<int>(k)) * units_per_count;
        shift_[k] = std::clamp(first.start[k], at - half, at + half - 1) - first.start[k];
        if (shift_[k] > most || shift_[k] < -most) {
            hold(GpioCause::misplaced,
                 "axis " + settings_.axis_name[k] + " stands at " + mm_text(mover_.position(static_cast<int>(k))) +
                     " mm, and its motion begins at " + mm_text(settings_.begin_mm(k, first)) + " mm");
            return false;
        }
    }
    return true;
}

bool GpioPort::submit(const FeedSegment& segment) noexcept {
    const auto limit = stops_.led_into(segment);
    if (limit) {
        hold(GpioCause::led_further, "the " + inputs_.name(*limit) + " still acts: move away from it");
    }
    if (limit || (phases_.phase() == GpioPhase::ready && !align(segment))) {
        port_.quick_stop();
        return false;
    }
    take(GpioEvent::segment);
    FeedSegment own = segment;
    for (const unsigned k : indices(settings_.machine.axes)) {
        own.start[k] += shift_[k];
        own.end[k] += shift_[k];
    }
    return port_.submit(own);
}

void GpioPort::complete() noexcept {
    if (settings_.ends_at_probe && !touched_mm_) {
        hold(GpioCause::untouched, "the probe did not touch anything on the way");
    }
    take(GpioEvent::complete);
    port_.complete();
}

PortState GpioPort::poll() noexcept {
    take_changes();
    // Levels, too: a change may have been taken before the motion.
    if (const auto input = stops_.acting()) {
        hold_by(*input);
    }
    if (inputs_.acting({InputRole::e_stop}) && !port_.was_disabled()) {
        port_.disable();
    }
    follow_stop();
    return port_.poll();
}

// What all axes do about it, as one: the plan holds; where it does not, the port stops; where that does not, it is cut.
void GpioPort::follow_stop() {
    const std::uint64_t now_us = time_->now_us();
    if (hold_.cause != GpioCause::none) { // behind the fault of a drive there is no time for a plan
        stop_.request(hold_.cause == GpioCause::drive_fault || hold_.cause == GpioCause::misplaced
                          ? StopRequest::quick_stop
                          : StopRequest::hold,
                      now_us);
    }
    const PortPhase phase = port_.poll().phase;
    const bool whole = phases_.phase() == GpioPhase::whole;
    const StopRequest executed = port_.was_disabled() && phase == PortPhase::fault ? StopRequest::disable
                                 : port_.halted()                                  ? StopRequest::quick_stop
                                 : whole && phase == PortPhase::idle               ? StopRequest::hold
                                                                                   : StopRequest::none;
    executed_us_ = executed == StopRequest::none ? 0 : executed_us_ == 0 ? now_us : executed_us_;
    const StopFacts facts{.status_us = port_.last_cycle_us(),
                          .standstill = port_.at_standstill(),
                          .executed = executed,
                          .executed_us = executed_us_};
    stop_.update(now_us, {&facts, 1});
    if (stop_.to_send(0) == StopRequest::quick_stop) {
        port_.quick_stop();
    } else if (stop_.to_send(0) == StopRequest::disable) {
        port_.disable();
    }
}

void GpioPort::quick_stop() noexcept {
    if (hold_.cause < GpioCause::touched) {
        hold_ = {GpioCause::asked_twice, "interrupted twice"};
    }
    stop_.request(StopRequest::quick_stop, time_->now_us());
    port_.quick_stop();
}

void GpioPort::close() noexcept {
    port_.close();
    if (phases_.phase() != GpioPhase::left) {
        lines_->make_safe();
    }
}

void GpioPort::hold(GpioCause cause, const std::string& what) {
    const bool worse = cause >= GpioCause::drive_fault && cause > hold_.cause; // than what the plan brakes for
    if (hold_.cause == GpioCause::none || worse) {
        hold_ = {cause, what};
    }
}

void GpioPort::hold_by(std::size_t input) {
    hold(inputs_.is(input, InputRole::limit) ? GpioCause::limit : GpioCause::drive_fault,
         "the " + inputs_.name(input) + " acts");
}

void GpioPort::forget_stop() noexcept {
    hold_ = {};
    stop_.reset();
    executed_us_ = 0;
}

void GpioPort::doubt_places() noexcept {
    for (int k = 0; k < settings_.machine.axes; ++k) {
        mover_.doubt(k);
    }
}

GpioHold GpioPort::stopped_by() {
    const bool pressed = inputs_.acting({InputRole::e_stop}).has_value();
    if (lost()) {
        const bool e_stop = pressed || (port_.was_disabled() && inputs_.trouble().empty() &&
                                        stop_.report(0).request != StopRequest::disable);
        return {e_stop ? GpioCause::e_stop : GpioCause::disabled, fault() + (e_stop ? "; release it, and reset" : "")};
    }
    if (pressed) {
        return {GpioCause::e_stop, inputs_.in_the_way({InputRole::e_stop})};
    }
    if (const auto input = stops_.acting()) {
        hold_by(*input);
    }
    return hold_;
}

PerAxis<double> GpioPort::positions_at(const std::optional<PerAxis<std::int64_t>>& counts) const {
    PerAxis<double> out{};
    for (int k = 0; k < settings_.machine.axes; ++k) {
        const auto axis = static_cast<unsigned>(k);
        out[axis] = counts ? mover_.position_at(k, (*counts)[axis]) : mover_.position(k);
    }
    return out;
}

void GpioPort::drop_changes() {
    while (inputs_.take()) {
    }
}

void GpioPort::touch(const std::optional<PerAxis<std::int64_t>>& counts) {
    touched_mm_ = positions_at(counts);
    probe_away_.reset();
    if (settings_.ends_at_probe) {
        hold(GpioCause::touched, "the " + inputs_.name(*probe_) + " touched");
    }
}

void GpioPort::take_changes() {
    const auto counts = each(settings_.machine.axes, [&](unsigned k) { return port_.counts(static_cast<int>(k)); });
    stops_.follow(counts, time_->now_us());
    const bool contact = probe_ && inputs_.active(*probe_); // before its change, which then is there
    while (const auto change = inputs_.take()) {
        noted_(*change, change->counts ? std::optional(positions_at(change->counts)) : std::nullopt);
        if (probe_ == change->input && probe_away_ && change->active != *probe_away_) {
            touch(change->counts);
        }
        if (stops_.stops(*change)) {
            hold_by(change->input);
        }
    }
    if (probe_away_ && contact != *probe_away_) { // since before it was watched
        touch(std::nullopt);
    }
}

void GpioPort::watch_probe(bool away) {
    take_changes(); // those before do not count
    probe_away_ = away;
    touched_mm_.reset();
    take_changes(); // but how it is
}

std::string GpioPort::drives() const {
    std::string names;
    for (const unsigned k : indices(settings_.machine.axes)) {
        names += (k > 0 ? ", " : "") + settings_.axis_name[k];
    }
    return "the drives of " + names;
}

std::string GpioPort::still_on() const {
    return port_.may_be_on() ? drives() + " may still be on: switch their power off" : std::string();
}

std::string GpioPort::fault() const {
    const std::string off = port_.may_be_on() ? drives() + " could not be disabled" : "the drives were disabled";
    if (const std::string what = inputs_.trouble(); !what.empty()) {
        return what + ": " + off;
    }
    if (const std::string what = port_.failure().what; !port_.was_disabled()) {
        return port_.position_known() ? what : what + ": " + off;
    }
    // Asked of the port as the last means, or of the switch.
    return stop_.report(0).request == StopRequest::disable ? hold_.what + ", but the port did not stop: " + off
                                                           : "the e-stop was pressed: " + off;
}

std::string GpioPort::leave() {
    port_.close();
    if (settings_.drives_on_at_end && port_.position_known()) {
        lines_->keep_drives_on();
    } else {
        port_.power_off();
    }
    take(GpioEvent::leave);
    return still_on();
}

// Motors that hold no axis know no place.
std::string GpioPort::switch_off() {
    port_.power_off();
    doubt_places();
    return still_on();
}

} // namespace splinefeed::hal::gpio
