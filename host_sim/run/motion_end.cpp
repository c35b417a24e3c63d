// SPDX-License-Identifier: MIT
// How a motion ends, why, and what it leaves behind.
#include "host_sim/run/motion.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/output/place_text.hpp"

#include <chrono>
#include <fmt/format.h>
#include <thread>

namespace splinefeed::host {

namespace {

constexpr std::chrono::milliseconds look_slice{1};

} // namespace

std::string Motion::run(std::optional<std::uint64_t> waypoints) {
    progress_.emplace(ProgressOptions{.quiet = asked_.quiet && !asked_.progress, .all = waypoints});
    try {
        execute_all();
    } catch (...) {
        failure_ = std::current_exception();
    }
    std::string broken;
    if (const auto& fault = machine_.fault()) {
        Fault whole = *fault;
        whole.waypoint = feeder_.whole_row(static_cast<std::uint32_t>(fault->waypoint));
        const auto row = static_cast<std::uint32_t>(whole.waypoint);
        broken =
            describe(whole, input_->within_tolerance() && !input_->lines_within_tolerance() ? feeder_.name_of_row(row)
                                                                                            : std::string());
    }
    const bool executed = !live_->is_real() || come_to_rest(broken);
    progress_.reset();
    require_end();
    stopped_ = broken.empty() ? stopped_ : broken;
    if (executed) {
        keep_state();
        return stopped_.empty() ? stopped_ : stopped_ + (live_->is_real() ? live_->where() : where());
    }
    stopped_ = live_->ending();
    return stopped_;
}

// The drives come to rest on the path, whatever ended the run: by the plan where it is sound, without outputs and
// without a look at the input; else by themselves. Whether all that was planned is executed.
// @param broken  what the simulated machine says is wrong with the plan
bool Motion::come_to_rest(const std::string& broken) {
    const bool held = failure_ != nullptr && broken.empty() && moves_;
    const auto next = [this](FeedSegment& out) {
        return way_ ? way_->next(out) : path_->next(out, Supply::late) == Pull::item;
    };
    if (held && way_) {
        way_->hold();
    } else if (held) {
        stream_.hold();
    }
    FeedSegment segment;
    while (held && moves_ && next(segment) && machine_.submit(segment) &&
           machine_.poll().phase != hal::PortPhase::fault && live_->submit(segment, line_, passed_)) {
        ++segments_;
        moves_ = !segment.ends_at_rest();
    }
    if (!broken.empty()) {
        live_->stop(broken);
    }
    for (live_->rest(); live_->runs();) {
        show_progress();
        std::this_thread::sleep_for(look_slice);
    }
    return live_->finish().empty();
}

// What went wrong beside the motion. Before the first move it is thrown; after it, it is why the machine stopped.
void Motion::require_end() {
    if (failure_ == nullptr) {
        try {
            machine_.finish(); // the last row of the trace
        } catch (const OutputError&) {
            failure_ = std::current_exception();
        }
    }
    if (failure_) {
        fail();
    }
    if (path_->failure()) {
        keep_failure(path_->failure());
    } else if (const Status status = stream_.status(); !status.ok()) {
        keep_failure(std::make_exception_ptr(InputError(input_->name(), 0, describe(status.error()))));
    }
    if (stream_.activity() == Activity::aborted) {
        stopped_ = "aborted by an event";
    } else if (stream_.activity() == Activity::held && stream_.state() == Pull::held && held_ != Held::by_machine) {
        stopped_ = "held, and no event resumes it";
    }
    work_.finish();
    optimum_.finish();
    require_tolerance();
}

// Nobody would know where the drives are, did the message not say it.
void Motion::fail() const {
    if (!live_->is_real() || segments_ == 0) {
        std::rethrow_exception(failure_);
    }
    const std::string& ending = live_->ending();
    const std::string rest = ending.empty() ? live_->where() : "; " + ending;
    try {
        std::rethrow_exception(failure_);
    } catch (const OutputError& error) {
        throw OutputError(error.what() + rest);
    } catch (const std::exception& error) {
        throw std::runtime_error(error.what() + rest);
    }
}

// Offsets as the motion has come to them, and where the machine stands. Drives are behind the plan as long as they
// move.
void Motion::keep_state() {
    if (asked_.state == nullptr) {
        return;
    }
    if (steps_.offsets() != nullptr) {
        asked_.state->offsets(*steps_.offsets());
    }
    if (segments_ > 0 && (!live_->is_real() || live_->over())) {
        asked_.state->stands(machine_.position_mm());
    }
}

// A path that is too far from its moves is a fault, whatever else happened.
void Motion::require_tolerance() {
    if (!input_->within_tolerance()) {
        return;
    }
    if (stream_.state() == Pull::finished && stopped_.empty()) {
        deviation_.finish();
    }
    if (asked_.enforce && stopped_.empty()) {
        stopped_ = excess();
    }
}

// Before the first move what is wrong is thrown; after it, it is why the machine stopped.
void Motion::keep_failure(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const InputError& error) {
        if (segments_ == 0) {
            throw;
        }
        stopped_ = error.what();
    } catch (...) {
        failure_ = failure;
        fail();
    }
}

std::string Motion::where() const {
    PlaceText place("; the machine stands at", 6);
    const PerAxis<double> position = machine_.position_mm();
    for (const unsigned k : indices(figures_->axes)) {
        place.add(description_->axis_name[k], position[k]);
    }
    return place.text() + fmt::format(", {:.6f} s after its start", machine_.cycle_time_s()) + on_line(line_);
}

} // namespace splinefeed::host
