// SPDX-License-Identifier: MIT
// The phases of a StepPort: random faults on a virtual clock visit every cell of the table that can be visited, and no
// phase waits for ever. docs/reference/port_states.md shows the table.
#include "port_rig.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>
#include <fstream>
#include <sstream>

using namespace splinefeed;
using namespace splinefeed::hal::gpio;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr std::array phase_names{"off",     "settling", "opening", "filling", "running",  "slowing",
                                 "starved", "stopping", "done",    "halted",  "disabled", "failed"};
constexpr std::array event_names{"start",    "ready",   "opened",    "filled",     "late",    "stands",
                                 "refilled", "cut off", "exhausted", "quick stop", "disable", "error",
                                 "overdue",  "reset",   "park",      "clear"};
static_assert(phase_names.size() == StepPhases::phases && event_names.size() == StepPhases::events);

using Visits = std::array<std::array<std::uint64_t, StepPhases::events>, StepPhases::phases>;

/// Why an event never comes in a phase; null: it does.
const char* never(StepPhase phase, StepEvent event) {
    const auto only = [&](auto... in) {
        return ((phase != in) && ...) ? "it is told of another phase" : nullptr;
    };
    const bool off_for_good = switched_off(phase);
    switch (event) {
    case StepEvent::start:
        return axes_move(phase) ? "stop() ends the motion first"
               : off_for_good   ? "start() enables nothing"
               : phase == StepPhase::starved || phase == StepPhase::done || phase == StepPhase::halted
                   ? "start() takes `reset` first"
                   : nullptr;
    case StepEvent::ready: return only(StepPhase::settling);
    case StepEvent::opened: return only(StepPhase::opening);
    case StepEvent::filled: return only(StepPhase::filling);
    case StepEvent::late: return only(StepPhase::running);
    case StepEvent::stands: return only(StepPhase::slowing, StepPhase::stopping);
    case StepEvent::refilled: return only(StepPhase::starved);
    case StepEvent::cut_off: return only(StepPhase::filling, StepPhase::starved);
    case StepEvent::exhausted:
        return only(StepPhase::filling, StepPhase::running, StepPhase::slowing, StepPhase::stopping);
    case StepEvent::quick_stop: return off_for_good || phase == StepPhase::off ? "no thread, or no drive" : nullptr;
    case StepEvent::disable: return off_for_good ? "the drives are off" : nullptr;
    case StepEvent::error:
        return phase == StepPhase::starved || phase == StepPhase::done || phase == StepPhase::halted
                   ? "no line is set in it; only a thread that the host does not run for 2 s is an error then"
                   : nullptr;
    case StepEvent::overdue:
        return is_bounded(phase) ? "time itself ends the phase, unless the port is wrong" : "it has no bound";
    case StepEvent::reset: return axes_move(phase) ? "stop() ends the motion first" : nullptr;
    case StepEvent::park: return axes_move(phase) ? "stop() ends the motion first" : nullptr;
    case StepEvent::clear: return off_for_good ? nullptr : "nothing is to be cleared";
    case StepEvent::count: break;
    }
    return nullptr;
}

/// One port through some motions, with whatever goes wrong.
class Story {
public:
    explicit Story(std::uint64_t seed) : random_(seed) {}

    void tell(Visits& visits) {
        for (int motions = 1 + random_.below(3); motions > 0; --motions) {
            if (likely(0.05)) {
                rig_.lines.fail(true);
            }
            if (likely(0.02)) {
                rig_.port.disable();
            }
            static_cast<void>(rig_.port.start());
            move();
            if (likely(0.1)) {
                rig_.port.quick_stop();
                rig_.clock.sleep_us(1000);
            }
            rig_.port.close();
            check();
            rig_.lines.fail(likely(0.2));
            if (likely(0.3)) {
                if (likely(0.2)) {
                    rig_.port.disable();
                }
                static_cast<void>(rig_.port.start()); // without reset()
                rig_.clock.sleep_us(like_us(50'000.0));
                rig_.port.close();
            }
            if (likely(0.3)) {
                if (likely(0.1)) {
                    rig_.port.disable();
                }
                rig_.port.power_off();
                CHECK((rig_.port.may_be_on() || !rig_.lines.enabled()));
            }
            if (likely(0.5)) {
                const bool cleared = rig_.port.clear();
                CHECK(cleared != rig_.port.may_be_on());
            }
            rig_.port.reset();
        }
        rig_.lines.fail(false);
        rig_.port.power_off();
        CHECK_FALSE(rig_.lines.enabled());
        const std::size_t rows = rig_.lines.rows().size();
        rig_.clock.sleep_us(100'000);
        CHECK(rig_.lines.rows().size() == rows);
        for (std::size_t phase = 0; phase < StepPhases::phases; ++phase) {
            for (std::size_t event = 0; event < StepPhases::events; ++event) {
                visits[phase][event] +=
                    rig_.port.phases().visits(static_cast<StepPhase>(phase), static_cast<StepEvent>(event));
            }
        }
    }

private:
    [[nodiscard]] bool likely(double share) { return random_.between(0.0, 1.0) < share; }
    [[nodiscard]] std::uint64_t like_us(double most) { return static_cast<std::uint64_t>(random_.between(0.0, most)); }

    void cause() {
        switch (random_.below(11)) {
        case 0: rig_.port.quick_stop(); break;
        case 1: rig_.port.disable(); break;
        case 2: rig_.lines.fail(true); break;
        case 3: rig_.lines.stall(like_us(60'000.0) * 1000); break;
        case 4: rig_.port.complete(); break;
        case 5:
        case 6:
        case 7: pause_until_ms_ = rig_.now_ms() + random_.between(1.0, 500.0); break;
        case 8:
        case 9: ends_ = true; break;
        case 10:
            rig_.lines.fail(true);
            rig_.port.disable();
            break;
        }
    }
    void move() {
        const double most_mm = likely(0.1) ? 0.0 : 30.0;
        hal::StraightMotion motion(rig_.machine.settings, {0.0, 0.0},
                                   {random_.between(0.0, most_mm), random_.between(0.0, most_mm)},
                                   random_.between(5.0, 100.0));
        ends_ = false;
        if (likely(0.3)) {
            pause_until_ms_ = rig_.now_ms() + random_.between(0.0, 100.0);
        }
        bool more = true;
        const double begin_ms = rig_.now_ms();
        const double first_ms = begin_ms + random_.between(0.0, likely(0.4) ? 60.0 : 700.0);
        const double second_ms = first_ms + random_.between(0.0, likely(0.5) ? 30.0 : 250.0);
        int caused = likely(0.1) ? 2 : likely(0.4) ? 1 : 0;
        while (!ends_ && rig_.port.poll().phase == hal::PortPhase::running) {
            if ((caused == 0 && rig_.now_ms() > first_ms) || (caused == 1 && rig_.now_ms() > second_ms)) {
                ++caused;
                cause();
            }
            if (rig_.now_ms() > pause_until_ms_ && !more) {
                rig_.port.complete();
            } else if (rig_.now_ms() > pause_until_ms_ && !(more = rig_.feed(motion)) && likely(0.5)) {
                pause_until_ms_ = rig_.now_ms() + random_.between(0.0, 100.0); // then it is known to be the end
            }
            rig_.clock.sleep_us(1000);
            REQUIRE(rig_.now_ms() < begin_ms + 15'000.0); // 42 mm at 5 mm/s: no phase waits for ever
        }
    }
    /// What is true of a port that was stopped.
    void check() {
        CHECK(rig_.port.at_standstill());
        if (rig_.port.position_known()) {
            for (unsigned k = 0; k < 2; ++k) {
                CAPTURE(k, phase_names[static_cast<std::size_t>(rig_.port.phases().phase())]);
                CHECK(rig_.port.counts(static_cast<int>(k)) == rig_.steps(k));
            }
        }
        if (switched_off(rig_.port.phases().phase())) {
            CHECK((rig_.port.may_be_on() || !rig_.lines.enabled()));
            CHECK_FALSE(rig_.port.position_known());
        }
        const std::size_t rows = rig_.lines.rows().size();
        rig_.clock.sleep_us(20'000);
        CHECK(rig_.lines.rows().size() == rows);
    }

    RandomPath random_;
    PortRig rig_;
    double pause_until_ms_ = 0.0;
    bool ends_ = false;
};

std::string duration(std::uint64_t us) {
    return us == hal::PhaseBound::final_us ? std::string("-") : fmt::format("{:g} s", static_cast<double>(us) * 1e-6);
}

/// The table as the page has it: the defaults of a map file with a brake.
std::string page_table() {
    const StepPhases::Bounds bounds = step_phase_bounds(500'000, 100'000, 50'000);
    std::string text = "| phase | at most |";
    std::string rule = "|---|---|";
    for (const char* const event : event_names) {
        text += fmt::format(" {} |", event);
        rule += "---|";
    }
    text += '\n' + rule + '\n';
    for (std::size_t phase = 0; phase < StepPhases::phases; ++phase) {
        text += fmt::format("| {} | {} |", phase_names[phase], duration(bounds[phase].most_us));
        for (std::size_t event = 0; event < StepPhases::events; ++event) {
            const auto next = static_cast<std::size_t>(step_phase_table[phase][event]);
            const char* const stays =
                never(static_cast<StepPhase>(phase), static_cast<StepEvent>(event)) ? "" : "stays";
            text += fmt::format(" {} |", next == phase ? stays : phase_names[next]);
        }
        text += '\n';
    }
    return text;
}

} // namespace

TEST_CASE("every phase of a step port meets every event that can come in it, and none waits for ever", "[stopping]") {
    const std::uint64_t seed = 35'100;
    Visits visits{};
    const int stories = rounds(4000, 10'000);
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(stories); ++round) {
        CAPTURE(seed, round);
        Story(seed + round).tell(visits);
    }
    fmt::print("visits of the phases of a step port, {} stories, seed {}:\n", stories, seed);
    for (std::size_t phase = 0; phase < StepPhases::phases; ++phase) {
        fmt::print("  {:8}", phase_names[phase]);
        for (std::size_t event = 0; event < StepPhases::events; ++event) {
            const char* const why = never(static_cast<StepPhase>(phase), static_cast<StepEvent>(event));
            CAPTURE(phase_names[phase], event_names[event]);
            if (why != nullptr) {
                CHECK(visits[phase][event] == 0);
            } else if (first_round() == 0) {
                CHECK(visits[phase][event] > 0);
            }
            fmt::print(" {}", why != nullptr ? "." : std::to_string(visits[phase][event]));
        }
        fmt::print("\n");
    }
}

TEST_CASE("docs/reference/port_states.md has the table of a step port as the code has it") {
    std::ifstream file(test::source_folder() + "/docs/reference/port_states.md");
    std::stringstream page;
    page << file.rdbuf();
    INFO(page_table());
    CHECK(page.str().find(page_table()) != std::string::npos);
}
