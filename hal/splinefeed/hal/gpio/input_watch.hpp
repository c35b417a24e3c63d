// SPDX-License-Identifier: MIT
// InputWatch: watches the switches of a machine, with one thread per chip: which are active, since when, and at which
// axis positions.
#pragma once

#include "splinefeed/hal/gpio/debounce.hpp"
#include "splinefeed/hal/gpio/input_source.hpp"
#include "splinefeed/hal/gpio/step_log.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// One input of a chip.
struct WatchedInput {
    std::uint8_t bit = 0; ///< bit of the line in its chip's source
    bool active_level = true;
    std::uint32_t debounce_us = 0;
    bool trips_estop =
        false; ///< its first edge disables the drives, without debouncing: a false trip is safer than a late one
};

/// An input became active or inactive.
struct InputChange {
    std::size_t input = 0; ///< index in the constructor's list
    bool active = false;
    std::uint64_t time_ns = 0; ///< of the first edge of the change
    /// Axis positions at that instant, relative to the start of the log. Empty: the log has lost steps.
    std::optional<PerAxis<std::int64_t>> counts;
};

struct InputWatchSettings {
    /// SCHED_FIFO priority, above that of the thread that writes edges, which may spin. 0: an ordinary thread.
    int priority = 0;
    Clock* clock = nullptr; ///< must outlive the watch; null: the system clock
};

/// Watches the inputs of one chip from start() to destruction.
class InputWatch {
public:
    /// @param disable  disables the drives; called from the watch's thread when an input trips the e-stop or the chip
    /// cannot be read any more All arguments must outlive the watch.
    InputWatch(InputSource& source, const std::vector<WatchedInput>& inputs, const StepLog& log,
               std::function<void()> disable, const InputWatchSettings& settings = {});
    InputWatch(const InputWatch&) = delete;
    InputWatch& operator=(const InputWatch&) = delete;
    ~InputWatch();

    /// Reads the levels and starts the thread. Returns false if the levels cannot be read.
    [[nodiscard]] bool start();

    /// Whether the input is active, by the last known level. The change to it can then be taken.
    [[nodiscard]] bool active(std::size_t input) const noexcept { return active_[input].load(); }
    /// Removes and returns the oldest change.
    [[nodiscard]] std::optional<InputChange> take();
    /// Why the chip cannot be read any more; empty: it can.
    [[nodiscard]] std::string trouble() const;
    /// Number of edges that were lost.
    [[nodiscard]] std::uint64_t missed() const noexcept { return missed_.load(); }

private:
    struct EdgeRecord {
        std::uint64_t time_ns = 0;
        std::optional<PerAxis<std::int64_t>> counts;
    };
    static constexpr std::size_t max_edges = 64; // edges of an input while it bounces

    struct Watched {
        WatchedInput input;
        Debounce debounce{false, 0};
        std::array<EdgeRecord, max_edges> edges{};
        std::size_t edge_count = 0;
        int differs = 0; // consecutive checks at which the level contradicted the edges
    };

    void work() noexcept;
    void edge(std::size_t index, std::uint64_t time_ns, bool level);
    void settle(std::uint64_t now_ns);
    void change(std::size_t index, bool active);
    void check_levels(std::uint64_t now_ns);
    void fail(int error);
    [[nodiscard]] std::uint32_t wait_timeout_us(std::uint64_t now_ns) const noexcept;

    InputSource* source_;
    std::vector<Watched> watched_;
    std::vector<std::atomic<bool>> active_;
    StepLog::Reader reader_;
    std::function<void()> disable_;
    mutable std::mutex mutex_; // of what follows
    std::vector<InputChange> changes_;
    int error_ = 0;
    std::atomic<std::uint64_t> missed_{0};
    std::atomic<bool> ends_{false};
    int priority_;
    Clock* time_;
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::gpio
