// SPDX-License-Identifier: MIT
#include "splinefeed/base/status.hpp"

#include "splinefeed/base/capacity.hpp"

#include "support/catch.hpp"

#include <string>

using namespace splinefeed;

TEST_CASE("Every error of the core has a sentence, which names no option of the host") {
    for (int error = 0; error <= static_cast<int>(Error::direction_change_too_long); ++error) {
        const std::string sentence = describe(static_cast<Error>(error));
        CAPTURE(error, sentence);
        CHECK(sentence != "unknown error");
        CHECK(sentence.size() > 7);
        CHECK(sentence.find("--") == std::string::npos);
    }
    CHECK(describe(static_cast<Error>(255)) == std::string("unknown error"));
    CHECK(describe(Error::axes_out_of_range) == "a machine has 1 to " + std::to_string(max_axes) + " axes");
}
