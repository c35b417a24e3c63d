// SPDX-License-Identifier: MIT
//
// The stories of stories.txt, on a LiveMachine in virtual time: as a run, and as a machine that is served.
#include "host_sim/base/output_file.hpp"
#include "host_sim/live/live_machine.hpp"

#include "host/temporary_folder.hpp"
#include "live/talking_target.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

#include <csignal>
#include <fnmatch.h>
#include <sstream>
#include <thread>
#include <unistd.h>

using namespace splinefeed_test;

namespace {

struct Step {
    int line = 0;
    bool at_once = false;
    std::string text;
};

struct Story {
    std::string door;
    std::string name;
    std::vector<Step> steps;
};

std::vector<Story> read_stories() {
    std::vector<Story> out;
    std::ifstream in(splinefeed::test::source_folder() + "/tests/live/stories.txt");
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.empty() || line[0] == '#') {
            continue;
        }
        if (line[0] != ' ') {
            const std::size_t colon = line.find(": ");
            out.push_back({line.substr(0, colon), line.substr(colon + 2), {}});
            continue;
        }
        std::istringstream words(line);
        out.back().steps.push_back({number, false, {}});
        for (std::string word; words >> word;) {
            std::string& text = out.back().steps.back().text;
            if (word == "|" || word == "+") {
                out.back().steps.push_back({number, word == "+", {}});
                continue;
            }
            text += (text.empty() ? "" : " ") + word;
        }
    }
    return out;
}

EventKind kind_of(const std::string& name) {
    int kind = 0;
    while (name != action_name(static_cast<EventKind>(kind))) {
        ++kind;
        REQUIRE(kind <= static_cast<int>(EventKind::offsets_changed));
    }
    return static_cast<EventKind>(kind);
}

std::string text_of(const std::optional<double>& mm) {
    return mm ? fmt::format("{:g}", *mm) : "-";
}

/// Tells a story to a machine, which begins with the first line that is no fact.
class Teller {
public:
    explicit Teller(bool serves) : serves_(serves) {}

    void tell(const std::string& step, bool at_once) {
        if (!at_once && !step.empty()) {
            world_.clock.sleep_us(20 * us_per_ms);
        }
        std::istringstream words(step);
        std::string word;
        words >> word;
        if (word == "run:" || word == "serve:") {
            if (const std::string rest = rest_of(words); serves_ == (word == "serve:")) {
                tell(rest, true);
            }
        } else if (const auto asked = questions_.find(word); asked != questions_.end()) {
            const std::string expected = of_door(rest_of(words));
            const std::string got = asked->second();
            INFO("expected: " << expected << "\n  got:      " << got);
            REQUIRE(fnmatch(expected.c_str(), got.c_str(), 0) == 0);
        } else if (!word.empty()) {
            order(word, words);
        }
    }
    /// Nothing is left, but the end of a machine that is served.
    void end() {
        machine_.reset();
        const std::string told = world_.take_told() + refused_;
        INFO("left: " << told);
        REQUIRE((told.empty() || (serves_ && (told == "close" || told.ends_with("finish, close")))));
    }

private:
    using Words = std::istringstream;

    static std::string rest_of(Words& words) {
        std::string out;
        std::getline(words >> std::ws, out);
        return out;
    }
    static int number_of(Words& words, int otherwise = 0) {
        int out = 0;
        return words >> out ? out : otherwise;
    }
    /// "a, run:b, serve:c" is "a, b" at the door of a run.
    [[nodiscard]] std::string of_door(const std::string& list) const {
        std::string out;
        for (std::size_t at = 0, next = 0; next != std::string::npos; at = next + 2) {
            next = list.find(", ", at);
            std::string part = list.substr(at, next == std::string::npos ? next : next - at);
            for (const std::string door : {"run:", "serve:"}) {
                if (part.starts_with(door)) {
                    part = serves_ == (door == "serve:") ? part.substr(door.size()) : "";
                }
            }
            out += (part.empty() || out.empty() ? "" : ", ") + part;
        }
        return out;
    }
    void order(const std::string& word, Words& words) {
        INFO("refused: " << refused_);
        REQUIRE(refused_.empty());
        const std::uint64_t begins_us = world_.clock.now_us();
        try {
            commands_.at(word)(words);
        } catch (const OutputError& error) {
            refused_ = error.what();
        }
        took_us_ = world_.clock.now_us() - begins_us;
    }

    LiveMachine& machine() {
        if (!machine_) {
            LiveMachine::Settings settings{.segment_ticks = 8000, .told = told_, .clock = &world_.clock};
            settings.signals = serves_ ? nullptr : &signals_;
            settings.state = state_ ? &*state_ : nullptr;
            machine_ = std::make_unique<LiveMachine>(target_, description_, settings,
                                                     [this] { return world_.outputs(); });
        }
        return *machine_;
    }
    void submit(double to, std::int64_t velocity = 0) {
        FeedSegment segment = segment_between(at_mm_, to);
        segment.end_velocity[0] = velocity;
        refused_ = machine().submit(segment, line_, moves_) ? "" : "it is over";
        at_mm_ = to;
    }
    /// "1 2 @10 3": from 1 to 2, and on line 10 to 3.
    void move(Words& words) {
        std::string word;
        for (bool first = true; words >> word && refused_.empty();) {
            if (word[0] == '@') {
                line_ = std::stoul(word.substr(1));
                ++moves_;
            } else if (std::exchange(first, false)) {
                at_mm_ = std::stod(word);
            } else {
                submit(std::stod(word));
            }
        }
    }
    /// A kind of event, and what it has of a number, a wait and a time-out.
    void event(Words& words, bool standing) {
        static const std::map<std::string, InputWait> waits{{"high", InputWait::high}, {"low", InputWait::low}};
        std::string kind;
        std::string wait;
        words >> kind;
        ProgramEvent event{.kind = kind_of(kind), .number = number_of(words)};
        event.wait = words >> wait ? waits.at(wait) : InputWait::now;
        const bool turns = kind.starts_with("spindle");
        const int value = turns ? event.number : number_of(words);
        event.value = Decimal::from_integer(value);
        if (serves_ && !standing) {
            machine().obey(event);
            return;
        }
        ProgramAction action{.kind = event.kind, .number = event.number, .value = 1.0 * value, .text = {}};
        action.wait = event.wait;
        if (turns) {
            action.spindle = SpindleTurn{1, action.value};
        }
        machine().order(action, standing);
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
    void keep(Words& words) {
        MachineState state;
        for (unsigned k = 0; k < axes_.size(); ++k) {
            state.position_mm[k] = number_of(words);
        }
        std::string folder;
        file_ = words >> folder ? folder : folder_.file("s.json");
        if (folder.empty()) {
            write_state_file(file_, axes_, state);
        }
        state_.emplace(file_, axes_, state);
    }

    std::string shows() {
        static const std::map<Alarm, std::string> alarms{{Alarm::none, ""},
                                                         {Alarm::limit_switch, "limit"},
                                                         {Alarm::emergency_stop, "e-stop"},
                                                         {Alarm::spindle_speed, "spindle"},
                                                         {Alarm::drive_fault, "drive"},
                                                         {Alarm::stopped_in_motion, "stopped"}};
        static const std::array homing{"", "homing", "homed", "not homed"};
        std::string out;
        const auto add = [&out](bool is, const std::string& what) {
            out += is && !what.empty() ? (out.empty() ? "" : ", ") + what : "";
        };
        const MachineReading reading = machine().read();
        add(machine().over(), "over");
        add(!machine().carried_out(), "waits");
        add(machine().hold_asked(), "asks for a hold");
        add(serves_ && !reading.stands, reading.executes ? fmt::format("in move {}", reading.waypoint) : "busy");
        add(serves_ && !reading.known, "unknown");
        add(true, homing[static_cast<std::size_t>(reading.homing)]);
        add(!reading.note.empty(), "note: " + std::string(reading.note));
        add(reading.alarm != Alarm::none,
            alarms.at(reading.alarm) + " alarm: " + std::string(reading.alarm_sentence));
        return out;
    }
    std::string places() {
        std::string out;
        for (const RunTarget::AxisPlace& at : machine().places()) {
            out += (out.empty() ? "" : " ") + text_of(at.mm) + (at.online ? "" : "?");
        }
        return out;
    }
    std::string kept() {
        const MachineState state = read_state_file(file_, axes_).value();
        std::string out;
        for (unsigned k = 0; k < axes_.size(); ++k) {
            out += (out.empty() ? "" : " ") + text_of(state.position_mm[k]);
        }
        return out + (state.unknown_why.empty() ? "" : " ") + state.unknown_why;
    }

    bool serves_;
    TalkingWorld world_;
    SignalWatch signals_{{}};
    MachineDescription description_ = talking_machine();
    TalkingTarget target_{world_};
    const std::vector<std::string> axes_{"x", "y", "z"};
    TemporaryFolder folder_;
    std::string file_;
    std::optional<StateKeeper> state_;
    std::uint32_t told_ = 0;
    std::unique_ptr<LiveMachine> machine_;
    double at_mm_ = 0.0;
    std::uint64_t line_ = 0;
    std::uint64_t moves_ = 0;
    int ahead_ = 0;
    std::uint64_t took_us_ = 0;
    std::string refused_;

    const std::map<std::string, std::function<void(Words&)>> commands_{
        {"is", [this](Words& words) {
             std::string fact;
             words >> fact;
             world_.set(fact, rest_of(words));
         }},
        {"not", [this](Words& words) { world_.clear(rest_of(words)); }},
        {"known", [this](Words& words) { told_ = static_cast<std::uint32_t>(number_of(words)); }},
        {"state", [this](Words& words) { keep(words); }},
        {"at-renewal", [this](Words& words) {
             world_.renewal = [this, step = rest_of(words)] { tell(step, true); };
         }},
        {"begin", [this](Words&) { machine(); }},
        {"move", [this](Words& words) { move(words); }},
        {"glide", [this](Words& words) { submit(number_of(words), 1); }},
        {"fill", [this](Words&) {
             for (ahead_ = 0; machine().has_room(); ++ahead_) {
                 submit(at_mm_ + 1);
             }
         }},
        {"rest", [this](Words&) { machine().rest(); }},
        {"stop", [this](Words& words) { machine().stop(rest_of(words)); }},
        {"leave", [this](Words&) { machine_.reset(); }},
        {"order", [this](Words& words) { event(words, false); }},
        {"stand", [this](Words& words) { event(words, true); }},
        {"signal", [](Words&) { signal({SIGINT}); }},
        {"signals", [](Words&) { signal({SIGTERM, SIGHUP}); }},
        {"halt", [this](Words&) { static_cast<void>(machine().halt()); }},
        {"quick-stop", [this](Words&) { machine().quick_stop(); }},
        {"home", [this](Words& words) { machine().home(static_cast<std::uint32_t>(number_of(words))); }},
        {"forget", [this](Words&) { machine().forget_input(); }},
        {"off", [this](Words&) { machine().enable(false); }},
        {"on", [this](Words&) { machine().enable(true); }},
        {"reset", [this](Words&) { machine().reset_faults(); }},
        {"wait", [this](Words& words) { world_.clock.sleep_us(us_per_ms * static_cast<unsigned>(number_of(words))); }},
    };
    const std::map<std::string, std::function<std::string()>> questions_{
        {"told", [this] { return world_.take_told(); }},
        {"refused", [this] { return std::exchange(refused_, {}); }},
        {"shows", [this] { return shows(); }},
        {"places", [this] { return places(); }},
        {"at", [this] { return fmt::format("{} {}", machine().reached().line, machine().reached().moves); }},
        {"input", [this] { return std::to_string(machine().input()); }},
        {"spindle", [this] { return std::string(machine().spindle_stands() ? "stands" : "turns"); }},
        {"ahead", [this] { return std::to_string(ahead_); }},
        {"took", [this] { return std::to_string(took_us_ / us_per_ms); }},
        {"says", [this] {
             const std::uint64_t begins_us = world_.clock.now_us();
             const std::string out = machine().finish();
             took_us_ = world_.clock.now_us() - begins_us;
             return out;
         }},
        {"where", [this] { return machine().where(); }},
        {"kept", [this] { return kept(); }},
    };
};

} // namespace

TEST_CASE("stories of a machine in motion", "[live]") {
    for (const Story& story : read_stories()) {
        for (const bool serves : {false, true}) {
            if (story.door != (serves ? "run" : "serve")) {
                DYNAMIC_SECTION((serves ? "serve: " : "run: ") << story.name) {
                    Teller teller(serves);
                    for (const Step& step : story.steps) {
                        INFO("stories.txt:" << step.line << ": " << step.text);
                        teller.tell(step.text, step.at_once);
                    }
                    teller.end();
                }
            }
        }
    }
}
