// SPDX-License-Identifier: MIT
//
// Of all who search in one scratch, only the last one who took it does.
#include "support/catch.hpp"

#include "splinefeed/s3_feed_plan/jerk/leg_lease.hpp"

#include <array>
#include <type_traits>

using namespace splinefeed;

static_assert(!std::is_copy_constructible_v<LegLease<double>> && !std::is_move_constructible_v<LegLease<double>>);
static_assert(!std::is_copy_constructible_v<LegScratch<double>>);

TEST_CASE("who takes the scratch ends the search of who had it", "[jerk][leg_lease]") {
    std::array<LegNode<double>, 9> nodes;
    LegScratch<double> scratch(nodes);
    LegLease<double> first(scratch);
    LegLease<double> second(scratch);
    CHECK_FALSE((first.held() || second.held()));
    first.take();
    CHECK((first.held() && !second.held()));
    second.take();
    CHECK((second.held() && !first.held()));
    first.give_back(); // it has nothing to give
    CHECK(second.held());
    second->begin({});
    CHECK(second->cells() == 0);
    second.give_back();
    CHECK_FALSE((first.held() || second.held()));
}
