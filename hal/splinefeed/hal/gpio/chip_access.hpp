// SPDX-License-Identifier: MIT
// ChipAccess, OutputAccess, InputAccess: what lines_v1.cpp does with libgpiod 1.x and lines_v2.cpp with 2.x. For this
// folder alone.
#pragma once

#include "splinefeed/hal/gpio/line_request.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// What the kernel says of a line.
struct LineFacts {
    std::string name;
    std::string consumer; ///< of the one that uses it; empty where it did not say
    bool used = false;
};

/// An open chip. It outlives the lines that were requested of it.
class ChipAccess {
public:
    explicit ChipAccess(const std::string& path); ///< throws GpioError
    ChipAccess(const ChipAccess&) = delete;
    ChipAccess& operator=(const ChipAccess&) = delete;
    ~ChipAccess();

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] LineFacts facts(unsigned offset) const; ///< throws GpioError
    [[nodiscard]] std::vector<std::string> names() const; ///< of all lines; throws GpioError

    struct Handle;
    [[nodiscard]] Handle& handle() const noexcept { return *handle_; }

private:
    std::string path_;
    std::unique_ptr<Handle> handle_;
};

/// Up to 64 requested outputs.
class OutputAccess {
public:
    /// @param levels  bit i: of the line at offsets[i], from the request on
    OutputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                 std::uint64_t levels); ///< throws GpioError
    OutputAccess(const OutputAccess&) = delete;
    OutputAccess& operator=(const OutputAccess&) = delete;
    ~OutputAccess();

    /// One ioctl. `levels` has all lines, the mask those that changed. False: errno says why.
    bool write(std::uint64_t mask, std::uint64_t levels) noexcept;

private:
    struct Request;
    std::unique_ptr<Request> request_;
};

/// Up to 64 requested inputs that report both edges.
class InputAccess {
public:
    InputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                std::span<const InputRequest> requests); ///< throws GpioError
    InputAccess(const InputAccess&) = delete;
    InputAccess& operator=(const InputAccess&) = delete;
    ~InputAccess();

    [[nodiscard]] std::optional<std::uint64_t> levels() noexcept;
    /// As InputLines::wait, in any order; a signal is -1 with EINTR.
    int wait(std::span<InputEvent> out, std::uint64_t timeout_ns) noexcept;

private:
    struct Request;
    std::unique_ptr<Request> request_;
};

/// A chip that cannot be opened: is it there, may we, is it one? Throws GpioError.
[[noreturn]] void refuse_chip(const std::string& path, int error);
/// Lines that the kernel does not give us: who has them? Throws GpioError.
/// @param what  "an output"
[[noreturn]] void refuse_lines(const ChipAccess& chip, std::span<const unsigned> offsets, const char* what, int error);

} // namespace splinefeed::hal::gpio
