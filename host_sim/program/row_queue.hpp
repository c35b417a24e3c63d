// SPDX-License-Identifier: MIT
// RowQueue: waypoints that a thread of its own reads ahead, so that nobody else waits for a pipe.
#pragma once

#include "host_sim/program/waypoint_rows.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace splinefeed::host {

/// The rows of another one, in order. What that throws comes out of next() behind the rows before it.
class RowQueue final : public WaypointRows {
public:
    static constexpr std::size_t capacity = 1024;

    /// @param rows  used by the thread alone, but stop(), which lets its next() return
    explicit RowQueue(std::unique_ptr<WaypointRows> rows);
    RowQueue(const RowQueue&) = delete;
    RowQueue& operator=(const RowQueue&) = delete;
    ~RowQueue() override;

    bool next(WaypointRow& out) override;
    bool wait(Patience patience) override;
    void stop() noexcept override;

private:
    void read() noexcept;
    [[nodiscard]] bool answers() const noexcept { return !queue_.empty() || ended_; }

    std::unique_ptr<WaypointRows> rows_;
    std::mutex mutex_; // of what follows
    std::condition_variable changed_;
    std::deque<WaypointRow> queue_;
    std::exception_ptr failure_; // after the queue
    bool ended_ = false;         // nothing comes behind the queue
    bool stops_ = false;
    std::thread thread_;
};

} // namespace splinefeed::host
