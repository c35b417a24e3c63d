// SPDX-License-Identifier: MIT
//
// The stories of stories.txt, told to a LiveMachine in virtual time: to that of a run, and to one that is served.
#include "host/temporary_folder.hpp"
#include "host_sim/base/output_file.hpp"
#include "live/talking_target.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

#include <csignal>
#include <filesystem>
#include <fnmatch.h>
#include <thread>
#include <unistd.h>

using namespace splinefeed_test;

namespace {

struct Step {
    int line = 0;
    bool at_once = false;
    std::string text{};
};

struct Story {
    std::string door;
    std::string name;
    std::vector<Step> steps{};
};

std::vector<Story> read_stories() {
    std::vector<Story> out;
    std::ifstream in(splinefeed::test::source_folder() + "/tests/live/stories.txt");
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        const std::size_t colon = line.find(": ");
        if (colon != std::string::npos && line[0] != ' ' && line[0] != '#') {
            out.push_back({line.substr(0, colon), line.substr(colon + 2)});
        }
        std::istringstream words(line[0] == ' ' ? "|" + line : "");
        for (std::string word; words >> word;) {
            if (word == "|" || word == "+") {
                out.back().steps.push_back({number, word == "+"});
            } else {
                std::string& text = out.back().steps.back().text;
                text += (text.empty() ? "" : " ") + word;
            }
        }
    }
    return out;
}

std::string text_of(const std::optional<double>& mm) {
    return mm ? fmt::format("{:g}", *mm) : "-";
}

void add(std::string& list, const std::string& what, const char* between = ", ") {
    list += (list.empty() || what.empty() ? "" : between) + what;
}

/// Its machine begins with the first step that is no fact.
class Teller {
public:
    explicit Teller(bool serves) : serves_(serves) {}

    void tell(const Step& step) {
        if (!step.at_once && !step.text.empty()) {
            world_.clock.sleep_us(20 * us_per_ms);
        }
        std::istringstream words(step.text);
        std::string word;
        words >> word >> std::ws;
        std::string rest = step.text.substr(words.eof() ? step.text.size() : static_cast<std::size_t>(words.tellg()));
        if (word == "run:" || word == "serve:") {
            serves_ == (word == "serve:") ? tell({step.line, true, rest}) : void();
            return;
        }
        const std::uint64_t begins_us = world_.clock.now_us();
        if (const std::optional<std::string> answer = answer_to(word)) {
            rest = of_door(rest);
            INFO("expected: " << rest << "\n  got:      " << *answer);
            REQUIRE(fnmatch(rest.c_str(), answer->c_str(), 0) == 0);
        } else if (!word.empty()) {
            INFO("refused: " << refused_);
            REQUIRE(refused_.empty());
            try {
                order(word, words, rest);
            } catch (const OutputError& error) {
                refused_ = error.what();
            }
        }
        took_us_ = world_.clock.now_us() - begins_us;
    }
    /// Nothing is left, but the end of a machine that is served.
    void end() {
        machine_.reset();
        const std::string told = world_.take_told();
        INFO("told: " << told << ", refused: " << refused_ << ", nobody has asked for: " << world_.unasked());
        REQUIRE((told.empty() || (serves_ && (told == "close" || told.ends_with("finish, close")))));
        REQUIRE((refused_ + world_.unasked()).empty());
    }

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
    void order(const std::string& word, std::istringstream& words, const std::string& rest) {
        const auto number = [&rest] {
            return std::stoi(rest);
        };
        word == "is"           ? world_.set(rest)
        : word == "not"        ? world_.clear(rest)
        : word == "begin"      ? void(machine())
        : word == "move"       ? move(words)
        : word == "glide"      ? submit(number(), 1)
        : word == "fill"       ? fill()
        : word == "rest"       ? machine().rest()
        : word == "stop"       ? machine().stop(rest)
        : word == "leave"      ? machine_.reset()
        : word == "order"      ? event(words, false)
        : word == "stand"      ? event(words, true)
        : word == "at-renewal" ? world_.at_renewal([this, rest] {
              tell({0, true, rest});
          })
        : word == "signal"     ? signal({SIGINT})
        : word == "signals"    ? signal({SIGTERM, SIGHUP})
        : word == "halt"       ? void(machine().halt())
        : word == "quick-stop" ? machine().quick_stop()
        : word == "home"       ? machine().home(static_cast<std::uint32_t>(number()))
        : word == "forget"     ? machine().forget_input()
        : word == "off"        ? machine().enable(false)
        : word == "on"         ? machine().enable(true)
        : word == "reset"      ? machine().reset_faults()
        : word == "wait"       ? world_.clock.sleep_us(us_per_ms * static_cast<std::uint64_t>(number()))
                               : throw std::invalid_argument(word);
    }
    [[nodiscard]] std::optional<std::string> answer_to(const std::string& word) {
        return word == "told"      ? std::optional(world_.take_told())
               : word == "shows"   ? shows()
               : word == "says"    ? machine().finish()
               : word == "where"   ? machine().where()
               : word == "places"  ? places()
               : word == "kept"    ? kept()
               : word == "refused" ? std::exchange(refused_, {})
               : word == "at"      ? fmt::format("{} {}", machine().reached().line, machine().reached().moves)
               : word == "input"   ? std::to_string(machine().input())
               : word == "spindle" ? machine().spindle_stands() ? "stands" : "turns"
               : word == "ahead"   ? std::to_string(machine().submitted())
               : word == "took"    ? std::optional(std::to_string(took_us_ / us_per_ms))
                                   : std::nullopt;
    }

    LiveMachine& machine() {
        if (!machine_) {
            LiveMachine::Settings settings{.segment_ticks = 8000, .clock = &world_.clock};
            settings.told = static_cast<std::uint32_t>(world_.number("told", 0));
            settings.signals = serves_ ? nullptr : &signals_;
            settings.state = world_.is("state") ? keeper() : nullptr;
            machine_ =
                std::make_unique<LiveMachine>(target_, description_, settings, [this] { return world_.outputs(); });
        }
        return *machine_;
    }
    /// Of a file that says 1 2 3, or that cannot be: what the fact says.
    StateKeeper* keeper() {
        const MachineState begins{.offsets = {}, .position_mm = {1.0, 2.0, 3.0}};
        const bool lost = !world_.text("state").empty(); // its folder is
        std::filesystem::create_directory(folder_.file("kept"));
        file_ = folder_.file("kept/s.json");
        write_state_file(file_, {axes_}, begins);
        state_file_.emplace(file_, StateOwner{axes_});
        if (lost) {
            std::filesystem::remove_all(folder_.file("kept"));
        }
        return &state_.emplace(*state_file_, begins);
    }
    void submit(double to, std::int64_t velocity = 0) {
        FeedSegment segment = segment_between(at_mm_, to);
        segment.end_velocity[0] = velocity;
        refused_ = machine().submit(segment, line_, moves_) ? "" : "it is over";
        at_mm_ = to;
    }
    void move(std::istringstream& words) {
        std::string word;
        words >> at_mm_;
        while (words >> word && refused_.empty()) {
            const bool labels = word[0] == '@';
            line_ = labels ? std::stoul(word.substr(1)) : line_;
            moves_ += labels ? 1 : 0;
            labels ? void() : submit(std::stod(word));
        }
    }
    void fill() {
        while (machine().has_room()) {
            submit(at_mm_ + 1);
        }
    }
    void event(std::istringstream& words, bool standing) {
        std::string name;
        std::string wait;
        ProgramEvent event;
        std::int32_t value = 0;
        words >> name >> event.number >> wait >> value;
        for (int kind = 0; name != action_name(event.kind); ++kind) {
            REQUIRE(event.kind != EventKind::offsets_changed); // the last one
            event.kind = static_cast<EventKind>(kind);
        }
        event.wait = wait == "high" ? InputWait::high : wait == "low" ? InputWait::low : InputWait::now;
        const bool turns = event.kind == EventKind::spindle_clockwise;
        value = turns ? event.number : value;
        event.value = Decimal::from_integer(value);
        ProgramAction action{event.kind, event.number, 1.0 * value, {}, {}, event.wait};
        action.spindle = turns ? std::optional(SpindleTurn{1, action.value}) : std::nullopt;
        standing ? machine().order(action, true) : machine().obey(event);
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
    std::string kept() {
        const MachineState state = read_state_file(file_, axes_).value();
        std::string out;
        for (unsigned k = 0; k < axes_.size(); ++k) {
            add(out, text_of(state.position_mm[k]), " ");
        }
        add(out, state.unknown_why, " ");
        return out;
    }

    bool serves_;
    TalkingWorld world_;
    SignalWatch signals_{{}};
    MachineDescription description_ = talking_machine();
    TalkingTarget target_{world_};
    const std::vector<std::string> axes_{"x", "y", "z"};
    TemporaryFolder folder_;
    std::string file_;
    std::optional<StateFile> state_file_;
    std::optional<StateKeeper> state_;
    std::unique_ptr<LiveMachine> machine_;
    double at_mm_ = 0.0;
    std::uint64_t line_ = 0;
    std::uint64_t moves_ = 0;
    std::uint64_t took_us_ = 0;
    std::string refused_;
};

} // namespace

TEST_CASE("stories of a machine in motion", "[live]") {
    for (const Story& story : read_stories()) {
        for (const bool serves : {false, true}) {
            if (story.door == (serves ? "run" : "serve")) {
                continue;
            }
            DYNAMIC_SECTION((serves ? "serve: " : "run: ") << story.name) {
                Teller teller(serves);
                for (const Step& step : story.steps) {
                    INFO("stories.txt:" << step.line << ": " << step.text);
                    teller.tell(step);
                }
                teller.end();
            }
        }
    }
}
