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
class TalkingTarget final : public RunTarget, public hal::MotionPort {
public:
    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return false; }
    [[nodiscard]] hal::MotionPort& port() noexcept override { return *this; }
    [[nodiscard]] std::string holds() const override {
        if (breaks) {
            throw std::runtime_error("it broke");
        }
        return reason;
    }
    [[nodiscard]] bool achieved() const override { return false; }
    [[nodiscard]] std::string halted(bool quick) const override { return quick ? "stopped" : "held"; }
    [[nodiscard]] std::string finish() override {
        said("finish");
        return unfinished;
    }
    [[nodiscard]] std::vector<AxisPlace> places() const override { return stands; }
    [[nodiscard]] std::string where() const override { return "; there"; }
    void describe(Summary& /*summary*/) const override {}

    [[nodiscard]] hal::PortFailure prepare(const FeedSegment& /*first*/) override {
        said("prepare");
        return {refusal};
    }
    [[nodiscard]] int room() const noexcept override { return takes ? 1 : 0; }
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept override {
        said("segment " + std::to_string(segment.index));
        return phase == hal::PortPhase::running;
    }
    void complete() noexcept override {
        said("complete");
        phase = hal::PortPhase::idle;
    }
    hal::PortState poll() noexcept override { return {phase, executed}; }
    void halt() noexcept override { stop("hold", halts); }
    void quick_stop() noexcept override { stop("quick stop", stops); }
    void close() noexcept override { said("release"); }
    [[nodiscard]] hal::PortFailure failure() const override { return {"a fault"}; }

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
    void stop(const char* what, bool obeys) noexcept {
        said(what);
        phase = obeys ? hal::PortPhase::halted : phase.load();
    }

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

struct NoOutput {
    SignalWatch signals{{}};
    TalkingTarget target;
    std::unique_ptr<ProgramOutputs> outputs;
};

/// A run under supervision. No thread runs before the first segment.
template <class Outputs>
struct RunOf : Outputs {
    void submit(std::uint32_t index = 0) { REQUIRE(supervision.submit(segment(index))); }
    /// The target has the first segment.
    void move() {
        submit();
        REQUIRE(comes([&] { return this->target.told().size() == 2; }));
    }
    /// After twenty looks it has been told no more than that.
    void stays(const Told& told) const {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        CHECK(this->target.told() == told);
    }
    void is_over() {
        REQUIRE(comes([&] { return supervision.over(); }));
    }
    void fails(const std::string& ending) {
        CHECK_FALSE(supervision.finish());
        CHECK(supervision.ending() == ending);
    }

    Supervision supervision{this->target, this->signals, this->outputs.get()};
};
using TalkingRun = RunOf<NoOutput>;

} // namespace splinefeed_test
