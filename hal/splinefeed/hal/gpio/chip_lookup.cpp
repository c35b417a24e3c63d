// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include "splinefeed/hal/gpio/chip_access.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace splinefeed::hal::gpio {

std::string path_of(std::string_view label, std::span<const ChipName> chips) {
    std::string all;
    const ChipName* found = nullptr;
    for (const ChipName& chip : chips) {
        all += (all.empty() ? "" : ", ") + chip.path + " ('" + chip.label + "')";
        if (chip.label == label && found != nullptr) {
            throw GpioError(found->path + " and " + chip.path + " are both labelled '" + std::string(label) +
                            "'; name the one that is meant by its path");
        }
        found = chip.label == label ? &chip : found;
    }
    if (found == nullptr) {
        throw GpioError("there is no GPIO chip with the label '" + std::string(label) + "'; " +
                        (all.empty() ? "this machine has none that may be opened" : "this machine has " + all));
    }
    return found->path;
}

// A chip that may not be opened is none of ours.
std::string find_chip(const std::string& chip) {
    if (!chip.starts_with(label_prefix)) {
        return chip;
    }
    std::vector<ChipName> chips;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator("/dev", none)) {
        if (entry.path().filename().string().starts_with("gpiochip")) {
            try {
                chips.push_back({entry.path().string(), ChipAccess(entry.path().string()).label()});
            } catch (const GpioError&) {
                continue;
            }
        }
    }
    std::ranges::sort(chips, {}, &ChipName::path);
    return path_of(std::string_view(chip).substr(label_prefix.size()), chips);
}

} // namespace splinefeed::hal::gpio
