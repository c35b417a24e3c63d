// SPDX-License-Identifier: MIT
// RowSource: rows of a text in order, waypoints or lines, from a file or a pipe.
#pragma once

#include <chrono>

namespace splinefeed::host {

/// next() throws InputError for a wrong row.
template <class Row>
class RowSource {
public:
    using Patience = std::chrono::steady_clock::duration;

    RowSource() = default;
    RowSource(const RowSource&) = delete;
    RowSource& operator=(const RowSource&) = delete;
    virtual ~RowSource() = default;

    /// Reads the next row; false if there are no more. May wait for the input.
    virtual bool next(Row& out) = 0;
    /// Whether next() would return without waiting; waits for that up to the given time. A source that cannot tell
    /// returns true.
    virtual bool wait(Patience /*patience*/) { return true; }
    /// For any thread: from now on next() does not wait for the input, and returns false.
    virtual void stop() noexcept {}
};

} // namespace splinefeed::host
