// SPDX-License-Identifier: MIT
// PinWriter: interface to the output lines of a chip. Tests replace it. The virtual calls are at the rate of edges.
#pragma once

#include <cstdint>

namespace splinefeed::hal::gpio {

/// The real-time thread calls set(): implementations must not allocate, lock or wait.
class PinWriter {
public:
    PinWriter() = default;
    PinWriter(const PinWriter&) = delete;
    PinWriter& operator=(const PinWriter&) = delete;
    virtual ~PinWriter() = default;

    /// Sets the lines of the mask to these levels, all at once. Returns false on failure, with errno.
    [[nodiscard]] virtual bool set(std::uint64_t mask, std::uint64_t levels) noexcept = 0;
};

} // namespace splinefeed::hal::gpio
