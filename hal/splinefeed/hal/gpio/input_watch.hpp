// SPDX-License-Identifier: MIT
// InputWatch: switches of a machine, by a thread a chip: what acts, since when, and where the axes stood then.
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
    std::uint8_t bit = 0; ///< of its chip's source
    bool active_level = true;
    std::uint32_t debounce_us = 0;
    bool trips_estop =
        false; ///< at its first edge the machine is cut off; without debouncing, since noise does less harm
};

/// An input began to act, or ended to.
struct InputChange {
    std::size_t input = 0; ///< in the order in which they were given
    bool active = false;
    std::uint64_t time_ns = 0; ///< of the first edge of it
    /// Where the axes stood then, relative to the start of the log. Nothing: steps were lost from the log.
    std::optional<PerAxis<std::int64_t>> counts;
};

struct InputWatchSettings {
    /// SCHED_FIFO; above that of the thread that makes edges, which may spin. 0: an ordinary thread.
    int priority = 0;
    Clock* clock = nullptr; ///< outlives the watch; null: the system's
};

/// Watches the inputs of one chip from start() to its end.
class InputWatch {
public:
    /// @param cut  from its thread: trips_estop the machine off; also where the chip says nothing any more
    /// All arguments must outlive it.
    InputWatch(InputSource& source, const std::vector<WatchedInput>& inputs, const StepLog& log,
               std::function<void()> disable, const InputWatchSettings& settings = {});
    InputWatch(const InputWatch&) = delete;
    InputWatch& operator=(const InputWatch&) = delete;
    ~InputWatch();

    /// Reads the levels. False: they cannot be read.
    [[nodiscard]] bool start();

    /// Whether the input acts, as it was last known.
    [[nodiscard]] bool active(std::size_t input) const noexcept { return active_[input].load(); }
    /// The oldest change that nobody has taken yet.
    [[nodiscard]] std::optional<InputChange> take();
    /// Why the chip says nothing any more; empty: it does.
    [[nodiscard]] std::string trouble() const;
    /// Edges that the system dropped.
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
        int differs = 0; // looks in a row without an edge at which the level was another one
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
