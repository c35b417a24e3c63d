// SPDX-License-Identifier: MIT
// InputPins: input lines of one GPIO chip: their levels, and edges with the kernel's time stamps.
#pragma once

#include "splinefeed/hal/gpio/input_source.hpp"

#include <memory>
#include <optional>
#include <span>

namespace splinefeed::hal::gpio {

/// For one thread. Neither this class nor the kernel debounces: see Debounce.
class InputPins final : public InputSource {
public:
    /// Requests the lines. From then on edges are queued: with libgpiod 1.x the first 16 unread ones of each line,
    /// with 2.x the last 1024 of all lines.
    /// @param chip  path, for example "/dev/gpiochip0", or "label=" and its label
    /// @param consumer  name that the system shows as the user of the lines, up to 31 characters
    /// @param requests  1 to 64; bit i of the levels is request i
    /// Throws GpioError; then no line is requested.
    InputPins(const std::string& chip, const std::string& consumer, std::span<const InputRequest> requests);
    ~InputPins() override;

    /// Reads the levels; bit i: line i is high. Empty on failure, with errno. One system call, with libgpiod 1.x one
    /// for each line. Use it to recover after edges were lost.
    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept override;

    /// Waits for edges and stores as many as fit, sorted by time within one call. Returns their number; 0 after a
    /// time-out or a signal; -1 on failure, with errno (ENODEV: the chip has vanished; kernels before 6.6 report that
    /// with the next call only). Does not allocate.
    /// @pre out is not empty; with room for 16 per line, no line waits behind a noisy one
    int wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept override;

    [[nodiscard]] int size() const noexcept { return size_; }

private:
    struct Pins;

    std::unique_ptr<Pins> lines_;
    int size_;
};

} // namespace splinefeed::hal::gpio
