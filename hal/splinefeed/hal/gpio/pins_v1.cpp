// SPDX-License-Identifier: MIT
// ChipAccess, OutputAccess and InputAccess for libgpiod 1.x (GPIO uAPI v1): one file descriptor for all outputs, and
// one for each input.
#include "splinefeed/hal/gpio/chip_access.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <gpiod.h>
#include <string_view>
#include <sys/utsname.h>

namespace splinefeed::hal::gpio {

static_assert(GPIOD_LINE_BULK_MAX_LINES == most_lines);

struct ChipAccess::Handle {
    explicit Handle(const std::string& path) : chip(gpiod_chip_open(path.c_str())) {
        if (chip == nullptr) {
            refuse_chip(path, errno);
        }
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { gpiod_chip_close(chip); }

    gpiod_chip* chip;
};

namespace {

gpiod_line* line_at(const ChipAccess& chip, unsigned offset) {
    gpiod_line* const line = gpiod_chip_get_line(chip.handle().chip, offset);
    if (line == nullptr) {
        refuse_chip(chip.path(), errno);
    }
    return line;
}

// Before Linux 5.7 this interface has CLOCK_REALTIME time stamps.
void require_monotonic_events(const ChipAccess& chip) {
    utsname system{};
    if (uname(&system) != 0) {
        return;
    }
    const std::string_view release = system.release;
    const char* const end = release.data() + release.size();
    int major = 0;
    int minor = 0;
    const auto dot = std::from_chars(release.data(), end, major);
    if (dot.ec != std::errc{} || dot.ptr == end || std::from_chars(dot.ptr + 1, end, minor).ec != std::errc{}) {
        return;
    }
    constexpr int needed_major = 5;
    constexpr int needed_minor = 7;
    if (major < needed_major || (major == needed_major && minor < needed_minor)) {
        throw GpioError("Linux " + std::string(release) + " stamps the edges of " + chip.path() +
                        " with the time of day; take Linux 5.7 or later");
    }
}

int flags_of(Bias bias) {
    switch (bias) {
    case Bias::disabled: return static_cast<int>(GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE);
    case Bias::pull_up: return static_cast<int>(GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP);
    case Bias::pull_down: return static_cast<int>(GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN);
    case Bias::as_is: break;
    }
    return 0;
}

using Values = std::array<int, most_lines>;

Values values_of(std::uint64_t levels) noexcept {
    Values values{};
    for (unsigned i = 0; i < most_lines; ++i) {
        values[i] = static_cast<int>(levels >> i & 1U);
    }
    return values;
}

} // namespace

// Requested lines, released at the end. The lines belong to the chip and can be requested again.
struct Bulk {
    Bulk() { gpiod_line_bulk_init(&lines); }
    Bulk(const Bulk&) = delete;
    Bulk& operator=(const Bulk&) = delete;
    ~Bulk() {
        for (unsigned i = 0; i < lines.num_lines; ++i) {
            gpiod_line_release(lines.lines[i]);
        }
    }

    gpiod_line_bulk lines{};
};

ChipAccess::ChipAccess(const std::string& path) : path_(path), handle_(std::make_unique<Handle>(path)) {}

ChipAccess::~ChipAccess() = default;

PinFacts ChipAccess::facts(unsigned offset) const {
    gpiod_line* const line = line_at(*this, offset);
    if (gpiod_line_update(line) != 0) {
        refuse_chip(path_, errno);
    }
    const char* const name = gpiod_line_name(line);
    const char* const consumer = gpiod_line_consumer(line);
    return {name != nullptr ? name : "", consumer != nullptr ? consumer : "", gpiod_line_is_used(line)};
}

std::string ChipAccess::label() const {
    return gpiod_chip_label(handle_->chip);
}

std::vector<std::string> ChipAccess::names() const {
    std::vector<std::string> out;
    for (unsigned offset = 0; offset < gpiod_chip_num_lines(handle_->chip); ++offset) {
        out.push_back(facts(offset).name);
    }
    return out;
}

struct OutputAccess::Request : Bulk {};

OutputAccess::OutputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                           std::uint64_t levels)
    : request_(std::make_unique<Request>()) {
    gpiod_line_bulk wanted = GPIOD_LINE_BULK_INITIALIZER;
    for (const unsigned offset : offsets) {
        gpiod_line_bulk_add(&wanted, line_at(chip, offset));
    }
    const Values values = values_of(levels);
    if (gpiod_line_request_bulk_output(&wanted, consumer.c_str(), values.data()) != 0) {
        refuse_lines(chip, offsets, "an output", errno);
    }
    request_->lines = wanted;
}

OutputAccess::~OutputAccess() = default;

bool OutputAccess::write(std::uint64_t /*mask*/, std::uint64_t levels) noexcept {
    const Values values = values_of(levels);
    return gpiod_line_set_value_bulk(&request_->lines, values.data()) == 0;
}

struct InputAccess::Request : Bulk {
    std::array<unsigned, most_lines> offset{};
};

InputAccess::InputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                         std::span<const InputRequest> requests)
    : request_(std::make_unique<Request>()) {
    require_monotonic_events(chip);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        gpiod_line* const line = line_at(chip, offsets[i]);
        if (gpiod_line_request_both_edges_events_flags(line, consumer.c_str(), flags_of(requests[i].bias)) != 0) {
            refuse_lines(chip, offsets.subspan(i, 1), "an input with edges", errno);
        }
        gpiod_line_bulk_add(&request_->lines, line);
        request_->offset[i] = offsets[i];
    }
}

InputAccess::~InputAccess() = default;

std::optional<std::uint64_t> InputAccess::levels() noexcept {
    Values values{};
    if (gpiod_line_get_value_bulk(&request_->lines, values.data()) != 0) {
        return std::nullopt;
    }
    std::uint64_t levels = 0;
    for (unsigned i = 0; i < request_->lines.num_lines; ++i) {
        levels |= std::uint64_t{values[i] != 0 ? 1U : 0U} << i;
    }
    return levels;
}

int InputAccess::wait(std::span<InputEvent> out, std::uint64_t timeout_ns) noexcept {
    constexpr std::size_t most_events = 16; // that the kernel queues for a line
    const timespec timeout{static_cast<time_t>(timeout_ns / ns_per_s), static_cast<long>(timeout_ns % ns_per_s)};
    gpiod_line_bulk ready = GPIOD_LINE_BULK_INITIALIZER;
    const int any = gpiod_line_event_wait_bulk(&request_->lines, &timeout, &ready);
    if (any <= 0) {
        return any;
    }
    std::size_t count = 0;
    for (unsigned i = 0; i < ready.num_lines && count < out.size(); ++i) {
        std::array<gpiod_line_event, most_events> events{};
        const std::size_t room = std::min(most_events, out.size() - count);
        const int read = gpiod_line_event_read_multiple(ready.lines[i], events.data(), static_cast<unsigned>(room));
        if (read < 0) {
            return -1;
        }
        const auto* const line =
            std::find(request_->offset.begin(), request_->offset.end(), gpiod_line_offset(ready.lines[i]));
        for (std::size_t k = 0; k < static_cast<std::size_t>(read); ++k) {
            out[count++] = {.line = static_cast<std::uint8_t>(line - request_->offset.begin()),
                            .rising = events[k].event_type == GPIOD_LINE_EVENT_RISING_EDGE,
                            .time_ns = static_cast<std::uint64_t>(events[k].ts.tv_sec) * ns_per_s +
                                       static_cast<std::uint64_t>(events[k].ts.tv_nsec),
                            .missed = 0};
        }
    }
    return static_cast<int>(count);
}

} // namespace splinefeed::hal::gpio
