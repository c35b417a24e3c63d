// SPDX-License-Identifier: MIT
// BackgroundWork: work that nobody waits for before its end, done in order by a thread of its own.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace splinefeed::host {

/// What the work refers to must outlive it. Memory: at most `most_batches` of `batch` pieces wait; then add() waits.
class BackgroundWork {
public:
    using Piece = std::function<void()>;
    static constexpr std::size_t batch = 256;
    static constexpr std::size_t most_batches = 16;

    /// @param threaded  false: add() does it at once
    explicit BackgroundWork(bool threaded);
    BackgroundWork(const BackgroundWork&) = delete;
    BackgroundWork& operator=(const BackgroundWork&) = delete;
    /// Work that is left is not done.
    ~BackgroundWork();

    /// Throws what the work throws if it is done at once.
    void add(Piece piece);
    /// Waits until all is done. Throws the first exception of the work, behind which nothing was done.
    void finish();

private:
    void work();
    void hand_over();

    bool threaded_;
    std::vector<Piece> next_; // of whoever adds
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::vector<Piece>> batches_;
    bool busy_ = false;
    bool over_ = false;
    std::exception_ptr failure_;
    std::thread thread_; // the last one: it begins when all others are there
};

} // namespace splinefeed::host
