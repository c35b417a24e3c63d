// SPDX-License-Identifier: MIT
#include "host_sim/base/option_number.hpp"

#include "host/refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed_test::refusal_of;

namespace {

std::string refused_number(std::string_view text) {
    return refusal_of<UsageError>([&] { static_cast<void>(read_option_number("--ring", text, -1.5, 64.0)); });
}

std::string refused_integer(std::string_view text) {
    return refusal_of<UsageError>([&] { static_cast<void>(read_option_integer("--axes", text, 1, 6)); });
}

} // namespace

TEST_CASE("The number of an option: from its lowest to its highest value, both included") {
    CHECK(read_option_number("--ring", "-1.5", -1.5, 64.0) == -1.5);
    CHECK(read_option_number("--ring", "+6.4e1", -1.5, 64.0) == 64.0);
    CHECK(read_option_integer("--axes", "1", 1, 6) == 1);
    CHECK(read_option_integer("--axes", "6.0", 1, 6) == 6);
}

TEST_CASE("The number of an option: what is refused, and what would be right") {
    CHECK(refused_number("") == "--ring '' is not a number; write it like -12.5 or 3e-2");
    CHECK(refused_number("12mm") == "--ring '12mm' is not a number; write it like -12.5 or 3e-2");
    CHECK(refused_number("nan") == "--ring 'nan' is not finite; every number must be");
    CHECK(refused_number("1e999") == "--ring '1e999' is out of the range of a number");
    CHECK(refused_number("64.01") == "--ring '64.01' is out of range; it must lie between -1.5 and 64");
    CHECK(refused_number("-1.6") == "--ring '-1.6' is out of range; it must lie between -1.5 and 64");
    CHECK(refused_integer("2.5") == "--axes '2.5': it must be a whole number from 1 to 6");
    CHECK(refused_integer("7") == "--axes '7' is out of range; it must lie between 1 and 6");
    CHECK(refusal_of<UsageError>([] {
              static_cast<void>(read_option_number("--mu", "9", 0.0, 1.0, "each of them"));
          }) == "--mu '9' is out of range; each of them must lie between 0 and 1");
}
