// SPDX-License-Identifier: MIT
#ifdef SPLINEFEED_HAS_GPIO
#include "gpio_access/fake_chip.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace splinefeed::hal::gpio {

using splinefeed_test::fake_chip;

struct ChipAccess::Handle {};

ChipAccess::ChipAccess(const std::string& path) : path_(path), handle_(std::make_unique<Handle>()) {}
ChipAccess::~ChipAccess() = default;

PinFacts ChipAccess::facts(unsigned offset) const {
    return {names()[offset], offset == 3 ? "other" : "", offset > 1};
}

std::vector<std::string> ChipAccess::names() const {
    return {"A", "B", "C", "D"};
}

std::string ChipAccess::label() const {
    return "fake";
}

struct OutputAccess::Request {};

OutputAccess::OutputAccess(const ChipAccess& chip, const std::string& consumer, std::span<const unsigned> offsets,
                           std::uint64_t levels) {
    if (consumer == "refused") {
        refuse_lines(chip, offsets, "an output", EBUSY);
    }
    if (consumer == "no outputs") {
        refuse_lines(chip, offsets, "an output", EPERM);
    }
    fake_chip = {};
    fake_chip.offsets.assign(offsets.begin(), offsets.end());
    fake_chip.requested_levels = levels;
}

OutputAccess::~OutputAccess() {
    fake_chip.released = true;
}

bool OutputAccess::write(std::uint64_t mask, std::uint64_t levels) noexcept {
    if (const auto between = std::exchange(fake_chip.between, nullptr)) {
        between();
    }
    if (fake_chip.write_error != 0) {
        errno = fake_chip.write_error;
        return false;
    }
    fake_chip.writes.push_back({mask, levels});
    return true;
}

struct InputAccess::Request {};

InputAccess::InputAccess(const ChipAccess& /*chip*/, const std::string& /*consumer*/, std::span<const unsigned> offsets,
                         std::span<const InputRequest> /*requests*/) {
    fake_chip = {};
    fake_chip.offsets.assign(offsets.begin(), offsets.end());
}

InputAccess::~InputAccess() = default;

std::optional<std::uint64_t> InputAccess::levels() noexcept {
    return 5;
}

int InputAccess::wait(std::span<InputEvent> out, std::uint64_t timeout_ns) noexcept {
    fake_chip.waited_ns = timeout_ns;
    if (fake_chip.wait_error != 0) {
        errno = fake_chip.wait_error;
        return -1;
    }
    const std::size_t count = std::min(out.size(), fake_chip.events.size());
    std::copy_n(fake_chip.events.begin(), count, out.begin());
    return static_cast<int>(count);
}

} // namespace splinefeed::hal::gpio
#endif
