// SPDX-License-Identifier: MIT
// ChipAccess, OutputAccess and InputAccess for libgpiod 2.x: one request for all outputs, and one for all inputs.
#include "splinefeed/hal/gpio/chip_access.hpp"
#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <gpiod.h>
#include <new>

namespace splinefeed::hal::gpio {

namespace {

/// Deleter of an object of libgpiod.
template <class Object, void (*Free)(Object*)>
struct Freed {
    void operator()(Object* object) const noexcept { Free(object); }
};
template <class Object, void (*Free)(Object*)>
using Owned = std::unique_ptr<Object, Freed<Object, Free>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using ChipInfo = Owned<gpiod_chip_info, gpiod_chip_info_free>;
using LineInfo = Owned<gpiod_line_info, gpiod_line_info_free>;
using LineSettings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using LineRequest = Owned<gpiod_line_request, gpiod_line_request_release>;
using EventBuffer = Owned<gpiod_edge_event_buffer, gpiod_edge_event_buffer_free>;

// libgpiod's constructors fail only if memory is exhausted.
template <class Pointer>
Pointer made(Pointer pointer) {
    if (pointer == nullptr) {
        throw std::bad_alloc();
    }
    return pointer;
}

using Values = std::array<gpiod_line_value, most_lines>;
using Offsets = std::array<unsigned, most_lines>;

gpiod_line_value value_of(std::uint64_t levels, unsigned bit) noexcept {
    return (levels >> bit & 1U) != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

gpiod_line_bias bias_of(Bias bias) {
    switch (bias) {
    case Bias::disabled: return GPIOD_LINE_BIAS_DISABLED;
    case Bias::pull_up: return GPIOD_LINE_BIAS_PULL_UP;
    case Bias::pull_down: return GPIOD_LINE_BIAS_PULL_DOWN;
    case Bias::as_is: break;
    }
    return GPIOD_LINE_BIAS_AS_IS;
}

// Makes a line configuration; set_line(i, settings) completes the settings of line i.
template <class SetLine>
LineConfig config_of(std::span<const unsigned> offsets, const SetLine& set_line) {
    const LineSettings settings(made(gpiod_line_settings_new()));
    LineConfig config(made(gpiod_line_config_new()));
    for (unsigned i = 0; i < offsets.size(); ++i) {
        gpiod_line_settings_reset(settings.get());
        if (set_line(i, settings.get()) != 0 ||
            gpiod_line_config_add_line_settings(config.get(), &offsets[i], 1, settings.get()) != 0) {
            throw std::bad_alloc();
        }
    }
    return config;
}

LineRequest requested(gpiod_chip* chip, const std::string& consumer, std::size_t events, gpiod_line_config* lines) {
    const RequestConfig config(made(gpiod_request_config_new()));
    gpiod_request_config_set_consumer(config.get(), consumer.c_str());
    gpiod_request_config_set_event_buffer_size(config.get(), events);
    return LineRequest(gpiod_chip_request_lines(chip, config.get(), lines));
}

} // namespace

struct ChipAccess::Handle {
    explicit Handle(const std::string& path) : chip(gpiod_chip_open(path.c_str())) {
        if (chip == nullptr) {
            refuse_chip(path, errno);
        }
    }

    Chip chip;
};

ChipAccess::ChipAccess(const std::string& path) : path_(path), handle_(std::make_unique<Handle>(path)) {}

ChipAccess::~ChipAccess() = default;

PinFacts ChipAccess::facts(unsigned offset) const {
    const LineInfo info(gpiod_chip_get_line_info(handle_->chip.get(), offset));
    if (info == nullptr) {
        refuse_chip(path_, errno);
    }
    const char* const name = gpiod_line_info_get_name(info.get());
    const char* const consumer = gpiod_line_info_get_consumer(info.get());
    return {name != nullptr ? name : "", consumer != nullptr ? consumer : "", gpiod_line_info_is_used(info.get())};
}

std::string ChipAccess::label() const {
    const ChipInfo info(gpiod_chip_get_info(handle_->chip.get()));
    if (info == nullptr) {
        refuse_chip(path_, errno);
    }
    return gpiod_chip_info_get_label(info.get());
}

std::vector<std::string> ChipAccess::names() const {
    const ChipInfo info(gpiod_chip_get_info(handle_->chip.get()));
    if (info == nullptr) {
        refuse_chip(path_, errno);
    }
    std::vector<std::string> out;
    for (unsigned offset = 0; offset < gpiod_chip_info_get_num_lines(info.get()); ++offset) {
        out.push_back(facts(offset).name);
    }
    return out;
}

struct OutputAccess::Request {
    LineRequest lines;
    Offsets offset{};
    unsigned count = 0;
};

OutputAccess::OutputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                           std::uint64_t levels)
    : request_(std::make_unique<Request>()) {
    const LineConfig config = config_of(offsets, [&](unsigned i, gpiod_line_settings* settings) {
        const int direction = gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
        return direction != 0 ? direction : gpiod_line_settings_set_output_value(settings, value_of(levels, i));
    });
    request_->lines = requested(chip.handle().chip.get(), consumer, 0, config.get());
    if (request_->lines == nullptr) {
        refuse_lines(chip, offsets, "an output", errno);
    }
    std::copy(offsets.begin(), offsets.end(), request_->offset.begin());
    request_->count = static_cast<unsigned>(offsets.size());
}

OutputAccess::~OutputAccess() = default;

bool OutputAccess::write(std::uint64_t mask, std::uint64_t levels) noexcept {
    Offsets offset; // not cleared, to save time for every edge: only the first `count` are used
    Values values;
    unsigned count = 0;
    for (unsigned i = 0; i < request_->count; ++i) {
        if ((mask >> i & 1U) != 0) {
            offset[count] = request_->offset[i];
            values[count] = value_of(levels, i);
            ++count;
        }
    }
    return gpiod_line_request_set_values_subset(request_->lines.get(), count, offset.data(), values.data()) == 0;
}

struct InputAccess::Request {
    LineRequest lines;
    EventBuffer events;
    Offsets offset{};
    std::array<std::uint32_t, most_lines> last_event{}; ///< last sequence number of each line; the kernel counts from 1
    unsigned count = 0;
};

InputAccess::InputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                         std::span<const InputRequest> requests)
    : request_(std::make_unique<Request>()) {
    constexpr std::size_t most_kept = 1024; // the kernel's limit
    const LineConfig config = config_of(offsets, [&](unsigned i, gpiod_line_settings* settings) {
        // Defaults: no debouncing, CLOCK_MONOTONIC.
        const int direction = gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
        const int edges = gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
        const int bias = gpiod_line_settings_set_bias(settings, bias_of(requests[i].bias));
        return direction != 0 ? direction : edges != 0 ? edges : bias;
    });
    request_->events.reset(made(gpiod_edge_event_buffer_new(most_lines)));
    request_->lines = requested(chip.handle().chip.get(), consumer, most_kept, config.get());
    if (request_->lines == nullptr) {
        refuse_lines(chip, offsets, "an input with edges", errno);
    }
    std::copy(offsets.begin(), offsets.end(), request_->offset.begin());
    request_->count = static_cast<unsigned>(offsets.size());
}

InputAccess::~InputAccess() = default;

std::optional<std::uint64_t> InputAccess::levels() noexcept {
    Values values{};
    if (gpiod_line_request_get_values(request_->lines.get(), values.data()) != 0) {
        return std::nullopt;
    }
    std::uint64_t levels = 0;
    for (unsigned i = 0; i < request_->count; ++i) {
        levels |= std::uint64_t{values[i] == GPIOD_LINE_VALUE_ACTIVE ? 1U : 0U} << i;
    }
    return levels;
}

int InputAccess::wait(std::span<InputEvent> out, std::uint64_t timeout_ns) noexcept {
    const int any = gpiod_line_request_wait_edge_events(request_->lines.get(), static_cast<std::int64_t>(timeout_ns));
    if (any <= 0) {
        return any;
    }
    const int count = gpiod_line_request_read_edge_events(request_->lines.get(), request_->events.get(), out.size());
    for (int k = 0; k < count; ++k) {
        gpiod_edge_event* const event =
            gpiod_edge_event_buffer_get_event(request_->events.get(), static_cast<unsigned long>(k));
        const auto* const line = std::find(request_->offset.begin(), request_->offset.begin() + request_->count,
                                           gpiod_edge_event_get_line_offset(event));
        const auto index = static_cast<std::size_t>(line - request_->offset.begin());
        const auto number = static_cast<std::uint32_t>(gpiod_edge_event_get_line_seqno(event));
        out[static_cast<std::size_t>(k)] = {.line = static_cast<std::uint8_t>(index),
                                            .rising =
                                                gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE,
                                            .time_ns = gpiod_edge_event_get_timestamp_ns(event),
                                            .missed = number - request_->last_event[index] - 1};
        request_->last_event[index] = number;
    }
    return count;
}

} // namespace splinefeed::hal::gpio
