// SPDX-License-Identifier: MIT
//
// What limits b = (ds/dt)^2 at a point whatever a = d2s/dt2 is there. An axis accelerates by q' a + q'' b, so two axes
// j, k with |q' a + q'' b| <= A leave room for an a if, and only if (eliminate a),
//
//   |q'_j q''_k - q'_k q''_j| b <= A_j |q'_k| + A_k |q'_j|
//
// and all axes together do if every two do (intervals on a line). For an axis at its turning point, q'_k = 0, that is
// |q''_k| b <= A_k.
#include "host_sim/analysis/path_grid.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double most_turn = 0.05;        // of dq/ds in an interval
constexpr double most_speed_ratio = 0.85; // of the speed limits at the ends of an interval
constexpr double most_bend = 0.002;       // of dq/ds: what its mean in an interval differs from that of the ends
constexpr double most_error = 1e-5;       // of the length, by the rule of order 5
constexpr int least_level = 2;            // halvings of a curved segment
constexpr int least_level_of_long = 4;    // the same of one longer than a quarter of the braking distance
constexpr int deepest_for_speed = 8;
constexpr int deepest = 20;
constexpr double cusp_cosine = 0.5; // a sharper turn that no halving resolves is a cusp

// What the plan's arithmetic adds to a direction.
constexpr double direction_error = 1e-9;
constexpr double direction_error_of_float = 1e-6;

// Rounding of a difference of two positions.
constexpr double travel_noise_mm = 1e-12;
constexpr double relative_noise = 1e-15;

} // namespace

PathGrid::PathGrid(const MachineSettings& machine, double direction_jump, ScalarKind scalar)
    : machine_(machine), axes_(static_cast<unsigned>(machine.axes)), direction_jump_(direction_jump),
      direction_error_(scalar == ScalarKind::float32 ? direction_error_of_float : direction_error),
      negligible_units_(scalar == ScalarKind::float32 ? to_double(negligible_units<float>) : negligible_units<double>) {
    const double period_s = machine.sample_period_us * 1e-6;
    chord_mm_s2_ = 8.0 * machine.chord_error_mm / (period_s * period_s);
    softest_mm_s2_ = machine.axis[0].smaller_acceleration_mm_s2();
    for (unsigned k = 0; k < axes_; ++k) {
        softest_mm_s2_ = std::min(softest_mm_s2_, machine.axis[k].smaller_acceleration_mm_s2());
        const double turning = machine.axis[k].rotary ? machine.axis[k].max_velocity_mm_s : 0.0;
        turning_sq_ += turning * turning;
    }
}

// At the instant at which an axis turns round it may do either.
double PathGrid::acceleration(unsigned k, double slope, bool speeding) const noexcept {
    const AxisSettings& axis = machine_.axis[k];
    return slope == 0.0 ? axis.larger_acceleration_mm_s2()
           : speeding   ? axis.max_acceleration_mm_s2
                        : axis.braking_mm_s2();
}

// The feed counts linear axes, and rotary ones in a segment in which these stand.
double PathGrid::feed_cap_sq(const PerAxis<double>& q1) const noexcept {
    const double linear_sq =
        sum_of(machine_.axes, [&](unsigned k) { return machine_.axis[k].rotary ? 0.0 : q1[k] * q1[k]; });
    return linear_sq * fastest_sq_ > feed_sq_ ? feed_sq_ / linear_sq : fastest_sq_;
}

double PathGrid::cap_sq(const PerAxis<double>& q1, const PerAxis<double>& q2) const noexcept {
    double cap = fastest_sq_ > feed_sq_ ? feed_cap_sq(q1) : feed_sq_;
    double curvature_sq = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        const double limit = machine_.axis[k].max_velocity_mm_s;
        if (q1[k] * q1[k] * cap > limit * limit) {
            cap = limit * limit / (q1[k] * q1[k]);
        }
        curvature_sq += q2[k] * q2[k];
        for (unsigned j = 0; j < k; ++j) {
            // Positive: forward along k and against the motion of j; seen from axes that move forward
            const double turn = std::fabs(q1[j]) * std::copysign(1.0, q1[k]) * q2[k] -
                                std::fabs(q1[k]) * std::copysign(1.0, q1[j]) * q2[j];
            const double room = acceleration(j, q1[j], turn < 0.0) * std::fabs(q1[k]) +
                                acceleration(k, q1[k], turn > 0.0) * std::fabs(q1[j]);
            const double demand = std::fabs(turn);
            if (demand * cap > room) {
                cap = room / demand;
            }
        }
    }
    const double curvature = std::sqrt(curvature_sq);
    for (const double limit : {machine_.centripetal_mm_s2, chord_mm_s2_}) {
        if (limit > 0.0 && curvature * cap > limit) {
            cap = limit / curvature;
        }
    }
    return cap;
}

PathGrid::Node PathGrid::node(double u) const noexcept {
    Node node;
    node.u = u;
    PerAxis<double> first{};
    PerAxis<double> second{};
    double sigma_sq = 0.0;
    double product = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        const PerDegree<double>& power = power_[k];
        double r = power[degree_];
        double r1 = 0.0;
        double half_r2 = 0.0;
        for (unsigned i = degree_; i-- > 0;) {
            half_r2 = half_r2 * u + r1;
            r1 = r1 * u + r;
            r = r * u + power[i];
        }
        node.position[k] = r;
        first[k] = r1;
        second[k] = 2.0 * half_r2;
        sigma_sq += r1 * r1;
        product += r1 * second[k];
    }
    node.sigma = std::sqrt(sigma_sq);
    if (!(node.sigma > relative_noise * size_mm_)) {
        node.cap_sq = fastest_sq_; // nothing is known of the direction
        return node;
    }
    node.slope = product / node.sigma;
    const double per_sigma = 1.0 / node.sigma;
    for (unsigned k = 0; k < axes_; ++k) {
        node.direction[k] = first[k] * per_sigma;
        node.curvature[k] = (second[k] - node.direction[k] * node.slope) * per_sigma * per_sigma;
    }
    node.cap_sq = cap_sq(node.direction, node.curvature);
    return node;
}

double PathGrid::sigma(double u) const noexcept {
    double sigma_sq = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        double r1 = 0.0;
        for (unsigned i = degree_; i > 0; --i) {
            r1 = r1 * u + i * power_[k][i];
        }
        sigma_sq += r1 * r1;
    }
    return std::sqrt(sigma_sq);
}

PathInterval PathGrid::interval(const Node& from, const Node& to) const noexcept {
    PathInterval out;
    out.entry_cap_sq = from.cap_sq;
    out.exit_cap_sq = to.cap_sq;
    // The integral of the quartic through |dr/du| at three places and its slopes at the ends, of order 7; and no
    // shorter than the chord.
    const double step = to.u - from.u;
    const double ends = 7.0 * (from.sigma + to.sigma);
    out.length_mm = step * (ends + 16.0 * sigma(from.u + 0.5 * step) + 0.5 * step * (from.slope - to.slope)) / 30.0;
    const PerAxis<double> chord = difference(to.position, from.position, machine_.axes);
    out.length_mm = std::max(out.length_mm, std::sqrt(dot(chord, chord, machine_.axes)));
    PerAxis<double> direction{};
    PerAxis<double> curvature{};
    for (unsigned k = 0; k < axes_; ++k) {
        // In the middle: Simpson's rule for q'', whose integral is the change of q'.
        direction[k] = 0.5 * (from.direction[k] + to.direction[k]);
        curvature[k] =
            1.5 * (to.direction[k] - from.direction[k]) / out.length_mm - 0.25 * (from.curvature[k] + to.curvature[k]);
        const double entry = std::fabs(from.direction[k]);
        const double exit = std::fabs(to.direction[k]);
        double travel = std::fabs(to.position[k] - from.position[k]);
        if (from.direction[k] * to.direction[k] < 0.0) { // it turns round; dq/ds is as good as linear
            travel = std::max(travel, 0.5 * out.length_mm * (entry * entry + exit * exit) / (entry + exit));
        }
        out.entry_slope[k] = entry;
        out.exit_slope[k] = exit;
        out.travel_mm[k] = travel;
    }
    out.middle_cap_sq = out.length_mm > 0.0 ? cap_sq(direction, curvature) : fastest_sq_;
    out.noise_mm = travel_noise_mm + relative_noise * size_mm_;
    return out;
}

// By the trapezoid rule with its slopes (Euler-Maclaurin).
double PathGrid::length_error(const Node& from, const Node& to, double length_mm) noexcept {
    const double step = to.u - from.u;
    const double length = step * (0.5 * (from.sigma + to.sigma) + step * (from.slope - to.slope) / 12.0);
    return std::fabs(length - length_mm) / length_mm;
}

// What the mean of dq/ds differs from that at the ends: a curve that turns to and fro within an interval.
double PathGrid::bend(const Node& from, const Node& to, double length_mm) const noexcept {
    double bend = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        const double mean = 0.5 * (from.direction[k] + to.direction[k]);
        bend = std::max(bend, std::fabs(to.position[k] - from.position[k] - mean * length_mm));
    }
    return bend / length_mm;
}

// Halves until an interval is short enough, the earlier half first.
void PathGrid::append_pieces(std::vector<PathInterval>& out) {
    struct Piece {
        Node to;
        int level;
    };
    std::array<Piece, deepest + 2> stack; // NOLINT: written before it is read
    stack[0] = {node(1.0), 0};
    std::size_t depth = 1;
    Node from = node(0.0);
    while (depth > 0) {
        const Piece& top = stack[depth - 1];
        const double turn = largest_size(difference(top.to.direction, from.direction, machine_.axes), machine_.axes);
        const double cosine = dot(top.to.direction, from.direction, machine_.axes);
        bool coarse = (top.level < least_level_ && degree_ > 1) || (top.level < deepest && turn > most_turn);
        PathInterval piece;
        if (!coarse) {
            piece = interval(from, top.to);
            const auto [slower, faster] = std::minmax({piece.entry_cap_sq, piece.middle_cap_sq, piece.exit_cap_sq});
            coarse = (top.level < deepest && length_error(from, top.to, piece.length_mm) > most_error) ||
                     (top.level < deepest_for_speed && (slower < most_speed_ratio * most_speed_ratio * faster ||
                                                        bend(from, top.to, piece.length_mm) > most_bend));
        }
        if (coarse) {
            const int level = top.level + 1;
            stack[depth - 1].level = level;
            stack[depth] = {node(0.5 * (from.u + top.to.u)), level};
            ++depth;
            continue;
        }
        const bool known = from.sigma > 0.0 && top.to.sigma > 0.0;
        piece.stop_before = stop_ || (known && top.level == deepest && cosine < cusp_cosine);
        out.push_back(piece);
        stop_ = false;
        from = top.to;
        --depth;
    }
}

bool PathGrid::jumps(const PerAxis<double>& in, const PerAxis<double>& out, double slack) const noexcept {
    const int axes = machine_.axes;
    return !(dot(in, in, axes) > 0.0) || !(dot(out, out, axes) > 0.0) ||
           largest_size(difference(out, in, axes), axes) > direction_jump_ + slack;
}

// Bezier to powers: binomial coefficient times forward difference.
void PathGrid::take_powers(const CurveSegment<double>& segment, PerAxis<double>& start, PerAxis<double>& end) {
    degree_ = static_cast<unsigned>(segment.degree);
    size_mm_ = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        PerDegree<double> control{};
        for (unsigned i = 0; i <= degree_; ++i) {
            control[i] = k < static_cast<unsigned>(segment.axes) ? segment.control[k][i] : 0.0;
        }
        start[k] = control[1] - control[0];
        end[k] = control[degree_] - control[degree_ - 1];
        double binomial = std::ldexp(1.0, segment.unit_log2);
        for (unsigned i = 0; i <= degree_; ++i) {
            size_mm_ = std::max(size_mm_, std::fabs(std::ldexp(control[i], segment.unit_log2)));
            power_[k][i] = binomial * control[0];
            binomial = binomial * (degree_ - i) / (i + 1U);
            for (unsigned j = 0; j + i < degree_; ++j) {
                control[j] = control[j + 1] - control[j];
            }
        }
    }
}

void PathGrid::take_feed(double programmed_mm_s) {
    bool linear_moves = false;
    double chord_sq = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        double chord = 0.0;
        for (unsigned i = 1; i <= degree_; ++i) {
            linear_moves = linear_moves || (!machine_.axis[k].rotary && power_[k][i] != 0.0);
            chord += power_[k][i];
        }
        chord_sq += chord * chord;
    }
    const double most = linear_moves || programmed_mm_s > 0.0 ? machine_.max_feed_mm_s : max_turning_deg_s(machine_);
    const double feed = programmed_mm_s > 0.0 ? std::min(programmed_mm_s, most) : most;
    feed_sq_ = feed * feed;
    fastest_sq_ = linear_moves ? feed_sq_ + turning_sq_ : feed_sq_;
    const double quarter = feed_sq_ / (8.0 * softest_mm_s2_);
    least_level_ = chord_sq > quarter * quarter ? least_level_of_long : least_level;
}

void PathGrid::normalise(PerAxis<double>& direction) const {
    const double length = std::sqrt(dot(direction, direction, machine_.axes));
    if (length < negligible_units_) {
        direction = {};
    } else {
        divide(direction, length, machine_.axes);
    }
}

void PathGrid::append(const CurveSegment<double>& segment, std::vector<PathInterval>& out) {
    PerAxis<double> start{};
    PerAxis<double> end{};
    take_powers(segment, start, end);
    normalise(start);
    normalise(end);
    take_feed(segment.block_feed_mm_s());
    stop_ = any_ && (stop_ || jumps(last_direction_, start, direction_error_));
    append_pieces(out);
    any_ = true;
    stop_ = segment.stop_at_end;
    last_direction_ = end;
}

} // namespace splinefeed::host
