// SPDX-License-Identifier: MIT
// TalkingDrives: a target of a server that says what it was told, its outputs, and a ServedTarget of them.
#pragma once

#include "host_sim/serve/served_target.hpp"

#include "splinefeed/base/units.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;
using Told = std::vector<std::string>;
using Kinds = std::vector<EventKind>;

constexpr double steps = 100.0;

inline void wait_a_bit() {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}
template <class Condition>
bool comes(const Condition& condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
}

/// Executes at once what it has, if it is not frozen.
class TalkingDrives final : public RunTarget, public hal::MotionPort {
public:
    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] bool halts() const noexcept override { return true; }
    void set_ready(const RunOptions& options) override { options_ = options; }
    [[nodiscard]] std::string halted(bool quick) const override { return quick ? "stopped" : "held"; }
    [[nodiscard]] std::string finish() override {
        said("finish");
        return unfinished;
    }
    [[nodiscard]] std::vector<AxisPlace> places() const override { return {{0, mm_}, {1, 0.0}, {2, 0.0}}; }
    [[nodiscard]] std::vector<AxisPlace> standing() override {
        return knows ? places() : std::vector<AxisPlace>{{0, std::nullopt}, {1, std::nullopt}, {2, std::nullopt}};
    }
    [[nodiscard]] std::string where() const override { return {}; }
    void describe(Summary& /*summary*/) const override {}

    [[nodiscard]] hal::PortFailure open() override {
        said("open");
        return {};
    }
    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& first) override {
        said("prepare at " + x_of(first.start) + (options_.home ? fmt::format(", homes {}", options_.home_axes) : "") +
             (options_.reset ? ", resets" : ""));
        faulted = faulted && !options_.reset;
        while (searches && !ServedTarget::gives_up() && (options_.home || waits)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (ServedTarget::gives_up()) {
            knows = searches = false;
            return {"interrupted"};
        }
        phase_ = hal::PortPhase::running;
        mm_ = mm(first.start);
        return {};
    }
    [[nodiscard]] hal::PortFailure renew(const FeedSegment& first) override {
        said("renew at " + x_of(first.start));
        renewed();
        phase_ = hal::PortPhase::running;
        complete_ = false;
        return {};
    }
    [[nodiscard]] int room() const noexcept override { return phase_ == hal::PortPhase::running && !faulted ? 1 : 0; }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override {
        said(x_of(segment.start) + " to " + x_of(segment.end));
        waiting_.push_back(segment);
        return true;
    }
    void complete() noexcept override {
        said("complete");
        complete_ = true;
    }
    hal::PortState poll() noexcept override {
        for (; !frozen && !waiting_.empty() && phase_ == hal::PortPhase::running; waiting_.pop_front()) {
            mm_ = mm(waiting_.front().end);
            ++executed_;
        }
        const bool done = complete_ && waiting_.empty() && phase_ == hal::PortPhase::running;
        return {faulted ? hal::PortPhase::fault : done ? hal::PortPhase::idle : phase_, executed_};
    }
    void halt() noexcept override { stop("halt"); }
    void quick_stop() noexcept override { stop("quick stop"); }
    [[nodiscard]] hal::PortFailure failure() const override { return {"a fault"}; }

    [[nodiscard]] Told told() const {
        const std::lock_guard lock(mutex_);
        return said_;
    }
    [[nodiscard]] bool was_told(const std::string& what) const {
        const Told all = told();
        return std::find(all.begin(), all.end(), what) != all.end();
    }

    // Before it moves, or atomic.
    std::function<void()> renewed = [] {
    };
    std::string unfinished;
    std::atomic<bool> knows{true};     ///< where it stands
    std::atomic<bool> frozen{false};   ///< it executes nothing,
    std::atomic<bool> obeys{true};     ///< it stops when it is told to
    std::atomic<bool> searches{false}; ///< homing lasts until it is given up,
    std::atomic<bool> waits{false};    ///< and so does what comes before a motion
    std::atomic<bool> faulted{false};

private:
    static double mm(const PerAxis<std::int64_t>& place) {
        return static_cast<double>(place[0]) / (steps * static_cast<double>(units_per_count));
    }
    static std::string x_of(const PerAxis<std::int64_t>& place) { return fmt::format("{:g}", mm(place)); }
    void said(const std::string& what) {
        const std::lock_guard lock(mutex_);
        said_.push_back(what);
    }
    void stop(const char* what) noexcept {
        said(what);
        if (obeys) {
            waiting_.clear();
            phase_ = hal::PortPhase::halted;
        }
    }

    RunOptions options_;
    std::deque<FeedSegment> waiting_;
    hal::PortPhase phase_ = hal::PortPhase::running;
    std::uint64_t executed_ = 0;
    double mm_ = 0.0;
    bool complete_ = false;
    mutable std::mutex mutex_;
    Told said_;
};

/// What a test knows of the outputs of a server, which makes them anew.
struct TalkingOutputs {
    std::mutex mutex;
    Kinds switched;
    int made = 0;
    std::atomic<bool> refused{false};
    std::atomic<bool> fails{false};
    std::atomic<double> rpm{0.0};
};

class TalkingSpindle final : public RunSpindle {
public:
    explicit TalkingSpindle(TalkingOutputs& out) : out_(&out) {}
    void order(int /*direction*/, double rpm) override {
        ordered_ = true;
        out_->rpm = ended_ ? out_->rpm.load() : rpm;
    }
    void end() override { ended_ = true; }
    [[nodiscard]] bool reached() const override { return !ended_ && !out_->fails; }
    [[nodiscard]] bool stands() const override { return true; }
    [[nodiscard]] std::string trouble() const override { return ordered_ && out_->fails ? "it is silent" : ""; }
    [[nodiscard]] double stop_timeout_s() const override { return 0.0; }

private:
    TalkingOutputs* out_;
    std::atomic<bool> ended_{false};
    std::atomic<bool> ordered_{false};
};

class TalkingSwitches final : public RunSwitches {
public:
    explicit TalkingSwitches(TalkingOutputs& out) : out_(&out) {}
    void act(EventKind kind, std::int32_t /*number*/) override {
        const std::lock_guard lock(out_->mutex);
        out_->switched.push_back(kind);
    }
    void end() noexcept override {}
    [[nodiscard]] std::string trouble() const override { return {}; }

private:
    TalkingOutputs* out_;
};

inline std::unique_ptr<ProgramOutputs> outputs_of(TalkingOutputs& out) {
    const std::lock_guard lock(out.mutex);
    if (out.refused) {
        throw TargetError("no answer");
    }
    ++out.made;
    out.fails = false;
    ProgramOutputs::Switches switches;
    switches.push_back(std::make_unique<TalkingSwitches>(out));
    return std::make_unique<ProgramOutputs>(std::make_unique<TalkingSpindle>(out), std::move(switches));
}

/// From x to x, at rest at both ends. [mm]
inline FeedSegment segment_between(double from, double to) {
    FeedSegment out{.duration_ticks = 8000};
    out.start[0] = std::llround(from * steps * static_cast<double>(units_per_count));
    out.end[0] = std::llround(to * steps * static_cast<double>(units_per_count));
    return out;
}

class ServedDrives {
public:
    explicit ServedDrives(bool known = true) {
        description.settings.axes = 3;
        for (unsigned k = 0; k < 3; ++k) {
            description.settings.axis[k] = {100.0, 1000.0, 0.0, steps};
            description.axis_name[k] = std::string(1, "xyz"[k]);
        }
        auto made = std::make_unique<TalkingDrives>();
        drives = made.get();
        drives->knows = known;
        machine =
            std::make_unique<ServedTarget>(std::move(made), description, ServedTarget::Settings{.segment_ticks = 8000},
                                           [this] { return outputs_of(out); });
    }

protected:
    void move(double from, double to) {
        machine->submit(segment_between(from, to));
        machine->rest();
    }
    void obey(EventKind kind, int rpm = 0) {
        ProgramEvent event;
        event.kind = kind;
        event.value = Decimal::from_integer(rpm);
        machine->obey(event);
    }
    [[nodiscard]] bool is_told(const std::string& what) const {
        return splinefeed_test::comes([&] { return drives->was_told(what); });
    }
    template <class Condition>
    [[nodiscard]] bool comes(const Condition& condition) const {
        return splinefeed_test::comes(condition);
    }
    [[nodiscard]] bool stands() {
        return splinefeed_test::comes([&] { return machine->stands(); });
    }
    [[nodiscard]] bool alarms(Alarm alarm) {
        return splinefeed_test::comes([&] { return machine->read().alarm == alarm; }) && stands();
    }
    [[nodiscard]] std::string alarm_sentence() { return std::string(machine->read().alarm_sentence); }
    [[nodiscard]] double x_mm() { return machine->places()[0].mm.value(); }
    [[nodiscard]] TalkingOutputs& spindle() { return out; }
    [[nodiscard]] Kinds switched() {
        const std::lock_guard lock(out.mutex);
        return out.switched;
    }
    [[nodiscard]] int outputs_made() {
        const std::lock_guard lock(out.mutex);
        return out.made;
    }
    void refuses_outputs(bool refuse) { out.refused = refuse; }

    MachineDescription description;
    TalkingOutputs out;
    TalkingDrives* drives = nullptr;
    std::unique_ptr<ServedTarget> machine;
};

/// Their drives do not know where they stand.
struct UnknownDrives : ServedDrives {
    UnknownDrives() : ServedDrives(false) {}
};

/// A feed whose port does not obey.
struct TalkingFeed {
    MotionEnd ends_by(int requests) {
        drives.frozen = true;
        drives.obeys = false;
        feed.begin(0);
        feed.push(segment_between(0, 1));
        CHECK_FALSE(feed.look(0));
        std::optional<MotionEnd> end;
        REQUIRE(comes([&] {
            end = feed.look(requests);
            return end.has_value();
        }));
        return *end;
    }

    TalkingDrives drives;
    TalkingOutputs out;
    std::unique_ptr<ProgramOutputs> outputs = outputs_of(out);
    TargetFeed feed{drives, outputs.get(), nullptr, {20'000, 40'000}};
};

} // namespace splinefeed_test
