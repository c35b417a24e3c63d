// SPDX-License-Identifier: MIT

#include "host_sim/base/scalar_kind.hpp"
#include "refusal.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

TEST_CASE("a word that an option does not take is told with those that it takes, and the nearest") {
    const auto refused = [](const char* word) {
        return splinefeed_test::refusal_of<UsageError>([word] {
            static_cast<void>(read_scalar("--scalar", word, {"double", "float"}));
        });
    };
    CHECK(refused("double") == "accepted");
    CHECK(refused("flaot") == "--scalar 'flaot': it must be one of double, float; did you mean 'float'?");
    CHECK(refused("fixed") == "--scalar 'fixed': it must be one of double, float");
    CHECK(read_scalar("--scalar", "float", {"double", "float"}) == ScalarKind::float32);
}
