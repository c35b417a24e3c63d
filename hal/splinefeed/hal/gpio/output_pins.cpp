// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/output_pins.hpp"

#include "splinefeed/hal/gpio/chip_access.hpp"
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include <cerrno>

namespace splinefeed::hal::gpio {

namespace {

std::uint64_t mask_of(int size) {
    return ~std::uint64_t{0} >> (most_lines - static_cast<unsigned>(size));
}

} // namespace

struct OutputPins::Pins {
    Pins(const std::string& path, const std::string& consumer, std::span<const OutputRequest> requests)
        : chip(find_chip(path)), output(chip, consumer, offsets_of(chip, requests), safe_levels_of(requests)) {}

    ChipAccess chip;
    OutputAccess output;
};

// A signal handler must not take a lock.
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free);

OutputPins::OutputPins(const std::string& chip, const std::string& consumer, std::span<const OutputRequest> requests)
    : lines_(std::make_unique<Pins>(chip, consumer, requests)), size_(static_cast<int>(requests.size())),
      safe_levels_(safe_levels_of(requests)), levels_(safe_levels_.load()) {}

OutputPins::~OutputPins() {
    make_safe();
}

bool OutputPins::set(std::uint64_t mask, std::uint64_t levels) noexcept {
    if (mask == 0) {
        return true; // the kernel refuses an empty set
    }
    const std::uint32_t before = times_made_safe_.load();
    const std::uint64_t next = (levels_.load() & ~mask) | (levels & mask);
    if (!lines_->output.write(mask, next)) {
        return false;
    }
    levels_.store(next);
    if (times_made_safe_.load() == before) {
        return true;
    }
    // make_safe() ran during our write, and our levels may have been written last: write the safe levels again.
    levels_.store(safe_levels_.load());
    if (lines_->output.write(mask_of(size_), safe_levels_.load())) {
        errno = ECANCELED;
    }
    return false;
}

void OutputPins::make_safe() noexcept {
    const int before = errno;
    times_made_safe_.fetch_add(1); // first, so that a concurrent set() notices it
    levels_.store(safe_levels_.load());
    lines_->output.write(mask_of(size_), safe_levels_.load());
    errno = before;
}

void OutputPins::retain_levels(std::uint64_t mask) noexcept {
    safe_levels_.store((safe_levels_.load() & ~mask) | (levels_.load() & mask));
}

} // namespace splinefeed::hal::gpio
