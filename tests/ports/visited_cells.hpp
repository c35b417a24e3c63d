// SPDX-License-Identifier: MIT
// VisitedCells: of a port's table of phase x event, the cells that some runs went through.
#pragma once

#include "splinefeed/hal/phase_machine.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace splinefeed_test {

/// Events that never come in some phases, and why.
template <class Phase, class Event>
struct NeverVisited {
    std::vector<Phase> phases;
    std::vector<Event> events;
    const char* why;
};

template <class Phase, class Event>
class VisitedCells {
public:
    using Machine = splinefeed::hal::PhaseMachine<Phase, Event>;
    using Never = NeverVisited<Phase, Event>;

    void add(const Machine& machine) {
        for_each([&](Phase phase, Event event) { at(phase, event) += machine.visits(phase, event); });
    }
    /// The cells that could have been visited and were not: rare ones, such as a stop while the drives arrive.
    [[nodiscard]] std::string missed(const std::vector<Never>& never) const {
        std::string text;
        for_each([&](Phase phase, Event event) {
            const bool possible = std::none_of(never.begin(), never.end(), [&](const Never& cells) {
                return std::ranges::count(cells.phases, phase) > 0 && std::ranges::count(cells.events, event) > 0;
            });
            text += possible && at(phase, event) == 0 ? std::string(" ") + name(phase) + "/" + name(event) : "";
        });
        return text.empty() ? " none" : text;
    }
    void require_unvisited(const std::vector<Never>& never) const {
        for (const Never& cells : never) {
            for (const Phase phase : cells.phases) {
                for (const Event event : cells.events) {
                    INFO(name(phase) << " " << name(event) << ": " << cells.why);
                    CHECK(at(phase, event) == 0);
                }
            }
        }
    }

private:
    template <class Visit>
    static void for_each(Visit&& visit) {
        for (std::size_t i = 0; i < Machine::phases; ++i) {
            for (std::size_t j = 0; j < Machine::events; ++j) {
                visit(static_cast<Phase>(i), static_cast<Event>(j));
            }
        }
    }
    [[nodiscard]] std::uint64_t& at(Phase phase, Event event) {
        return visits_[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
    }
    [[nodiscard]] std::uint64_t at(Phase phase, Event event) const {
        return visits_[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
    }

    std::array<std::array<std::uint64_t, Machine::events>, Machine::phases> visits_{};
};

} // namespace splinefeed_test
