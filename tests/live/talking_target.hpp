// SPDX-License-Identifier: MIT
// TalkingTarget: a target that says what it was told, and its outputs. What they do is what TalkingWorld says of them.
#pragma once

#include "host_sim/live/live_machine.hpp"
#include "support/virtual_clock.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;

/// What is true of a target and its outputs, and what they were told. One virtual thread runs at a time: no locks.
class TalkingWorld {
public:
    TalkingWorld(std::initializer_list<const char*> facts = {}) {
        std::ranges::for_each(facts, [this](const char* fact) { set(fact); });
    }
    /// "FACT VALUE"
    void set(const std::string& text) {
        const std::size_t space = std::min(text.find(' '), text.size());
        const std::string fact = text.substr(0, space);
        is(fact) ? void() : void(unasked_.insert(fact));
        facts_[fact] = space == text.size() ? "" : text.substr(space + 1);
    }
    void clear(const std::string& fact) { facts_.erase(fact); }
    [[nodiscard]] bool is(const std::string& fact) const { return unasked_.erase(fact), facts_.contains(fact); }
    [[nodiscard]] std::string text(const std::string& fact) const { return is(fact) ? facts_.at(fact) : ""; }
    [[nodiscard]] int number(const std::string& fact, int otherwise) const {
        return is(fact) ? std::stoi(facts_.at(fact)) : otherwise;
    }
    /// A fact that nothing has asked for, as one that is misspelled.
    [[nodiscard]] std::string unasked() const { return unasked_.empty() ? "" : *unasked_.begin(); }
    void say(const std::string& what) { told_ += (told_.empty() ? "" : ", ") + what; }
    /// What they were told since the last call.
    [[nodiscard]] std::string take_told() { return std::exchange(told_, {}); }
    void at_renewal(std::function<void()> what) { renewal_ = std::move(what); }
    void renew() const { renewal_ ? renewal_() : void(); }
    [[nodiscard]] std::unique_ptr<ProgramOutputs> outputs();

    VirtualClock clock;

private:
    std::map<std::string, std::string> facts_;
    mutable std::set<std::string> unasked_;
    std::string told_;
    std::function<void()> renewal_;
};

/// A part of the world.
class Talking {
protected:
    explicit Talking(TalkingWorld& world) : world_(&world) {}
    TalkingWorld* world_;
};

class TalkingTarget final : public RunTarget, public hal::MotionPort, Talking {
public:
    static constexpr double steps = 100.0;

    explicit TalkingTarget(TalkingWorld& world) : Talking(world) {}

    [[nodiscard]] TargetFacts facts() const override {
        TargetFacts out{.has_feedback = !world_->is("blind"), .halts = !world_->is("brakes"), .homes_with = {1, 2, 4}};
        out.switches = {.homes = static_cast<std::uint32_t>(world_->number("homes", 7)), .no_home = {}};
        return out;
    }
    void check(const MachineDescription& /*machine*/, double segment_us) const override {
        if (world_->is("slow")) {
            throw UsageError("its registers do not hold that in {:g} us", segment_us);
        }
    }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] Signs signs() override {
        throw_where("breaks");
        return {.holds = world_->text("holds"),
                .achieved = world_->is("achieves"),
                .stop = {static_cast<Alarm>(world_->number("cause", 0)), "it says so"}};
    }
    [[nodiscard]] std::string halted(bool quick) const override { return quick ? "stopped" : "held"; }
    [[nodiscard]] std::string leave(bool off) override {
        if (off) {
            power_off();
            return {};
        }
        world_->say("finish");
        return world_->text("unfinished");
    }
    [[nodiscard]] std::vector<AxisPlace> places() const override {
        throw_where("blows");
        return moved_                 ? places_but(0)
               : world_->is("unsure") ? places_but(world_->number("unsure", 0))
                                      : std::vector<AxisPlace>{};
    }
    [[nodiscard]] std::vector<AxisPlace> standing() override { return places_but(world_->number("unsure", 0)); }
    [[nodiscard]] std::string where() const override { return "; there"; }
    void describe(Summary& /*summary*/) const override {}

    [[nodiscard]] hal::PortFailure open() override {
        world_->say("open");
        return {world_->text("absent")};
    }
    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& first) override {
        const std::string homes = orders().home ? fmt::format(" homing {}", orders().home_axes) : "";
        world_->say("prepare at " + x_of(first.start) + homes + (orders().reset ? " resetting" : ""));
        orders().reset ? world_->clear("fault") : void();
        while (world_->is(orders().home ? "searching" : "preparing") && !LiveMachine::gives_up()) {
            world_->clock.sleep_us(us_per_ms);
        }
        if (LiveMachine::gives_up()) {
            world_->set("unsure 7");
            moved_ = false;
            return {"interrupted"};
        }
        mm_ = mm(first.start);
        moved_ = !world_->is("refuses");
        phase_ = hal::PortPhase::running;
        return {world_->text("refuses")};
    }
    [[nodiscard]] hal::PortFailure renew(const FeedSegment& first) override {
        world_->say("renew at " + x_of(first.start));
        world_->renew();
        phase_ = hal::PortPhase::running;
        complete_ = false;
        return {world_->text("unready")};
    }
    [[nodiscard]] int room() const noexcept override {
        return phase_ == hal::PortPhase::running && !world_->is("fault") && !world_->is("full") ? 1 : 0;
    }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override {
        world_->is("mute") ? void() : world_->say(x_of(segment.start) + " to " + x_of(segment.end));
        waiting_.push_back(segment);
        return true;
    }
    void complete() noexcept override {
        world_->say("complete");
        complete_ = true;
    }
    hal::PortState poll() noexcept override {
        int left = world_->number("executes", INT32_MAX);
        for (; left > 0 && !waiting_.empty() && phase_ == hal::PortPhase::running; waiting_.pop_front(), --left) {
            mm_ = mm(waiting_.front().end);
            ++executed_;
        }
        world_->is("executes") ? world_->set("executes " + std::to_string(left)) : void();
        const bool done = complete_ && waiting_.empty() && phase_ == hal::PortPhase::running;
        return {world_->is("fault") ? hal::PortPhase::fault : done ? hal::PortPhase::idle : phase_, executed_};
    }
    void halt() noexcept override { stop("halt", !world_->is("deaf")); }
    void quick_stop() noexcept override { stop("quick stop", world_->text("deaf") != "all"); }
    void power_off() noexcept override { world_->say("power off"); }
    void close() noexcept override { world_->say("close"); }
    [[nodiscard]] hal::PortFailure failure() const override { return {world_->text("fault")}; }

private:
    static double mm(const PerAxis<std::int64_t>& place) {
        return static_cast<double>(place[0]) / (steps * static_cast<double>(units_per_count));
    }
    static std::string x_of(const PerAxis<std::int64_t>& place) { return fmt::format("{:g}", mm(place)); }
    void throw_where(const std::string& fact) const {
        if (world_->is(fact)) {
            throw std::runtime_error(world_->text(fact));
        }
    }
    [[nodiscard]] std::vector<AxisPlace> places_but(int unknown) const {
        std::vector<AxisPlace> out;
        for (unsigned k = 0; k < 3; ++k) {
            const bool known = (unknown >> k & 1) == 0;
            const bool online = (world_->number("lost", 0) >> k & 1) == 0;
            out.push_back({k, known ? std::optional(k == 0 ? mm_ : 0.0) : std::nullopt, online});
        }
        return out;
    }
    void stop(const char* what, bool obeys) noexcept {
        world_->say(what);
        if (obeys) {
            waiting_.clear();
            phase_ = hal::PortPhase::halted;
        }
    }

    std::deque<FeedSegment> waiting_;
    hal::PortPhase phase_ = hal::PortPhase::running;
    std::uint64_t executed_ = 1000; // on its way to the references
    double mm_ = 0.0;
    bool moved_ = false;
    bool complete_ = false;
};

class TalkingSpindle final : public OutputPart, Talking {
public:
    explicit TalkingSpindle(TalkingWorld& world) : Talking(world) {}
    void act(const ProgramAction& action) override {
        if (action.spindle) {
            world_->say(fmt::format("spindle {} {:g}", action.spindle->direction, action.spindle->rpm));
        }
    }
    void end() noexcept override { std::exchange(ended_, true) ? void() : world_->say("spindle ends"); }
    [[nodiscard]] Progress progress() const override {
        return {.carried_out = !ended_ && !world_->is("slow") && !world_->is("silent"),
                .stands = !world_->is("turning"),
                .stop_timeout_s = static_cast<double>(world_->number("stop_s", 0))};
    }
    [[nodiscard]] std::string trouble() const override { return world_->text("silent"); }

private:
    bool ended_ = false;
};

class TalkingSwitches final : public OutputPart, Talking {
public:
    explicit TalkingSwitches(TalkingWorld& world) : Talking(world) {}
    void act(const ProgramAction& action) override {
        if (!action.spindle && ProgramOutputs::is_of(action)) {
            world_->say(fmt::format("{} {}", action_name(action.kind), action.number));
        }
    }
    void end() noexcept override { std::exchange(ended_, true) ? void() : world_->say("switches end"); }
    [[nodiscard]] std::string trouble() const override { return world_->text("severed"); }
    [[nodiscard]] std::string unconfirmed() const override { return world_->is("hangs") ? "output 3" : ""; }

private:
    bool ended_ = false;
};

/// Input 4 alone; it has a level, or none is read.
class TalkingInputs final : public OutputPart, Talking {
public:
    explicit TalkingInputs(TalkingWorld& world) : Talking(world) {}
    void act(const ProgramAction& action) override {
        if (action.kind == EventKind::input_wait) {
            world_->say(action.number >= 0 ? fmt::format("watch {}", action.number) : "unwatch");
        }
    }
    [[nodiscard]] std::optional<InputReading> take() override {
        return world_->is("level") ? std::optional(InputReading{world_->text("level") == "1", world_->clock.now_us()})
                                   : std::nullopt;
    }
    [[nodiscard]] std::string trouble() const override { return world_->text("unread"); }
};

inline std::unique_ptr<ProgramOutputs> TalkingWorld::outputs() {
    if (!is("outputs")) {
        return nullptr;
    }
    say("connect");
    if (is("unreachable")) {
        throw TargetError(text("unreachable"));
    }
    OutputParts parts;
    const auto add = [&]<class Part>(const char* name, std::type_identity<Part>) {
        if (text("outputs").find(name) != std::string::npos) {
            parts.push_back(std::make_shared<Part>(*this));
        }
    };
    add("spindle", std::type_identity<TalkingSpindle>());
    add("switches", std::type_identity<TalkingSwitches>());
    add("inputs", std::type_identity<TalkingInputs>());
    return std::make_unique<ProgramOutputs>(std::move(parts), clock);
}

inline MachineDescription talking_machine() {
    MachineDescription out;
    out.settings.axes = 3;
    for (unsigned k = 0; k < 3; ++k) {
        out.settings.axis[k] = {100.0, 1000.0, 0.0, TalkingTarget::steps};
        out.axis_name[k] = std::string(1, "xyz"[k]);
    }
    return out;
}

/// A millisecond from x to x, which ends at rest. [mm]
inline FeedSegment segment_between(double from, double to) {
    FeedSegment out{.duration_ticks = 8000};
    out.start[0] = std::llround(from * TalkingTarget::steps * static_cast<double>(units_per_count));
    out.end[0] = std::llround(to * TalkingTarget::steps * static_cast<double>(units_per_count));
    return out;
}

} // namespace splinefeed_test
