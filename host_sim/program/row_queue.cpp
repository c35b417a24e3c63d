// SPDX-License-Identifier: MIT
#include "host_sim/program/row_queue.hpp"

#include <utility>

namespace splinefeed::host {

template <class Row>
ReadAhead<Row>::ReadAhead(std::unique_ptr<RowSource<Row>> rows) : rows_(std::move(rows)), thread_([this] { read(); }) {}

template <class Row>
ReadAhead<Row>::~ReadAhead() {
    stop();
    thread_.join();
}

template <class Row>
void ReadAhead<Row>::stop() noexcept {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    changed_.notify_all();
    rows_->stop();
}

template <class Row>
bool ReadAhead<Row>::wait(Patience patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [this] { return answers(); });
}

template <class Row>
bool ReadAhead<Row>::next(Row& out) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return answers(); });
    if (queue_.empty()) {
        if (failure_) {
            std::rethrow_exception(std::exchange(failure_, nullptr));
        }
        return false;
    }
    out = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    changed_.notify_all();
    return true;
}

template <class Row>
void ReadAhead<Row>::read() noexcept {
    std::exception_ptr failure;
    try {
        for (Row row; rows_->next(row);) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return queue_.size() < capacity || stops_; });
            if (stops_) {
                break;
            }
            queue_.push_back(std::move(row));
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

template class ReadAhead<WaypointRow>;
template class ReadAhead<SourceLine>;

} // namespace splinefeed::host
