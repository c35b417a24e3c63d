// SPDX-License-Identifier: MIT
//
// The one end of a LiveMachine's thread.
#include "host_sim/base/output_file.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/output/place_text.hpp"

#include "splinefeed/base/units.hpp"

#include <exception>

namespace splinefeed::host {

namespace {

constexpr int not_finished = 1;

std::string with_trouble(const std::string& ending, const std::string& trouble) {
    if (trouble.empty()) {
        return ending;
    }
    constexpr std::string_view begin = "interrupted: ";
    const bool prefixed = ending.compare(0, begin.size(), begin) == 0;
    const std::string rest = prefixed ? ending.substr(begin.size()) : ending;
    return rest.empty() ? trouble : trouble + "; " + rest;
}

} // namespace

// A spindle that was ended comes to a standstill by its own ramp, and modules confirm what they were told; a further
// signal does not wait for it.
std::string LiveMachine::outputs_end() {
    const int signals = SignalWatch::interrupts();
    while (outputs_ != nullptr && outputs_->ends() && SignalWatch::interrupts() == signals) {
        settings_.clock->sleep_us(poll_every_us);
    }
    return outputs_ != nullptr ? outputs_->unended() : lost_outputs_;
}

// Counted in looks, not in time: a process that was stopped meanwhile is no planner that is blocked.
void LiveMachine::await_planner() noexcept {
    constexpr int looks_a_second = 100;
    std::uint64_t writes = OutputFile::writes();
    for (int looks = 0; looks < stall_s * looks_a_second && !leaves_.load(); ++looks) {
        settings_.clock->sleep_us(us_per_s / looks_a_second);
        if (const std::uint64_t now = OutputFile::writes(); now != writes) {
            writes = now;
            looks = 0;
        }
    }
    if (!leaves_.load()) {
        target_->port().close();
        abandon(ending_ + "; an output whose reader does not read was given up", not_finished);
    }
}

// The axes stand, or are known not to have confirmed it. Drives that were not made ready are left alone.
void LiveMachine::end() noexcept {
    const auto add = [this](const std::string& what) { // once
        ending_ += ending_.find(what) != std::string::npos ? "" : ending_.empty() ? what : "; " + what;
    };
    const auto step = [&](const auto& what) {
        try {
            what();
        } catch (const std::exception& error) {
            add(error.what());
        }
    };
    const bool began = phase_ == Phase::ready || phase_ == Phase::failed || (serves() && !facts_.has_feedback);
    std::vector<RunTarget::AxisPlace> places;
    for (const unsigned k : indices(began ? machine_->settings.axes : 0)) { // where nobody can say it
        places.push_back({k, std::nullopt});
    }
    feed_->end_outputs();
    if (!serves()) {
        feed_->set_trouble(outputs_ != nullptr ? outputs_->trouble() : std::string());
        ending_ = with_trouble(reason_, feed_->trouble());
    }
    if (began) {
        step([&] {
            places = target_->places();
            where_ = target_->where() + on_line(reached().line);
        });
        step([&] { add(target_->leave(false)); });
    }
    step([&] { add(outputs_end()); });
    {
        const std::lock_guard lock(mutex_);
        known_.places = places;
    }
    if (serves()) {
        step([&] { stands() ? keep() : void(); });
        target_->port().close();
    } else {
        if (settings_.state != nullptr) {
            step([&] { settings_.state->ends(places); });
        }
        settings_.signals->at_once(
            [this, sentence =
                       (ending_.empty() ? std::string("interrupted while outputs were written; the motion was complete")
                                        : ending_) +
                       where_] {
                target_->port().close();
                abandon(sentence, not_finished);
            });
        ending_ += ending_.empty() ? std::string() : where_;
    }
    const bool waits = !serves() && !ending_.empty();
    over_.store(true);
    if (waits) {
        await_planner();
    }
}

} // namespace splinefeed::host
