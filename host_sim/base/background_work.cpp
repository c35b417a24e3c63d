// SPDX-License-Identifier: MIT
#include "host_sim/base/background_work.hpp"

#include <utility>

namespace splinefeed::host {

BackgroundWork::BackgroundWork(bool threaded) : threaded_(threaded) {
    if (threaded_) {
        next_.reserve(batch);
        thread_ = std::thread([this] { work(); });
    }
}

BackgroundWork::~BackgroundWork() {
    if (!threaded_) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void BackgroundWork::add(Piece piece) {
    if (!threaded_) {
        piece();
        return;
    }
    next_.push_back(std::move(piece));
    if (next_.size() == batch) {
        hand_over();
    }
}

void BackgroundWork::hand_over() {
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return batches_.size() < most_batches; });
        batches_.push_back(std::exchange(next_, {}));
    }
    changed_.notify_all();
    next_.reserve(batch);
}

void BackgroundWork::finish() {
    if (!threaded_) {
        return;
    }
    hand_over();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return batches_.empty() && !busy_; });
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void BackgroundWork::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return over_ || !batches_.empty(); });
        if (over_) {
            return;
        }
        const std::vector<Piece> pieces = std::move(batches_.front());
        batches_.pop_front();
        busy_ = true;
        const bool failed = failure_ != nullptr;
        lock.unlock();
        changed_.notify_all();
        std::exception_ptr failure;
        try {
            for (std::size_t i = 0; !failed && i < pieces.size(); ++i) {
                pieces[i]();
            }
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        busy_ = false;
        failure_ = failure_ ? failure_ : failure;
        changed_.notify_all();
    }
}

} // namespace splinefeed::host
