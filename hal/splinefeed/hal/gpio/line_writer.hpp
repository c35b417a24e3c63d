// SPDX-License-Identifier: MIT
// LineWriter: where the levels of a chip's output lines go. Virtual, at the rate of edges.
#pragma once

#include <cstdint>

namespace splinefeed::hal::gpio {

/// Called by the real-time thread alone: it must neither allocate, nor lock, nor wait.
class LineWriter {
public:
    LineWriter() = default;
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;
    virtual ~LineWriter() = default;

    /// The lines of the mask take these levels, all at once. False: they did not, errno says why.
    [[nodiscard]] virtual bool set(std::uint64_t mask, std::uint64_t levels) noexcept = 0;
};

} // namespace splinefeed::hal::gpio
