// SPDX-License-Identifier: MIT
// ShaftTeller: tells stories to targets whose axes have shafts: to a run of straight moves, and to a machine that
// senders operate.
#pragma once

#include "live/operated.hpp"
#include "live/teller.hpp"
#include "support/random_path.hpp"

#include "splinefeed/hal/motion/straight_motion.hpp"

#include <deque>

namespace splinefeed_test {

class ShaftTeller final : public Teller {
public:
    ShaftTeller(std::unique_ptr<ShaftWorld> world, bool serves, int round)
        : Teller(world->clock, serves), world_(std::move(world)), round_(round),
          dice_(static_cast<std::uint64_t>(4711 + round)) {}

    void end() override {
        leave();
        const std::uint64_t ended_us = world_->clock.now_us();
        wait(300);
        INFO("it moved " << world_->moved_us() - ended_us << " us behind its end; refused: " << refused_);
        REQUIRE((!begun_ || world_->moved_us() <= ended_us));
        REQUIRE(refused_.empty());
    }

protected:
    void leave() override {
        gone_ = true;
        live_.reset();
        operated_.reset();
    }
    void wait(int ms) override {
        for (; ms > 0; --ms) {
            tick();
        }
    }
    /// {low,high} is a number between; of {this|that} each round takes the next one.
    [[nodiscard]] std::string thrown(std::string text) override {
        for (std::size_t end = 0; !text.starts_with("mess") && (end = text.find('}')) != std::string::npos;) {
            const std::size_t at = text.rfind('{', end);
            const std::string inner = text.substr(at + 1, end - at - 1);
            text.replace(at, end + 1 - at, inner.find('|') != std::string::npos ? choice(inner) : number(inner));
        }
        return text;
    }
    void order(const std::string& word, std::istringstream& words, const std::string& rest) override {
        if (word != "wait" && word != "until") {
            asked_us_ = world_->clock.now_us();
            asked_mm_ = begun_ ? at() : PerAxis<double>{};
        }
        word == "is"       ? world_->set(rest.substr(0, rest.find(' ')), behind_space(rest))
        : word == "not"    ? world_->clear(rest)
        : word == "go"     ? go(rest, "G90G53G1")
        : word == "jog"    ? go(rest, "$J=G90")
        : word == "send"   ? operated().send(bytes_of(rest))
        : word == "hold"   ? serves() ? operated().send("!") : signal({SIGINT})
          : word == "stop" ? serves() ? operated().send("\x18") : signal({SIGINT})
          : word == "closed" ? operated().controller.disconnect()
        : word == "open"   ? operated().controller.connect()
        : word == "stall"  ? stall(std::stod(rest))
        : word == "rest"   ? void(ends_ = true)
        : word == "until"  ? until(rest)
        : word == "mess"   ? mess(rest)
        : word == "wait"   ? wait(static_cast<int>(std::stod(rest)))
                           : Teller::order(word, words, rest);
    }
    [[nodiscard]] std::optional<std::string> answer_to(const std::string& word, const std::string& rest) override {
        word == "is" || word == "not" ? void() : begin();
        return word == "stands"          ? std::optional(stands(rest.substr(0, rest.find(' '))))
               : word == "still"         ? still(std::stoul(rest))
               : word == "says"          ? std::optional(says())
               : word == "shafts"        ? shafts({})
               : word == "moved"         ? shafts(asked_mm_)
               : word == "reads"         ? reads()
               : word == "hears"         ? hears(rest)
               : word == "heard"         ? std::exchange(operated().text, {})
               : word == "drives"        ? world_->powered() ? "on" : "off"
               : world_->answer_to(word) ? world_->answer_to(word)
                                         : Teller::answer_to(word, rest);
    }
    LiveMachine& machine() override {
        begin();
        return serves() ? operated_->live : *live_;
    }

private:
    void begin() {
        if (std::exchange(begun_, true)) {
            return;
        }
        const host::MachineDescription& machine = world_->machine().machine;
        if (serves()) {
            operated_ = std::make_unique<Operated>(*world_);
        } else {
            live_ = std::make_unique<LiveMachine>(world_->target(), machine,
                                                  LiveMachine::Settings{.segment_ticks = static_cast<std::uint32_t>(
                                                                            8 * machine.settings.sample_period_us),
                                                                        .signals = signals(),
                                                                        .clock = &world_->clock},
                                                  [this] { return world_->outputs(); });
        }
        way_ = {at()};
        tick();
        if (serves() && world_->told() != 0 && operated_->controller.state() == ControllerState::alarm) {
            operated_->send("$X\n"); // its drives have never been told where they stand
            wait(20);
            operated_->text.clear();
        }
    }
    Operated& operated() {
        begin();
        REQUIRE(operated_ != nullptr);
        return *operated_;
    }
    /// A millisecond.
    void tick() {
        if (operated_) {
            operated_->tick();
        } else {
            world_->clock.sleep_us(us_per_ms);
            gone_ ? void() : feed();
        }
        begun_ ? world_->look() : void();
    }
    /// Of a run: as much of its moves as there is room for.
    void feed() {
        FeedSegment segment;
        while (live_ && !live_->over() && (motion_ || !moves_.empty()) && live_->has_room()) {
            if (!motion_) {
                motion_.emplace(world_->machine().machine.settings, end_, moves_.front(), feed_mm_s);
                end_ = moves_.front();
                moves_.pop_front();
            }
            if (live_->hold_asked()) {
                moves_.clear();
                motion_->hold();
            }
            if (motion_->next(segment)) {
                live_->submit(segment);
            } else {
                motion_.reset();
            }
        }
        if (live_ && ends_ && !motion_ && moves_.empty()) {
            live_->rest();
        }
    }
    [[nodiscard]] PerAxis<double> at() { return {world_->mm(0), world_->mm(1), world_->mm(2)}; }
    /// In a straight line.
    void go(const std::string& to, const char* how) {
        std::istringstream words(to);
        PerAxis<double> place{};
        words >> place[0] >> place[1] >> place[2];
        begin();
        if (rests()) {
            way_ = {at()};
        }
        way_.push_back(place);
        if (serves()) {
            operated().send(fmt::format("{}X{:.4f}Y{:.4f}Z{:.4f}F6000\n", how, place[0], place[1], place[2]));
        } else {
            moves_.push_back(place);
        }
    }
    [[nodiscard]] bool rests() const {
        return serves() ? operated_->rests() : live_->over() || (!live_->runs() && !motion_);
    }
    /// The planner does nothing.
    void stall(double ms) {
        world_->clock.sleep_us(static_cast<std::uint64_t>(std::fmod(ms, 1.0) * 1000.0));
        for (; ms >= 1.0; ms -= 1.0) {
            world_->clock.sleep_us(us_per_ms);
            world_->look();
        }
    }
    /// "x 40": it has come there. [mm]
    void until(const std::string& what) {
        const unsigned axis = static_cast<unsigned>(what[0] - 'x');
        const double place = std::stod(what.substr(2));
        const bool below = world_->mm(axis) < place;
        for (int ms = 0; (world_->mm(axis) < place) == below; ++ms) {
            REQUIRE(ms < most_ms);
            tick();
        }
    }
    /// "N STEP / STEP ..": so many of them, as the dice fall.
    void mess(const std::string& what) {
        std::vector<std::string> steps;
        for (std::size_t at = what.find(' ') + 1, next = 0; next != std::string::npos; at = next + 3) {
            next = what.find(" / ", at);
            steps.push_back(what.substr(at, next == std::string::npos ? next : next - at));
        }
        for (int n = std::stoi(what); n > 0; --n) {
            const std::string& step = steps[static_cast<std::size_t>(dice_.below(static_cast<int>(steps.size())))];
            INFO(step);
            tell({"", true, step});
            wait(dice_.below(400));
        }
    }
    static std::string behind_space(const std::string& text) {
        return text.find(' ') == std::string::npos ? "" : text.substr(text.find(' ') + 1);
    }
    /// A line, or bytes that act at once.
    static std::string bytes_of(const std::string& text) {
        std::string out;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const bool hex = text.compare(i, 2, "\\x") == 0;
            out += hex ? static_cast<char>(std::stoi(text.substr(i + 2, 2), nullptr, 16)) : text[i];
            i += hex ? 3 : 0;
        }
        const bool line = text[0] != '\\' && text != "!" && text != "~" && text != "?";
        return line ? out + "\n" : out;
    }
    /// What was said up to now, once that is in it; * stands for any text, and each line ends with a bar.
    std::string hears(const std::string& what) {
        const std::string pattern = "*" + what + "*";
        for (int ms = 0; ms < most_ms && fnmatch(pattern.c_str(), said().c_str(), FNM_EXTMATCH) != 0; ++ms) {
            tick();
        }
        const std::string out = said();
        operated().text.clear();
        return fnmatch(pattern.c_str(), out.c_str(), FNM_EXTMATCH) == 0 ? what : out;
    }
    std::string said() {
        std::string out = operated().text;
        for (std::size_t at = 0; (at = out.find("\r\n")) != std::string::npos;) {
            out.replace(at, 2, ";");
        }
        return out;
    }
    /// How it stands, so many ms behind the last order or fact, if it does by then; "soon" is as the world says.
    std::string stands(const std::string& within) {
        ends_ = true;
        for (int ms = 0; ms < most_ms && !rests(); ++ms) {
            tick();
        }
        std::string out = rests() ? ""
                                  : "not, it " + std::string(state_name(operated().controller.state())) + "," +
                                        Teller::answer_to("shows", "").value() + operated().text + "; ";
        const std::uint64_t moved_us = world_->moved_us();
        const double took_ms =
            static_cast<double>(std::max(moved_us, asked_us_) - asked_us_) / static_cast<double>(us_per_ms);
        const bool in_time = took_ms <= (within == "soon" ? world_->near.stop_ms : std::stod(within));
        out += in_time ? within : fmt::format("behind {} ms", took_ms);
        wait(500);
        out += world_->moved_us() == moved_us ? "" : " and moves on";
        out += on_path();
        std::string unknown;
        for (const RunTarget::AxisPlace& at : machine().places()) {
            INFO("axis " << at.axis << " is told to be at " << at.mm.value_or(0.0) << ", and is at "
                         << world_->mm(at.axis));
            const double off = at.known() ? *at.known() - world_->mm(at.axis) : 0.0;
            CHECK(std::fabs(off) * ShaftWorld::counts_per_mm <= world_->near.told_counts + 1e-6);
            unknown += at.known() ? "" : std::string(" ") + "xyz"[at.axis];
        }
        return out + (unknown.empty() ? "" : ", unknown" + unknown);
    }
    /// Who claims that all were held on the path has held them there.
    std::string says() {
        const std::string& out = machine().finish();
        CHECK((out.find("held on the path") == std::string::npos || on_path() == " on the path"));
        return out;
    }
    std::string still(std::uint64_t for_ms) {
        const std::uint64_t ms = (world_->clock.now_us() - world_->moved_us()) / us_per_ms;
        return fmt::format("{}{}", std::min(ms, for_ms), on_path());
    }
    std::string on_path() {
        return distance_mm() * ShaftWorld::counts_per_mm <= world_->near.path_counts ? " on the path" : " off the path";
    }
    /// What senders are told of the place, known or not.
    std::string reads() {
        const PerAxis<Position> told = machine().read().position;
        double most = 0.0;
        for (unsigned k = 0; k < 3; ++k) {
            most = std::max(most, std::fabs(to_mm(told[k]) - world_->mm(k)) * ShaftWorld::counts_per_mm);
        }
        return most <= 1.0 + 1e-6 ? "true" : fmt::format("{} counts off", most);
    }
    /// From the way.
    double distance_mm() {
        double least = 1e9;
        const PerAxis<double> here = at();
        for (std::size_t i = 0; i < way_.size(); ++i) {
            const PerAxis<double>& from = way_[i == 0 ? 0 : i - 1];
            double along = 0.0;
            double length_sq = 0.0;
            for (unsigned k = 0; k < 3; ++k) {
                along += (here[k] - from[k]) * (way_[i][k] - from[k]);
                length_sq += (way_[i][k] - from[k]) * (way_[i][k] - from[k]);
            }
            const double part = length_sq > 0.0 ? std::clamp(along / length_sq, 0.0, 1.0) : 0.0;
            double off_sq = 0.0;
            for (unsigned k = 0; k < 3; ++k) {
                const double off = here[k] - from[k] - part * (way_[i][k] - from[k]);
                off_sq += off * off;
            }
            least = std::min(least, std::sqrt(off_sq));
        }
        return least;
    }
    /// Seen from there, to a hundredth. [mm]
    std::string shafts(const PerAxis<double>& from) {
        std::string out;
        for (unsigned k = 0; k < 3; ++k) {
            add(out, fmt::format("{:g}", std::round(100.0 * (world_->mm(k) - from[k])) / 100.0 + 0.0), " ");
        }
        return out;
    }
    [[nodiscard]] std::string number(const std::string& range) {
        return fmt::format("{:.4f}", dice_.between(std::stod(range), std::stod(range.substr(range.find(',') + 1))));
    }
    [[nodiscard]] std::string choice(const std::string& of) const {
        std::size_t at = 0;
        for (int n = round_ % (static_cast<int>(std::ranges::count(of, '|')) + 1); n > 0; --n) {
            at = of.find('|', at) + 1;
        }
        return of.substr(at, std::min(of.find('|', at), of.size()) - at);
    }

    static constexpr int most_ms = 20'000;
    static constexpr double feed_mm_s = 100.0;

    std::unique_ptr<ShaftWorld> world_;
    int round_;
    RandomPath dice_;
    bool begun_ = false;
    bool gone_ = false;
    bool ends_ = false;          // no more moves come
    std::uint64_t asked_us_ = 0; // the last order or fact came, and
    PerAxis<double> asked_mm_{}; // where the shafts were then
    std::vector<PerAxis<double>> way_{{}};
    // Of a run:
    std::deque<PerAxis<double>> moves_;
    PerAxis<double> end_{};
    std::optional<hal::StraightMotion> motion_;
    std::unique_ptr<LiveMachine> live_;
    std::unique_ptr<Operated> operated_;
};

/// The stories of a world's target.
template <class World, class... Of>
void tell_stories_of(const std::vector<std::string>& target, int share, const Of&... of) {
    const auto make = [&](bool serves, int round) {
        return std::make_unique<ShaftTeller>(std::make_unique<World>(of...), serves, round);
    };
    tell_stories(target, make, share);
}

} // namespace splinefeed_test
