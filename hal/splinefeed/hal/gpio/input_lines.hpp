// SPDX-License-Identifier: MIT
// InputLines: the inputs of one GPIO chip: levels, and edges with the kernel's time stamps.
#pragma once

#include "splinefeed/hal/gpio/line_request.hpp"

#include <memory>
#include <optional>
#include <span>

namespace splinefeed::hal::gpio {

/// Not copied, not moved; used by one thread. Nothing is debounced here, not by the kernel either: see Debounce.
class InputLines {
public:
    /// Takes the lines; edges are kept from that moment on, by libgpiod 1.x the first 16 of a line that nobody has
    /// fetched, by 2.x the last 1024 of all.
    /// @param chip  its path, like "/dev/gpiochip0"
    /// @param consumer  what the system tells others who has the lines, up to 31 letters
    /// @param requests  1 to 64; bit i of the levels is request i
    /// Throws GpioError; then no line was taken.
    InputLines(const std::string& chip, const std::string& consumer, std::span<const InputRequest> requests);
    InputLines(const InputLines&) = delete;
    InputLines& operator=(const InputLines&) = delete;
    ~InputLines();

    /// Bit i: line i is high. One system call; with libgpiod 1.x one a line. Empty: errno says why. After a storm of
    /// edges, of which some are lost, this is what tells the truth.
    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept;

    /// Waits for edges, and stores those that are there, as many as fit, in order of time as far as they came with this
    /// call. Returns their number; 0: none came in time, or a signal did; -1: errno says why, ENODEV where the chip
    /// has vanished. No allocation. Kernels before 6.6 tell that with the next call rather than waking this one.
    /// @pre out is not empty; with room for 16 a line none has to wait behind a noisy one
    int wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept;

    [[nodiscard]] int size() const noexcept { return size_; }

private:
    struct Lines;

    std::unique_ptr<Lines> lines_;
    int size_;
};

} // namespace splinefeed::hal::gpio
