// SPDX-License-Identifier: MIT
// OutputPins: output lines of one GPIO chip, which change together and return to safe levels at the end.
#pragma once

#include "splinefeed/hal/gpio/pin_request.hpp"
#include "splinefeed/hal/gpio/pin_writer.hpp"

#include <atomic>
#include <memory>
#include <span>

namespace splinefeed::hal::gpio {

/// One thread calls set(). Another thread or a signal handler may call make_safe() at any time.
class OutputPins final : public PinWriter {
public:
    /// Requests the lines and sets their safe levels.
    /// @param chip  path, for example "/dev/gpiochip0", or "label=" and its label
    /// @param consumer  name that the system shows as the user of the lines, up to 31 characters
    /// @param requests  1 to 64; bit i of a mask is request i
    /// Throws GpioError; then no line is requested.
    OutputPins(const std::string& chip, const std::string& consumer, std::span<const OutputRequest> requests);
    /// Sets the safe levels and releases the lines. The chip decides what released lines do: most keep their level.
    ~OutputPins() override;

    /// Sets the lines of the mask to these levels by one system call; chips that support it change them at the same
    /// instant. Does not allocate or lock. libgpiod 1.x has no subsets: it writes the other lines with their present
    /// levels. Returns false on failure, with errno: the levels are unknown; with ECANCELED make_safe() intervened and
    /// the levels are safe.
    /// @pre mask has bits of existing lines only
    bool set(std::uint64_t mask, std::uint64_t levels) noexcept override;

    /// Sets all lines to their safe levels, if the chip still works; set() may be called again afterwards. Preserves
    /// errno. Safe in a signal handler if libgpiod's call is: a loop over the lines and one ioctl, without locks or
    /// allocation (checked in the sources of 1.6.3 and 2.1.3).
    void make_safe() noexcept;

    /// Makes the present levels of these lines their safe levels, so they keep them after release.
    /// @pre no thread calls set() any more
    void retain_levels(std::uint64_t mask) noexcept;

    [[nodiscard]] int size() const noexcept { return size_; }

private:
    struct Pins;

    std::unique_ptr<Pins> lines_;
    int size_;
    std::atomic<std::uint64_t> safe_levels_;
    std::atomic<std::uint64_t> levels_;
    std::atomic<std::uint32_t> times_made_safe_{0};
};

} // namespace splinefeed::hal::gpio
