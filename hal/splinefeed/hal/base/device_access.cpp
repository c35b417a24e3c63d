// SPDX-License-Identifier: MIT
#include "splinefeed/hal/base/device_access.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <grp.h>
#include <sys/stat.h>
#include <system_error>
#include <vector>

namespace splinefeed::hal {

std::string devices_here(std::initializer_list<std::string_view> prefixes) {
    std::vector<std::string> devices;
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator("/dev", error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (std::any_of(prefixes.begin(), prefixes.end(),
                        [&](std::string_view prefix) { return name.rfind(prefix, 0) == 0; })) {
            devices.push_back(entry->path().string());
        }
    }
    std::sort(devices.begin(), devices.end());
    std::string text;
    for (const std::string& device : devices) {
        text += (text.empty() ? "" : ", ") + device;
    }
    return text;
}

std::string who_may_open(const std::string& path, std::string_view subsystem, std::string_view group) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        return "run as root";
    }
    std::array<char, 4096> names{};
    struct group entry {};
    struct group* found = nullptr;
    const bool named = getgrgid_r(status.st_gid, &entry, names.data(), names.size(), &found) == 0 && found != nullptr;
    const std::string name = named ? entry.gr_name : "number " + std::to_string(status.st_gid);
    constexpr mode_t both = S_IRGRP | S_IWGRP;
    if (status.st_gid == 0 || (status.st_mode & both) != both) {
        return "only root may; run as root, or give it a group by a udev rule like SUBSYSTEM==\"" +
               std::string(subsystem) + "\", GROUP=\"" + std::string(group) + "\", MODE=\"0660\"";
    }
    return "group " + name + " may; become a member by 'sudo usermod -aG " + name +
           " $USER' and log in again, or run as root";
}

} // namespace splinefeed::hal
