// SPDX-License-Identifier: MIT
//
// The jerk limits are exact where a motion is as fast as expected; for a motion that is far slower they leave almost no
// room (controllable_set.cpp). Next to standstill b is far below what the accelerations allow: with constant jerk it
// grows with s^(4/3). This is expected first, then half as much, and so on, until there is a motion.
#include "splinefeed/s3_feed_plan/jerk_optimal/leg_attempts.hpp"

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

// Later attempts: the expected speeds after the old plan are halved; within it they are at least this part of
// at_most_sq.
constexpr double least_known[] = {0.1, 0.3, 0.5, 1.0, 0.02};
constexpr int attempts = 6;

// How fast b grows from standstill, from the first cell, or from the last one.
void expect_rest(std::span<JerkNode> nodes, bool at_end) noexcept {
    const std::size_t cells = nodes.size() - 1;
    const JerkCell& first = nodes[at_end ? cells - 1 : 0].cell;
    const double first_sq = first.largest_from_rest(at_end ? 0 : 1);
    const double per_length = 1.0 / first.length_mm;
    double s = 1.0; // in lengths of the first cell
    for (std::size_t i = 1; i < cells; ++i) {
        JerkNode& node = nodes[at_end ? cells - i : i];
        const double b = first_sq * power_two_thirds(s * s);
        if (b > node.most_sq) {
            return;
        }
        node.expected_sq = smaller(node.expected_sq, b);
        s += per_length * nodes[at_end ? cells - 1 - i : i].cell.length_mm;
    }
}

} // namespace

bool plan_leg(std::span<JerkNode> nodes, std::size_t known) noexcept {
    if (nodes.size() <= JerkLeg::fewest_cells) {
        return false;
    }
    const SpeedState start = nodes.front().state;
    const bool moves = start.b > 0.0;
    const double end_at_most = nodes.back().at_most_sq;
    nodes.back().at_most_sq = nodes.back().expected_sq = 0.0;
    if (!moves) {
        expect_rest(nodes, false);
    }
    expect_rest(nodes, true);
    bool done = false;
    for (int attempt = 0; attempt < attempts && !done; ++attempt) {
        done = JerkLeg(nodes, moves ? &start : nullptr, known).plan();
        for (std::size_t i = 1; i + 1 < nodes.size() && !done && attempt + 1 < attempts; ++i) {
            // If exactly the old plan is expected, it is possible again, except for its braking to the end.
            JerkNode& node = nodes[i];
            node.expected_sq =
                i < known ? larger(node.state.b, least_known[attempt] * node.at_most_sq) : 0.5 * node.expected_sq;
        }
    }
    nodes.back().at_most_sq = nodes.back().expected_sq = end_at_most;
    return done;
}

} // namespace splinefeed
