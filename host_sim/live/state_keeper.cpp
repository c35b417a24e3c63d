// SPDX-License-Identifier: MIT
#include "host_sim/live/state_keeper.hpp"

#include "host_sim/base/durable_file.hpp"
#include "host_sim/base/text_file.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_state = 1U << 16U;
constexpr const char* run_has_no_end =
    "a run has not ended, or its process was killed before it could say where the machine stands";
constexpr const char* end_without_place =
    "when the last run ended, this axis had no reference or had not confirmed that it stands";

} // namespace

StateKeeper::StateKeeper(const StateFile& file, MachineState begins, Writes writes)
    : file_(&file), writes_(writes), kept_(std::move(begins)) {
    if (writes_ == Writes::behind) {
        thread_ = std::thread([this] { work(); });
    }
}

StateKeeper::~StateKeeper() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) {
        thread_.join();
    }
}

void StateKeeper::write() {
    ++said_;
    if (writes_ == Writes::at_once) {
        file_->write(kept_);
        written_ = said_;
    }
    changed_.notify_all();
}

// What was said while it wrote is written as one.
void StateKeeper::work() {
    std::unique_lock lock(mutex_);
    while (!failure_ && !(over_ && written_ == said_)) {
        if (written_ == said_) {
            changed_.wait(lock);
            continue;
        }
        const MachineState state = kept_;
        const std::uint64_t said = said_;
        std::exception_ptr failure;
        lock.unlock();
        try {
            file_->write(state);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        written_ = failure ? written_ : said;
        failure_ = failure;
        changed_.notify_all();
    }
}

bool StateKeeper::is_kept() {
    const std::lock_guard lock(mutex_);
    if (failure_) {
        std::rethrow_exception(failure_);
    }
    return written_ == said_;
}

bool StateKeeper::has_failed() {
    const std::lock_guard lock(mutex_);
    return failure_ != nullptr;
}

void StateKeeper::finish() {
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return failure_ || written_ == said_; });
    }
    static_cast<void>(is_kept());
}

void StateKeeper::moves() {
    const std::lock_guard lock(mutex_);
    if (writes_ == Writes::at_once && is_regular_file(file_->path())) {
        before_ = read_text_file(file_->path(), largest_state);
    }
    moves_ = true;
    kept_.position_mm.fill(std::nullopt);
    kept_.unknown_why = run_has_no_end;
    write();
}

void StateKeeper::offsets(const WorkOffsets& offsets) {
    const std::lock_guard lock(mutex_);
    kept_.offsets = offsets;
    write();
}

void StateKeeper::stands(const PerAxis<double>& mm) {
    const std::lock_guard lock(mutex_);
    std::ranges::copy(mm, kept_.position_mm.begin());
    kept_.unknown_why.clear();
    write();
}

void StateKeeper::ends(std::span<const RunTarget::AxisPlace> places) {
    const std::lock_guard lock(mutex_);
    if (!places.empty()) {
        for (const RunTarget::AxisPlace& at : places) {
            kept_.position_mm[at.axis] = at.known();
        }
        kept_.unknown_why = end_without_place;
        write();
    } else if (before_) {
        replace_durably(file_->path(), *before_);
    } else if (moves_) {
        remove_replaced(file_->path());
    }
}

} // namespace splinefeed::host
