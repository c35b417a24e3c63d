// SPDX-License-Identifier: MIT
#include "host_sim/config/machine_choice.hpp"

#include "temporary_folder.hpp"

#include "support/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace splinefeed::host;

namespace {

void write_machine(const std::filesystem::path& file) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "name = \"" << file.parent_path().filename().string()
                        << "\"\n[path]\nmax_feed_mm_s = 100\n[[axis]]\nname = \"x\"\nmax_velocity_mm_s = 100\n"
                           "max_acceleration_mm_s2 = 1000\n";
}

} // namespace

TEST_CASE("the machine is the named one, else beside the program, else the user's, else the default one") {
    const splinefeed_test::TemporaryFolder folder;
    const std::string program = folder.file("parts/part.ngc");
    REQUIRE(setenv("XDG_CONFIG_HOME", folder.file("none").c_str(), 1) == 0);
    REQUIRE(setenv("HOME", folder.file("home").c_str(), 1) == 0);
    const auto name = [&](const MachineChoice& choice) {
        return choose_machine(choice).name;
    };
    CHECK(name({"", {}, program}) == "default machine");
    CHECK(choose_machine({}).settings.axes == 3);
    CHECK(choose_machine({"", {"axis.z.max_velocity_mm_s=7"}}).settings.axis[2].max_velocity_mm_s == 7.0);
    write_machine(folder.file("home/.config/splinefeed/machine.toml"));
    CHECK(name({"", {}, program}) == "default machine"); // XDG_CONFIG_HOME counts
    REQUIRE(unsetenv("XDG_CONFIG_HOME") == 0);
    CHECK(name({"", {}, program}) == "splinefeed");
    CHECK(name({"", {}, "-"}) == "splinefeed");
    CHECK(name({"default", {}, program}) == "default machine");
    write_machine(folder.file("parts/machine.toml"));
    CHECK(name({"", {}, program}) == "parts");
    write_machine(folder.file("named/m.toml"));
    CHECK(name({folder.file("named/m.toml"), {}, program}) == "named");

    const MachineChoice found{"", {}, program};
    CHECK(note_of(found, choose_machine(found)) == "the machine is that of " + folder.file("parts/machine.toml") +
                                                       "; -m names another one, -m default the default one");
    const MachineChoice named{folder.file("named/m.toml"), {}, program};
    CHECK(note_of(named, choose_machine(named)).empty());
    CHECK(note_of({"default"}, choose_machine({"default"})).empty());
}
