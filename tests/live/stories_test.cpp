// SPDX-License-Identifier: MIT
//
// The stories of stories.txt on a target that says what it was told, those of shaft_stories.txt on the simulated
// machine.
#include "host/temporary_folder.hpp"
#include "live/shaft_teller.hpp"
#include "live/sim_world.hpp"
#include "live/talking_target.hpp"
#include "live/teller.hpp"
#include "support/catch.hpp"

#include <filesystem>

using namespace splinefeed_test;

namespace {

class TalkingTeller final : public Teller {
public:
    TalkingTeller(TalkingWorld& world, bool serves) : Teller(world.clock, serves), world_(world) {}

    void end() override {
        leave();
        const std::string told = world_.take_told();
        INFO("told: " << told << ", refused: " << refused_ << ", nobody has asked for: " << world_.unasked());
        REQUIRE((told.empty() || (serves() && (told == "close" || told.ends_with("finish, close")))));
        REQUIRE((refused_ + world_.unasked()).empty());
    }

protected:
    void leave() override { machine_.reset(); }
    void order(const std::string& word, std::istringstream& words, const std::string& rest) override {
        word == "is"           ? world_.set(rest)
        : word == "not"        ? world_.clear(rest)
        : word == "move"       ? move(words)
        : word == "glide"      ? submit(std::stoi(rest), 1)
        : word == "fill"       ? fill()
        : word == "order"      ? event(words, false)
        : word == "stand"      ? event(words, true)
        : word == "at-renewal" ? world_.at_renewal([this, rest] {
              tell({"", true, rest});
          })
                               : Teller::order(word, words, rest);
    }
    [[nodiscard]] std::optional<std::string> answer_to(const std::string& word, const std::string& rest) override {
        return word == "told"      ? std::optional(world_.take_told())
               : word == "kept"    ? kept()
               : word == "at"      ? fmt::format("{} {}", machine().reached().line, machine().reached().moves)
               : word == "input"   ? std::to_string(machine().input())
               : word == "spindle" ? machine().spindle_stands() ? "stands" : "turns"
               : word == "ahead"   ? std::to_string(machine().submitted())
                                   : Teller::answer_to(word, rest);
    }
    LiveMachine& machine() override {
        if (!machine_) {
            LiveMachine::Settings settings{.segment_ticks = 8000, .signals = signals(), .clock = &world_.clock};
            settings.told = static_cast<std::uint32_t>(world_.number("told", 0));
            settings.state = world_.is("state") ? keeper() : nullptr;
            machine_ =
                std::make_unique<LiveMachine>(target_, description_, settings, [this] { return world_.outputs(); });
        }
        return *machine_;
    }

private:
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
    std::string kept() {
        const MachineState state = read_state_file(file_, axes_).value();
        std::string out;
        for (unsigned k = 0; k < axes_.size(); ++k) {
            add(out, text_of(state.position_mm[k]), " ");
        }
        add(out, state.unknown_why, " ");
        return out;
    }

    TalkingWorld& world_;
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
};

} // namespace

TEST_CASE("stories of a machine in motion", "[live]") {
    std::optional<TalkingWorld> world;
    tell_stories({"talking"}, [&](bool serves, int /*round*/) {
        world.emplace();
        return std::make_unique<TalkingTeller>(*world, serves);
    });
}

TEST_CASE("stories of the simulated machine", "[live]") {
    tell_stories_of<SimWorld>({"sim"}, 1);
}
