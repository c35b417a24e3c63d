// SPDX-License-Identifier: MIT
// ReadAhead: rows that a separate thread reads ahead, so that no other thread waits for a pipe.
#pragma once

#include "host_sim/program/source_line.hpp"
#include "host_sim/program/waypoint_row.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace splinefeed::host {

/// The rows of another source, in order. An exception of it is thrown by next() after the rows before it.
template <class Row>
class ReadAhead final : public RowSource<Row> {
public:
    using typename RowSource<Row>::Patience;
    static constexpr std::size_t capacity = 1024;

    /// @param rows  used only by the thread, except stop(), which makes its next() return
    explicit ReadAhead(std::unique_ptr<RowSource<Row>> rows);
    ReadAhead(const ReadAhead&) = delete;
    ReadAhead& operator=(const ReadAhead&) = delete;
    ~ReadAhead() override;

    bool next(Row& out) override;
    bool wait(Patience patience) override;
    void stop() noexcept override;

private:
    void read() noexcept;
    [[nodiscard]] bool answers() const noexcept { return !queue_.empty() || ended_; }

    std::unique_ptr<RowSource<Row>> rows_;
    std::mutex mutex_; // protects the members below
    std::condition_variable changed_;
    std::deque<Row> queue_;
    std::exception_ptr failure_; // thrown after the queue is empty
    bool ended_ = false;         // nothing comes after the queue
    bool stops_ = false;
    std::thread thread_;
};

using RowQueue = ReadAhead<WaypointRow>;
using LineQueue = ReadAhead<SourceLine>;

} // namespace splinefeed::host
