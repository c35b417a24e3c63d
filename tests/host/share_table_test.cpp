// SPDX-License-Identifier: MIT
#include "host_sim/analysis/share_table.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

const std::vector<std::string> names{"x", "c"};

LimitShares sample() {
    LimitShares shares;
    shares.axis = {{0.1, 0.41, std::nullopt}, {0.0, 0.2, 0.05}};
    shares.feed = 0.3;
    shares.none = 0.125;
    return shares;
}

} // namespace

TEST_CASE("the table has a row per axis and one for each limit of the path") {
    LimitShares shares = sample();
    CHECK(share_table(names, shares) == "share of the time at        velocity  acceleration          jerk\n"
                                        "  axis x                      10.0 %        41.0 %      no limit\n"
                                        "  axis c                       0.0 %        20.0 %         5.0 %\n"
                                        "  path feed                   30.0 %\n"
                                        "  no limit                    12.5 %\n");
    shares.axis[1].jerk.reset();
    shares.centripetal = 0.02;
    shares.chord = 0.0;
    CHECK(share_table(names, shares) == "share of the time at        velocity  acceleration\n"
                                        "  axis x                      10.0 %        41.0 %\n"
                                        "  axis c                       0.0 %        20.0 %\n"
                                        "  path feed                   30.0 %\n"
                                        "  centripetal                  2.0 %\n"
                                        "  chord error                  0.0 %\n"
                                        "  no limit                    12.5 %\n");
}
