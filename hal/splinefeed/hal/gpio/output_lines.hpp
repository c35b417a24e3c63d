// SPDX-License-Identifier: MIT
// OutputLines: the outputs of one GPIO chip, set together; and safe levels, whatever happens.
#pragma once

#include "splinefeed/hal/gpio/line_request.hpp"

#include <atomic>
#include <memory>
#include <span>

namespace splinefeed::hal::gpio {

/// Not copied, not moved. One thread sets; make_safe() may come at any time from another one, or from a signal handler.
class OutputLines {
public:
    /// Takes the lines, which have their safe levels from that moment on.
    /// @param chip  its path, like "/dev/gpiochip0"
    /// @param consumer  what the system tells others who has the lines, up to 31 letters
    /// @param requests  1 to 64; bit i of a mask is request i
    /// Throws GpioError; then no line was taken.
    OutputLines(const std::string& chip, const std::string& consumer, std::span<const OutputRequest> requests);
    OutputLines(const OutputLines&) = delete;
    OutputLines& operator=(const OutputLines&) = delete;
    /// Safe levels, then the lines are released. What a released line does is the chip's own business: most keep the
    /// level.
    ~OutputLines();

    /// The lines of the mask take these levels, in one system call, and on chips that can, at the same instant. No
    /// allocation, no lock. libgpiod 1.x knows no subset: there the others are set to what they are.
    /// False: errno says why, and the levels are unknown; with ECANCELED make_safe() came in between, and the levels
    /// are safe.
    /// @pre mask has bits of lines alone
    bool set(std::uint64_t mask, std::uint64_t levels) noexcept;

    /// All lines take their safe levels, as far as the chip still obeys; set() goes on working. As safe in a signal
    /// handler as libgpiod's call, which is a loop over the lines and one ioctl, without locks or allocation (read in
    /// 1.6.3 and 2.1.3); errno stays as it was.
    void make_safe() noexcept;

    /// From now on the safe levels of these lines are what they have: they keep them when all are released.
    /// @pre nobody sets any more
    void retain_levels(std::uint64_t mask) noexcept;

    [[nodiscard]] int size() const noexcept { return size_; }

private:
    struct Lines;

    std::unique_ptr<Lines> lines_;
    int size_;
    std::atomic<std::uint64_t> safe_levels_;
    std::atomic<std::uint64_t> levels_;
    std::atomic<std::uint32_t> times_made_safe_{0};
};

} // namespace splinefeed::hal::gpio
