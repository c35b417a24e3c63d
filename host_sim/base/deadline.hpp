// SPDX-License-Identifier: MIT
// Deadline: ends the process where something does not end that has to.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace splinefeed::host {

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
