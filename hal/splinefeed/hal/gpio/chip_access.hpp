// SPDX-License-Identifier: MIT
// ChipAccess, OutputAccess, InputAccess: the interface to libgpiod. pins_v1.cpp implements it with version 1.x,
// pins_v2.cpp with 2.x. Internal to this folder.
#pragma once

#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace splinefeed::hal::gpio {

/// What the kernel reports about a line.
struct PinFacts {
    std::string name;
    std::string consumer; ///< name that the user of the line gave; may be empty
    bool used = false;
};

/// An open chip. It must outlive the lines requested from it.
class ChipAccess {
public:
    explicit ChipAccess(const std::string& path); ///< throws GpioError
    ChipAccess(const ChipAccess&) = delete;
    ChipAccess& operator=(const ChipAccess&) = delete;
    ~ChipAccess();

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] PinFacts facts(unsigned offset) const;  ///< throws GpioError
    [[nodiscard]] std::vector<std::string> names() const; ///< of all lines; throws GpioError
    [[nodiscard]] std::string label() const;              ///< throws GpioError

    struct Handle;
    [[nodiscard]] Handle& handle() const noexcept { return *handle_; }

private:
    std::string path_;
    std::unique_ptr<Handle> handle_;
};

/// The offsets of the requested lines. Throws GpioError, as find_lines() does.
template <class Request>
[[nodiscard]] std::vector<unsigned> offsets_of(const ChipAccess& chip, std::span<const Request> requests) {
    std::vector<PinName> wanted;
    for (const Request& request : requests) {
        wanted.push_back(request.line);
    }
    return find_lines(chip.path(), chip.names(), wanted);
}

/// Up to 64 requested outputs.
class OutputAccess {
public:
    /// @param levels  bit i: initial level of the line at offsets[i]
    OutputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                 std::uint64_t levels); ///< throws GpioError
    OutputAccess(const OutputAccess&) = delete;
    OutputAccess& operator=(const OutputAccess&) = delete;
    ~OutputAccess();

    /// Writes by one ioctl. `levels` has the levels of all lines, `mask` the lines that changed. Returns false on
    /// failure, with errno.
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
    /// As InputPins::wait, but events may be unsorted, and a signal gives -1 with EINTR.
    int wait(std::span<InputEvent> out, std::uint64_t timeout_ns) noexcept;

private:
    struct Request;
    std::unique_ptr<Request> request_;
};

/// Throws a GpioError that explains why a chip cannot be opened: missing, no permission, or not a GPIO chip.
[[noreturn]] void refuse_chip(const std::string& path, int error);
/// Throws a GpioError that explains why lines cannot be requested, for example who uses them.
/// @param what  intended use, for example "an output"
[[noreturn]] void refuse_lines(const ChipAccess& chip, std::span<const unsigned> offsets, const char* what, int error);

} // namespace splinefeed::hal::gpio
