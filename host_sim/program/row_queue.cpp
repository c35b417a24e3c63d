// SPDX-License-Identifier: MIT
#include "host_sim/program/row_queue.hpp"

#include <utility>

namespace splinefeed::host {

RowQueue::RowQueue(std::unique_ptr<WaypointRows> rows) : rows_(std::move(rows)), thread_([this] { read(); }) {}

RowQueue::~RowQueue() {
    stop();
    thread_.join();
}

void RowQueue::stop() noexcept {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    changed_.notify_all();
    rows_->stop();
}

bool RowQueue::wait(Patience patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [this] { return answers(); });
}

bool RowQueue::next(WaypointRow& out) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return answers(); });
    if (queue_.empty()) {
        if (failure_) {
            std::rethrow_exception(std::exchange(failure_, nullptr));
        }
        return false;
    }
    out = queue_.front();
    queue_.pop_front();
    lock.unlock();
    changed_.notify_all();
    return true;
}

void RowQueue::read() noexcept {
    std::exception_ptr failure;
    try {
        for (WaypointRow row; rows_->next(row);) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return queue_.size() < capacity || stops_; });
            if (stops_) {
                break;
            }
            queue_.push_back(row);
            lock.unlock();
            changed_.notify_all();
        }
    } catch (...) {
        failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    ended_ = true;
    changed_.notify_all();
}

} // namespace splinefeed::host
