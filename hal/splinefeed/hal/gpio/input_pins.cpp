// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/input_pins.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/gpio/chip_access.hpp"
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include <cerrno>
#include <utility>

namespace splinefeed::hal::gpio {

namespace {

// Insertion sort: the events are few and nearly sorted, and no allocation is allowed.
void sort_by_time(std::span<InputEvent> events) noexcept {
    for (std::size_t i = 1; i < events.size(); ++i) {
        for (std::size_t j = i; j > 0 && events[j].time_ns < events[j - 1].time_ns; --j) {
            std::swap(events[j], events[j - 1]);
        }
    }
}

} // namespace

struct InputPins::Pins {
    Pins(const std::string& path, const std::string& consumer, std::span<const InputRequest> requests)
        : chip(find_chip(path)), input(chip, consumer, offsets_of(chip, requests), requests) {}

    ChipAccess chip;
    InputAccess input;
};

InputPins::InputPins(const std::string& chip, const std::string& consumer, std::span<const InputRequest> requests)
    : lines_(std::make_unique<Pins>(chip, consumer, requests)), size_(static_cast<int>(requests.size())) {}

InputPins::~InputPins() = default;

std::optional<std::uint64_t> InputPins::levels() noexcept {
    return lines_->input.levels();
}

int InputPins::wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept {
    if (out.empty()) {
        errno = EINVAL;
        return -1;
    }
    const int count = lines_->input.wait(out, std::uint64_t{timeout_us} * ns_per_us);
    if (count < 0) {
        return errno == EINTR ? 0 : -1;
    }
    sort_by_time(out.first(static_cast<std::size_t>(count)));
    return count;
}

} // namespace splinefeed::hal::gpio
