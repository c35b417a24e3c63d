// SPDX-License-Identifier: MIT
//
// What a drive sees on its two lines: counts steps in the direction that the line says, and measures every time.
#pragma once

#include "splinefeed/s5_pulse_train/edge.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <string>
#include <vector>

namespace splinefeed_test {

struct SeenStep {
    std::int64_t tick;
    bool up;
};

class EdgeChecker {
public:
    explicit EdgeChecker(const splinefeed::StepTiming& timing) : timing_(timing) {}

    /// Empty, or which time was too short.
    std::string see(const splinefeed::Edge& edge) {
        const std::int64_t tick = edge.tick;
        if (tick < last_) {
            return "an edge before the one before";
        }
        last_ = tick;
        if (edge.line == splinefeed::Line::direction) {
            if (edge.level == up_) {
                return "a direction that was there already";
            }
            up_ = edge.level;
            turned_ = tick;
            return level_ && !timing_.step_on_edge                                ? "a direction changes in a pulse"
                   : tick - (timing_.step_on_edge ? rise_ : fall_) < timing_.hold ? "hold time"
                                                                                  : "";
        }
        if (edge.level == level_) {
            return "a level that was there already";
        }
        level_ = edge.level;
        if (!timing_.step_on_edge && !edge.level) {
            fall_ = tick;
            return tick - rise_ < timing_.high ? "pulse" : "";
        }
        const std::int64_t since = tick - rise_;
        rise_ = tick;
        steps.push_back({tick, up_});
        if (tick - turned_ < timing_.setup) {
            return "set-up time";
        }
        if (timing_.step_on_edge) {
            return since < timing_.high || since < timing_.low ? "level" : "";
        }
        return tick - fall_ < timing_.low ? "pause" : "";
    }

    std::vector<SeenStep> steps;
    [[nodiscard]] bool at_rest() const { return timing_.step_on_edge || !level_; }

private:
    static constexpr std::int64_t long_ago = -1000000000;

    splinefeed::StepTiming timing_;
    std::int64_t last_ = long_ago;
    std::int64_t rise_ = long_ago;
    std::int64_t fall_ = long_ago;
    std::int64_t turned_ = long_ago;
    bool level_ = false;
    bool up_ = false;
};

} // namespace splinefeed_test
