// SPDX-License-Identifier: MIT
// Teller: tells the steps of a story to a LiveMachine in virtual time: to that of a run, or to one that is served.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/live/live_machine.hpp"
#include "live/story.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"
#include "support/virtual_clock.hpp"

#include "splinefeed/base/units.hpp"

#include <csignal>
#include <fmt/format.h>
#include <fnmatch.h>
#include <thread>
#include <unistd.h>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;

/// The steps and questions that a story has of any target. Its machine begins with the first step that is no fact.
class Teller {
public:
    Teller(VirtualClock& clock, bool serves) : clock_(clock), serves_(serves) {}
    Teller(const Teller&) = delete;
    Teller& operator=(const Teller&) = delete;
    virtual ~Teller() = default;

    void tell(const Step& step) {
        if (!step.at_once && !step.text.empty()) {
            wait(20);
        }
        const std::string text = thrown(step.text);
        std::istringstream words(text);
        std::string word;
        words >> word >> std::ws;
        std::string rest = text.substr(words.eof() ? text.size() : static_cast<std::size_t>(words.tellg()));
        if (word == "run:" || word == "serve:") {
            serves_ == (word == "serve:") ? tell({step.at, true, rest}) : void();
            return;
        }
        const std::uint64_t begins_us = clock_.now_us();
        if (const std::optional<std::string> answer = answer_to(word, rest)) {
            rest = of_door(rest);
            INFO("expected: " << rest << "\n  got:      " << *answer);
            REQUIRE(fnmatch(rest.c_str(), answer->c_str(), FNM_EXTMATCH) == 0);
        } else if (!word.empty()) {
            INFO("refused: " << refused_);
            REQUIRE(refused_.empty());
            try {
                order(word, words, rest);
            } catch (const OutputError& error) {
                refused_ = error.what();
            }
        }
        took_us_ = clock_.now_us() - begins_us;
    }
    /// Nothing is left, but the end of a machine that is served.
    virtual void end() = 0;

protected:
    [[nodiscard]] virtual LiveMachine& machine() = 0;
    /// What the dice make of a step.
    [[nodiscard]] virtual std::string thrown(std::string text) { return text; }
    /// Its planner's thread leaves.
    virtual void leave() = 0;
    virtual void wait(int ms) { clock_.sleep_us(us_per_ms * static_cast<std::uint64_t>(ms)); }
    virtual void order(const std::string& word, std::istringstream& /*words*/, const std::string& rest) {
        const auto number = [&rest] {
            return std::stoi(rest);
        };
        word == "begin"        ? void(machine())
        : word == "rest"       ? machine().rest()
        : word == "stop"       ? machine().stop(rest)
        : word == "leave"      ? leave()
        : word == "signal"     ? signal({SIGINT})
        : word == "signals"    ? signal({SIGTERM, SIGHUP})
        : word == "halt"       ? void(machine().halt())
        : word == "quick-stop" ? machine().quick_stop()
        : word == "home"       ? machine().home(static_cast<std::uint32_t>(number()))
        : word == "forget"     ? machine().forget_input()
        : word == "off"        ? machine().enable(false)
        : word == "on"         ? machine().enable(true)
        : word == "reset"      ? machine().reset_faults()
        : word == "wait"       ? wait(number())
                               : throw std::invalid_argument(word);
    }
    /// Nothing: it is no question.
    [[nodiscard]] virtual std::optional<std::string> answer_to(const std::string& word, const std::string& /*rest*/) {
        return word == "shows"     ? shows()
               : word == "says"    ? std::optional(machine().finish())
               : word == "where"   ? machine().where()
               : word == "places"  ? places()
               : word == "refused" ? std::exchange(refused_, {})
               : word == "took"    ? std::optional(std::to_string(took_us_ / us_per_ms))
                                   : std::nullopt;
    }
    /// They come, and the watch has counted them.
    static void signal(std::initializer_list<int> signals) {
        const int count = SignalWatch::interrupts() + static_cast<int>(signals.size());
        for (const int signal : signals) {
            REQUIRE(kill(getpid(), signal) == 0);
        }
        for (int i = 0; i < 5000 && SignalWatch::interrupts() < count; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        REQUIRE(SignalWatch::interrupts() == count);
    }
    static std::string text_of(const std::optional<double>& mm) { return mm ? fmt::format("{:g}", *mm) : "-"; }
    static void add(std::string& list, const std::string& what, const char* between = ", ") {
        list += (list.empty() || what.empty() ? "" : between) + what;
    }
    [[nodiscard]] bool serves() const noexcept { return serves_; }
    [[nodiscard]] SignalWatch* signals() noexcept { return serves_ ? nullptr : &signals_; }

    std::string refused_;

private:
    /// "a, run:b, serve:c" is "a, b" at the door of a run.
    [[nodiscard]] std::string of_door(const std::string& list) const {
        std::string out;
        for (std::size_t at = 0, next = 0; next != std::string::npos; at = next + 2) {
            next = list.find(", ", at);
            const std::string part = list.substr(at, next == std::string::npos ? next : next - at);
            const bool one = part.starts_with("run:") || part.starts_with("serve:");
            const bool other = one && part.starts_with("serve:") != serves_;
            add(out, other ? "" : part.substr(one ? part.find(':') + 1 : 0));
        }
        return out;
    }
    std::string shows() {
        static const std::array homing{"", "homing", "homed", "not homed"};
        const MachineReading now = machine().read();
        const std::string moves = now.executes ? fmt::format("in move {}", now.waypoint) : "busy";
        std::string out = machine().over() ? "over" : "";
        add(out, machine().carried_out() ? "" : "waits");
        add(out, machine().hold_asked() ? "asks for a hold" : "");
        add(out, serves_ && !now.stands ? moves : "");
        add(out, serves_ && !now.known ? "unknown" : "");
        add(out, homing.at(static_cast<std::size_t>(now.homing)));
        add(out, std::string(now.note));
        const int alarm = static_cast<int>(now.alarm);
        add(out, alarm != 0 ? fmt::format("alarm {}: {}", alarm, now.alarm_sentence) : "");
        return out;
    }
    std::string places() {
        std::string out;
        for (const RunTarget::AxisPlace& at : machine().places()) {
            add(out, text_of(at.mm) + (at.online ? "" : "?"), " ");
        }
        return out;
    }

    VirtualClock& clock_;
    bool serves_;
    SignalWatch signals_{{}};
    std::uint64_t took_us_ = 0;
};

/// The stories of a target, each through its doors.
/// @param target  its names: {"lines"}; {"setpoint", "homes"} of drives that find their references
/// @param share  of so many that tell them: each makes so much fewer rounds
/// @param make  (serves, story, round) to a Teller
template <class Make>
void tell_stories(const std::vector<std::string>& target, const Make& make, int share = 1) {
    int told = 0;
    for (const Story& story : read_stories()) {
        for (const bool serves : {false, true}) {
            if (!story.holds(serves, target)) {
                continue;
            }
            ++told;
            DYNAMIC_SECTION(target[0] << (serves ? ", serve: " : ", run: ") << story.name) {
                const int first = static_cast<int>(first_round());
                for (int round = first;
                     round < std::max(first + story.ways(), rounds((story.times + share - 1) / share)); ++round) {
                    CAPTURE(round);
                    const auto teller = make(serves, round);
                    for (const Step& step : story.steps) {
                        INFO(step.at << ": " << step.text);
                        teller->tell(step);
                    }
                    teller->end();
                }
            }
        }
    }
    CHECK(told >= 10);
}

} // namespace splinefeed_test
