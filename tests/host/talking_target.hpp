// SPDX-License-Identifier: MIT
// TalkingTarget: a target that says what it was told, for tests of Supervision.
#pragma once

#include "host_sim/run/supervision.hpp"
#include "support/catch.hpp"

#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;

/// Takes and executes at once; it says what it was told, in order.
class TalkingTarget final : public RunTarget {
public:
    class Port final : public hal::MotionPort {
    public:
        explicit Port(TalkingTarget& target) : target_(&target) {}

    private:
        [[nodiscard]] int do_room() const noexcept override { return target_->takes ? 1 : 0; }
        [[nodiscard]] bool do_submit(const FeedSegment& segment) noexcept override {
            target_->said("segment " + std::to_string(segment.index));
            return target_->phase == hal::PortPhase::running;
        }
        hal::PortState do_poll() noexcept override { return {target_->phase, target_->executed}; }
        void do_halt() noexcept override { target_->phase = hal::PortPhase::halted; }

        TalkingTarget* target_;
    };

    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return port_; }
    [[nodiscard]] std::string prepare(const FeedSegment& /*first*/) override {
        said("prepare");
        return refusal;
    }
    void complete() override {
        said("complete");
        phase = hal::PortPhase::idle;
    }
    void hold() override {
        said("hold");
        if (halts) {
            port().halt();
        }
    }
    void quick_stop() override {
        said("quick stop");
        if (stops) {
            port().halt();
        }
    }
    [[nodiscard]] std::string holds() const override { return reason; }
    [[nodiscard]] bool achieved() const override { return false; }
    [[nodiscard]] std::string fault() const override { return "a fault"; }
    [[nodiscard]] std::string halted(bool quick) const override { return quick ? "stopped" : "held"; }
    [[nodiscard]] std::string finish() override {
        said("finish");
        return unfinished;
    }
    void release() noexcept override { said("release"); }
    [[nodiscard]] std::vector<AxisPlace> places() const override { return stands; }
    [[nodiscard]] std::string where() const override { return "; there"; }
    void describe(Summary& /*summary*/) const override {}
    void update() override {
        if (breaks) {
            throw std::runtime_error("it broke");
        }
    }

    void said(const std::string& what) {
        const std::lock_guard lock(mutex_);
        said_.push_back(what);
    }
    [[nodiscard]] std::vector<std::string> told() const {
        const std::lock_guard lock(mutex_);
        return said_;
    }

    // Before the thread, or atomic.
    std::string refusal;
    std::string reason;
    std::string unfinished;
    std::vector<AxisPlace> stands{{1, 2.5, false}};
    std::atomic<bool> takes{true};
    std::atomic<bool> halts{true};
    std::atomic<bool> stops{true};
    std::atomic<bool> breaks{false};
    std::atomic<hal::PortPhase> phase{hal::PortPhase::running};
    std::atomic<std::uint64_t> executed{0};

private:
    Port port_{*this};
    mutable std::mutex mutex_;
    std::vector<std::string> said_;
};

inline FeedSegment segment(std::uint32_t index) {
    FeedSegment one;
    one.index = index;
    one.duration_ticks = 8000;
    return one;
}

/// The signal comes, and the watch has counted it.
inline void request(int count) {
    REQUIRE(kill(getpid(), SIGINT) == 0);
    for (int i = 0; i < 5000 && SignalWatch::interrupts() < count; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(SignalWatch::interrupts() == count);
}

template <class Condition>
bool comes(Condition condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
}

using Told = std::vector<std::string>;

} // namespace splinefeed_test
