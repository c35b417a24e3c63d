// SPDX-License-Identifier: MIT
// Error messages for chips and lines that cannot be opened or requested.
#include "splinefeed/hal/gpio/chip_access.hpp"
#include "splinefeed/hal/gpio/line_lookup.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <grp.h>
#include <sys/stat.h>
#include <system_error>

namespace splinefeed::hal::gpio {

namespace {

std::string chips_here() {
    std::vector<std::string> chips;
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator("/dev", error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        if (entry->path().filename().string().rfind("gpiochip", 0) == 0) {
            chips.push_back(entry->path().string());
        }
    }
    std::sort(chips.begin(), chips.end());
    std::string text;
    for (const std::string& chip : chips) {
        text += (text.empty() ? "" : ", ") + chip;
    }
    return text.empty() ? "this machine has no GPIO chip (no /dev/gpiochip*)" : "this machine has " + text;
}

// Which user or group may open the chip, and how to get the permission.
std::string permission(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        return "run as root";
    }
    std::array<char, 4096> names{};
    struct group group {};
    struct group* found = nullptr;
    const bool named = getgrgid_r(status.st_gid, &group, names.data(), names.size(), &found) == 0 && found != nullptr;
    const std::string name = named ? group.gr_name : "number " + std::to_string(status.st_gid);
    constexpr mode_t both = S_IRGRP | S_IWGRP;
    if (status.st_gid == 0 || (status.st_mode & both) != both) {
        return "only root may; run as root, or give it a group by a udev rule like SUBSYSTEM==\"gpio\", "
               "GROUP=\"gpio\", MODE=\"0660\"";
    }
    return "group " + name + " may; become a member by 'sudo usermod -aG " + name +
           " $USER' and log in again, or run as root";
}

std::string reason(int error) {
    return std::generic_category().message(error);
}

} // namespace

void refuse_chip(const std::string& path, int error) {
    switch (error) {
    case ENOENT: throw GpioError("there is no " + path + "; " + chips_here());
    case EACCES:
    case EPERM: throw GpioError("no permission to open " + path + ": " + permission(path));
    case ENOTTY:
    case EINVAL:
    case ENOTDIR:
    case ENODEV:
    case ENXIO:
    case EISDIR: throw GpioError(path + " is not a GPIO chip; " + chips_here());
    default: throw GpioError("cannot open " + path + ": " + reason(error) + "; is it a GPIO chip that is still there?");
    }
}

void refuse_lines(const ChipAccess& chip, std::span<const unsigned> offsets, const char* what, int error) {
    std::string lines;
    for (const unsigned offset : offsets) {
        const LineFacts facts = chip.facts(offset);
        if (error == EBUSY && facts.used) {
            throw GpioError(line_text(offset, facts.name) + " of " + chip.path() + " is in use by " +
                            (facts.consumer.empty() ? "an unnamed consumer" : "'" + facts.consumer + "'") +
                            "; stop that, or take another line");
        }
        lines += (lines.empty() ? "" : ", ") + line_text(offset, facts.name);
    }
    throw GpioError(lines + " of " + chip.path() + " cannot become " + what + ": " + reason(error) +
                    "; take lines that can, or another chip");
}

} // namespace splinefeed::hal::gpio
