// SPDX-License-Identifier: MIT
#include "host_sim/analysis/limit_advice.hpp"

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

TEST_CASE("the advice names the limit that bound longest") {
    LimitShares shares = sample();
    CHECK(advice(names, shares) ==
          "The acceleration limit of axis x binds 41.0 % of the time, longest of all: raising it "
          "would help most.\n");
    shares.axis[1].jerk = 0.5;
    CHECK(advice(names, shares).find("The jerk limit of axis c binds 50.0 %") == 0);
    shares.axis[0].velocity = 0.51;
    CHECK(advice(names, shares).find("The velocity limit of axis x binds 51.0 %") == 0);
    shares.centripetal = 0.52;
    CHECK(advice(names, shares).find("The centripetal limit binds 52.0 %") == 0);
    shares.chord = 0.53;
    CHECK(advice(names, shares)
              .find("The chord error binds 53.0 % of the time, longest of all: a larger "
                    "chord_error_mm or a shorter sample period would") == 0);
    shares.feed = 0.9;
    CHECK(advice(names, shares).find("The machine's feed (max_feed_mm_s) binds 90.0 %") == 0);
    shares.programmed_feed = 0.5;
    CHECK(advice(names, shares).find("The feed of the program binds 90.0 %") == 0);
}

TEST_CASE("where no limit binds there is no advice to raise one") {
    LimitShares shares;
    shares.axis = {{0.005, 0.009, std::nullopt}};
    shares.none = 0.99;
    CHECK(advice({"x"}, shares) ==
          "No limit binds for more than 1.0 % of the time: the moves are too short to reach one.\n");
}
