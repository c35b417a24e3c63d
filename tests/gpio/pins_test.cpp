// SPDX-License-Identifier: MIT
//
// What of OutputPins and InputPins can be seen without a chip: what they say where there is none.
#ifdef SPLINEFEED_HAS_GPIO
#include "splinefeed/hal/gpio/input_pins.hpp"
#include "splinefeed/hal/gpio/output_pins.hpp"

#include "host/refusal.hpp"
#include "host/temporary_folder.hpp"
#include "support/catch.hpp"

#include <sys/stat.h>
#include <unistd.h>

using namespace splinefeed::hal::gpio;

namespace {

std::string output_refusal(const std::string& chip) {
    const std::vector<OutputRequest> requests{{{"X_STEP", {}}, false}};
    return splinefeed_test::refusal_of<GpioError>([&] { OutputPins(chip, "test", requests); });
}

std::string input_refusal(const std::string& chip) {
    const std::vector<InputRequest> requests{{{"", 4}, Bias::pull_up}};
    return splinefeed_test::refusal_of<GpioError>([&] { InputPins(chip, "test", requests); });
}

} // namespace

TEST_CASE("GPIO lines: a chip that is not there is told with those that are") {
    for (const std::string& refusal : {output_refusal("/dev/gpiochip4711"), input_refusal("/dev/gpiochip4711")}) {
        INFO(refusal);
        CHECK(refusal.find("there is no /dev/gpiochip4711; this machine has ") == 0);
        CHECK(refusal.find('\n') == std::string::npos);
    }
}

TEST_CASE("GPIO lines: what is there, and is no chip") {
    const splinefeed_test::TemporaryFolder folder;
    std::ofstream(folder.file("text")) << "no chip\n";
    for (const std::string& path : {std::string("/dev/null"), std::string("/tmp"), folder.file("text")}) {
        INFO(path);
        CHECK(output_refusal(path).find(path + " is not a GPIO chip; this machine has ") == 0);
        CHECK(input_refusal(path).find(path + " is not a GPIO chip; this machine has ") == 0);
    }
}

TEST_CASE("GPIO lines: a chip that one may not open is told with the group that may") {
    if (geteuid() != 0) {
        WARN("SKIPPED: only root can make a file of another group");
        return;
    }
    const splinefeed_test::TemporaryFolder folder;
    const std::string chip = folder.file("gpiochip0");
    std::ofstream(chip) << "";
    constexpr gid_t audio = 29; // of every Debian
    constexpr uid_t nobody = 65534;
    REQUIRE(chown(chip.c_str(), 0, audio) == 0);
    REQUIRE(chmod(chip.c_str(), 0660) == 0);
    REQUIRE(chmod(folder.file(".").c_str(), 0755) == 0);
    REQUIRE(seteuid(nobody) == 0);
    const std::string refusal = output_refusal(chip);
    const bool back = seteuid(0) == 0;
    REQUIRE(back);
    INFO(refusal);
    // libgpiod 2.x looks at what it is before it opens it.
    const std::string expected = SPLINEFEED_HAS_GPIO == 2 ? chip + " is not a GPIO chip"
                                                          : "no permission to open " + chip + ": group audio may; ";
    CHECK(refusal.find(expected) == 0);
    if (SPLINEFEED_HAS_GPIO == 1) {
        REQUIRE(chmod(chip.c_str(), 0600) == 0);
        REQUIRE(seteuid(nobody) == 0);
        const std::string of_root = output_refusal(chip);
        REQUIRE(seteuid(0) == 0);
        INFO(of_root);
        CHECK(of_root.find("only root may; run as root, or give it a group") != std::string::npos);
    }
}
#endif
