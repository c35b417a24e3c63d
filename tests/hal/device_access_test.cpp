// SPDX-License-Identifier: MIT
#include "splinefeed/hal/base/device_access.hpp"

#include "support/catch.hpp"

#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

using splinefeed::hal::devices_here;
using splinefeed::hal::who_may_open;

TEST_CASE("Devices: the group that may open one is the way in; without one, a rule is") {
    const std::string path = std::filesystem::temp_directory_path() / ("splinefeed-device-" + std::to_string(getpid()));
    std::ofstream(path).put('x');
    REQUIRE(chmod(path.c_str(), 0660) == 0);
    constexpr gid_t unnamed = 54321;
    if (chown(path.c_str(), 0, unnamed) == 0) { // of root alone
        CHECK(
            who_may_open(path, "tty", "dialout").rfind("group number 54321 may; become a member by 'sudo usermod", 0) ==
            0);
    }
    REQUIRE(chmod(path.c_str(), 0600) == 0);
    CHECK(who_may_open(path, "tty", "dialout") == "only root may; run as root, or give it a group by a udev rule like "
                                                  "SUBSYSTEM==\"tty\", GROUP=\"dialout\", MODE=\"0660\"");
    std::filesystem::remove(path);
    CHECK(who_may_open(path, "tty", "dialout") == "run as root");
}

TEST_CASE("Devices: those that are there, by their names") {
    CHECK(devices_here({"nul"}) == "/dev/null");
    CHECK(devices_here({"no-such-device"}).empty());
}
