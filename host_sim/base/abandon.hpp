// SPDX-License-Identifier: MIT
// abandon: ends the process while other threads are blocked in a read or write. Deadline: ends the process where
// something does not end that has to.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace splinefeed::host {

/// Removes the outputs that are not committed, writes the sentence to standard error if that does not block, and ends
/// the process with this exit status. For any thread. The first call decides; other calls wait for the end.
[[noreturn]] void abandon(std::string_view sentence, int status) noexcept;

/// If the object lives longer than its time, the process ends with the sentence and exit status 1 (abandon()).
class Deadline {
public:
    Deadline(std::chrono::milliseconds time, std::string sentence);
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
    ~Deadline();

private:
    std::mutex mutex_;
    std::condition_variable ended_;
    bool done_ = false;
    std::thread thread_;
};

/// A deleter for what joins threads that may be kept by a device.
struct DeleteInTime {
    static constexpr std::chrono::seconds most{10};

    template <class T>
    void operator()(T* it) const {
        const Deadline deadline(most, "a thread of a line does not end, so the program ended without it; switch the "
                                      "machine off, and look at what answers on its lines");
        delete it;
    }
};

} // namespace splinefeed::host
