// SPDX-License-Identifier: MIT
#include "host_sim/report/motion_record.hpp"

#include "host_sim/analysis/path_strand.hpp"
#include "host_sim/machine/segment_cubic.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {

constexpr double longest_piece_s = 0.004; // of a segment, without a point of the path inside
constexpr double per_s = ticks_per_us * 1e6;
constexpr std::size_t most_passed = 65536; // segments of a chain

double inverse(double limit) {
    return limit > 0.0 ? 1.0 / limit : 1.0;
}

float rounded(double value) {
    return static_cast<float>(value);
}

int height_axis(const MachineDescription& machine) {
    for (int k = 0; k < machine.settings.axes; ++k) {
        const std::string& name = machine.axis_name[static_cast<unsigned>(k)];
        if (name == "z" || name == "Z") {
            return k;
        }
    }
    return -1;
}

} // namespace

MotionRecord::MotionRecord(const MachineDescription& machine, std::uint32_t segment_ticks)
    : machine_(&machine), axes_(machine.settings.axes), height_(height_axis(machine)),
      values_(1 + 3 * static_cast<std::size_t>(axes_)), strips_(values_.size(), segment_ticks),
      path_(machine.settings.axes, most_points), programmed_(machine.settings.axes, most_programmed),
      linear_(machine.settings) {
    for (const unsigned k : indices(axes_)) {
        const AxisSettings& axis = machine.settings.axis[k];
        factors_[k] = {1.0 / (static_cast<double>(units_per_count) * axis.steps_per_mm),
                       inverse(axis.max_velocity_mm_s),
                       inverse(axis.max_acceleration_mm_s2),
                       inverse(axis.braking_mm_s2()),
                       inverse(axis.max_jerk_mm_s3),
                       !axis.rotary};
    }
}

void MotionRecord::start(const PerAxis<Position>& position) {
    here_ = position;
    ThinnedPath::Point point{.keep = true};
    point.position = to_mm(position, axes_);
    programmed_.add(point);
}

void MotionRecord::stop() {
    if (!rows_.empty()) {
        rows_.back().stop_at_end = true;
    }
}

void MotionRecord::move(const PathElement<double>& move, bool rapid, std::uint64_t line) {
    const double begin_mm = programmed_mm_;
    ThinnedPath::Point point{.line = line,
                             .kind = static_cast<std::uint8_t>(rapid ? PieceKind::rapid : PieceKind::feed)};
    const PathStrand strand(here_, move, axes_);
    PerAxis<double> before = to_mm(here_, axes_);
    for (int i = 1; i <= strand.parts(); ++i) {
        point.position = strand.at(static_cast<double>(i) / strand.parts());
        const PerAxis<double> way = difference(point.position, before, axes_);
        programmed_mm_ += std::sqrt(dot(way, way, axes_));
        point.length_mm = programmed_mm_;
        point.edge = i == strand.parts();
        before = point.position;
        programmed_.add(point);
    }
    const double length_mm = programmed_mm_ - begin_mm;
    rows_.push_back({line, length_mm, rapid, move.mode == PathMode::exact_stop, move.stop_at_end});
    lines_.programmed(line, length_mm);
    here_ = move.to;
}

void MotionRecord::waypoint(const PerAxis<Position>& position) {
    too_many_ = too_many_ || waypoints_.size() == most_waypoints;
    if (too_many_) {
        waypoints_ = {};
        return;
    }
    waypoints_.push_back(to_mm(position, axes_));
}

void MotionRecord::deviates(std::uint64_t row, double mm) {
    for (; row / rows_together_ >= most_rows; rows_together_ *= 2) {
        for (std::size_t i = 0; i < deviations_.size(); ++i) {
            deviations_[i / 2] = i % 2 == 0 ? deviations_[i] : std::max(deviations_[i / 2], deviations_[i]);
        }
        deviations_.resize((deviations_.size() + 1) / 2);
    }
    const std::size_t index = row / rows_together_;
    deviations_.resize(std::max(deviations_.size(), index + 1));
    deviations_[index] = std::max(deviations_[index], rounded(mm));
}

void MotionRecord::happened(const ProgramSummary::Event& event, EventKind kind) {
    if (kind == EventKind::tool_change || kind == EventKind::tool_set) {
        tool_ = event.number;
    }
    if (events_.size() < most_events) {
        events_.push_back(event);
    }
}

void MotionRecord::pop_row() {
    rows_.pop_front();
    ++first_row_;
}

void MotionRecord::come_to(std::uint64_t row, std::uint64_t line, std::optional<std::uint64_t> move) {
    settle_chain();
    now_ = {};
    if (move) {
        if (at_row_ && first_row_ < *move) {
            pop_row();
        }
        for (; !rows_.empty() && first_row_ < *move; pop_row()) {
            if (rows_.front().line > 0) {
                chain_.push_back(rows_.front());
            }
        }
        at_row_ = !rows_.empty();
        now_ = at_row_ ? rows_.front() : Row{};
    }
    now_.line = line;
    row_ = row;
    if (!chain_.empty()) {
        chain_.push_back(now_);
    }
}

PerAxis<double> MotionRecord::place(const FeedSegment& segment, double u) const {
    PerAxis<double> out{};
    for (const unsigned k : indices(axes_)) {
        const auto start = static_cast<double>(segment.start[k]);
        const auto way = static_cast<double>(segment.end[k] - segment.start[k]);
        const auto m0 = static_cast<double>(segment.start_velocity[k]);
        const auto m1 = static_cast<double>(segment.end_velocity[k]);
        const double moved = u * (m0 + u * (3.0 * way - 2.0 * m0 - m1 + u * (m0 + m1 - 2.0 * way)));
        out[k] = (start + (u < 1.0 ? moved : way)) * factors_[k].mm_per_unit;
    }
    return out;
}

// Velocity, acceleration and jerk over the whole segment: extremes lie at its ends and where the acceleration is 0.
void MotionRecord::measure(const FeedSegment& segment, double seconds) {
    double speed_sq[3] = {}; // at the begin, in the middle, at the end
    double turning_sq[3] = {};
    acceleration_ = jerk_ = 0.0F;
    for (const unsigned k : indices(axes_)) {
        const AxisFactors& of = factors_[k];
        const SegmentCubic cubic(segment, k, 1.0 / of.mm_per_unit, seconds);
        const double velocity[3] = {cubic.velocity(0.0), cubic.velocity(0.5), cubic.velocity(1.0)};
        double low = std::min(velocity[0], velocity[2]);
        double high = std::max(velocity[0], velocity[2]);
        if (cubic.peak_u() > 0.0) {
            low = std::min(low, cubic.velocity(cubic.peak_u()));
            high = std::max(high, cubic.velocity(cubic.peak_u()));
        }
        for (int i = 0; i < 3; ++i) {
            (of.linear ? speed_sq : turning_sq)[i] += velocity[i] * velocity[i];
        }
        values_[1 + 3 * k] = {rounded(low * of.per_velocity), rounded(high * of.per_velocity)};
        double share[2] = {};
        for (int i = 0; i < 2; ++i) {
            const double acceleration = cubic.acceleration(i);
            const double end = i == 0 ? velocity[0] : velocity[2];
            const double at = end == 0.0 ? velocity[1] : end;
            share[i] = acceleration * (at * acceleration < 0.0 ? of.per_braking : of.per_speeding);
            acceleration_ = std::max(acceleration_, rounded(std::fabs(share[i])));
        }
        values_[2 + 3 * k] = {rounded(std::min(share[0], share[1])), rounded(std::max(share[0], share[1]))};
        const float jerk = rounded(cubic.jerk() * of.per_jerk);
        values_[3 + 3 * k] = {jerk, jerk};
        if (machine_->settings.axis[k].max_jerk_mm_s3 > 0.0) {
            jerk_ = std::max(jerk_, std::fabs(jerk));
        }
    }
    if (!(speed_sq[0] + speed_sq[1] + speed_sq[2] > 0.0)) {
        std::ranges::copy(turning_sq, std::begin(speed_sq));
    }
    const auto [low, high] = std::minmax({speed_sq[0], speed_sq[1], speed_sq[2]});
    values_[0] = {rounded(std::sqrt(low)), rounded(std::sqrt(high))};
    speed_way_ = seconds * (std::sqrt(speed_sq[0]) + 4.0 * std::sqrt(speed_sq[1]) + std::sqrt(speed_sq[2])) / 6.0;
}

void MotionRecord::segment(const FeedSegment& segment, const LimitShare& share) {
    const double seconds = segment.duration_ticks / per_s;
    const double begin_s = static_cast<double>(ticks_) / per_s;
    const std::uint8_t code = share.binding_limit().code();
    measure(segment, seconds);
    double way_sq = 0.0;
    PerAxis<double> way{};
    for (const unsigned k : indices(axes_)) {
        way[k] = static_cast<double>(segment.end[k] - segment.start[k]) * factors_[k].mm_per_unit;
        way_sq += way[k] * way[k];
    }
    const double way_mm = std::sqrt(way_sq);
    strips_.add(ticks_, seconds, values_.data(), length_mm_, share.feed_mm_s(), code);
    if (chain_.empty()) {
        lines_.add(now_.line, begin_s, seconds, code);
    } else if (passed_.size() < most_passed) {
        chain_begin_s_ = passed_.empty() ? begin_s : chain_begin_s_;
        passed_.push_back({seconds, way_mm, code});
    } else {
        passed_.back().seconds += seconds;
        passed_.back().way_mm += way_mm;
    }
    tools_[tool_] += seconds;
    if (!has_last_) {
        last_ = {.position = place(segment, 0.0), .line = now_.line, .keep = true};
        has_last_ = true;
    }
    const bool stands = segment.ends_at_rest() && segment.start_velocity == PerAxis<std::int64_t>{} && !(way_mm > 0.0);
    if (stands) {
        stand(begin_s, seconds);
    } else {
        if (open_stop_) {
            turn(way);
        }
        travel(segment, begin_s, seconds, way_mm, share);
        direction_ = way_mm > 0.0 ? way : direction_;
    }
    ticks_ += segment.duration_ticks;
    if (!stands && segment.ends_at_rest()) {
        ++stop_count_;
        open_stop_ = stops_.size() < most_stops;
        last_.keep = true;
        if (open_stop_) {
            const Why why = now_.exact_stop ? Why::exact_stop : now_.stop_at_end ? Why::asked : Why::end;
            stops_.push_back({last_.time_s, 0.0, row_, now_.line, 0.0, why, last_.position});
        }
    }
}

// Each line of the chain gets the time in which a part of the way is travelled that is as large as its part of the
// length.
void MotionRecord::settle_chain() {
    double way_mm = 0.0;
    double length_mm = 0.0;
    for (const Passed& part : passed_) {
        way_mm += part.way_mm;
    }
    for (const Row& row : chain_) {
        length_mm += row.length_mm;
    }
    const double scale = way_mm > 0.0 ? length_mm / way_mm : 0.0;
    double at_s = chain_begin_s_;
    double done_mm = 0.0; // of the line
    std::size_t i = 0;
    for (const Passed& part : passed_) {
        double left_s = part.seconds;
        for (double left_mm = part.way_mm * scale;; ++i) {
            const bool ends = i + 1 < chain_.size() && done_mm + left_mm > chain_[i].length_mm;
            const double here_mm = ends ? chain_[i].length_mm - done_mm : left_mm;
            const double here_s = ends ? left_s * here_mm / left_mm : left_s;
            lines_.add(chain_[i].line, at_s, here_s, part.code);
            at_s += here_s;
            left_s -= here_s;
            left_mm -= here_mm;
            done_mm = ends ? 0.0 : done_mm + here_mm;
            if (!ends) {
                break;
            }
        }
    }
    passed_.clear();
    chain_.clear();
}

void MotionRecord::stand(double begin_s, double seconds) {
    Total& total = totals_[static_cast<std::size_t>(PieceKind::standing)];
    total.seconds += seconds;
    if (!stood_) {
        last_.keep = true;
        path_.add(last_);
    }
    stood_ = true;
    last_ = {.time_s = begin_s + seconds,
             .length_mm = last_.length_mm,
             .position = last_.position,
             .line = now_.line,
             .row = last_.row,
             .kind = static_cast<std::uint8_t>(PieceKind::standing),
             .keep = last_.keep};
    if (open_stop_) {
        stops_.back().stood_s += seconds;
        stops_.back().why = waits_ == Why::end ? stops_.back().why : waits_;
    }
}

void MotionRecord::travel(const FeedSegment& segment, double begin_s, double seconds, double way_mm,
                          const LimitShare& share) {
    const std::uint8_t code = share.binding_limit().code();
    const PieceKind kind = approaches_ ? PieceKind::approach : now_.rapid ? PieceKind::rapid : PieceKind::feed;
    const auto number = static_cast<std::uint8_t>(kind);
    last_.keep = last_.keep || stood_ || last_.kind != number;
    last_.edge = last_.line != now_.line;
    stood_ = false;
    waits_ = Why::end;
    Total& total = totals_[static_cast<std::size_t>(kind)];
    total.seconds += seconds;
    const double linear_mm = linear_.of(segment);
    total.length_mm += linear_mm;
    total.max_speed_mm_s = std::max(total.max_speed_mm_s, static_cast<double>(values_[0].high));
    if (kind == PieceKind::feed && height_ >= 0) {
        const auto k = static_cast<unsigned>(height_);
        const auto height = [&](std::int64_t units) {
            return static_cast<double>(units) * factors_[k].mm_per_unit;
        };
        layers_.add(height(segment.start[k]), height(segment.end[k]), way_mm, begin_s, seconds);
    }
    const int parts = std::clamp(static_cast<int>(std::ceil(seconds / longest_piece_s)), 1, 64);
    for (int i = 1; i <= parts; ++i) {
        path_.add(last_);
        const double u = static_cast<double>(i) / parts;
        last_ = {.time_s = begin_s + u * seconds,
                 .length_mm = way_mm_ + u * way_mm,
                 .position = place(segment, u),
                 .line = now_.line,
                 .row = row_,
                 .kind = number,
                 .code = code,
                 .weight = rounded(seconds / parts),
                 .way = rounded(speed_way_ / parts),
                 .wanted = rounded(share.feed_mm_s() * seconds / parts),
                 .acceleration = acceleration_,
                 .jerk = jerk_};
    }
    way_mm_ += way_mm;
    length_mm_ += linear_mm;
}

// The machine goes on from the last stop.
void MotionRecord::turn(const PerAxis<double>& direction) {
    open_stop_ = false;
    const double a = dot(direction, direction, axes_);
    const double b = dot(direction_, direction_, axes_);
    Stop& stop = stops_.back();
    const double cosine =
        a > 0.0 && b > 0.0 ? std::clamp(dot(direction, direction_, axes_) / std::sqrt(a * b), -1.0, 1.0) : 1.0;
    stop.turn_deg = std::acos(cosine) * 180.0 / std::numbers::pi;
    constexpr double least_deg = 0.5;
    if (stop.why == Why::end) {
        stop.why = stop.turn_deg > least_deg ? Why::turn : Why::asked;
    }
}

void MotionRecord::finish() {
    settle_chain();
    if (has_last_) {
        last_.keep = true;
        path_.add(last_);
        has_last_ = false;
    }
    if (open_stop_ && stops_.back().why != Why::held) {
        stops_.back().why = Why::end;
    }
    constexpr std::size_t enough = 60000; // points
    for (ThinnedPath* const path : {&path_, &programmed_}) {
        PerAxis<double> low{};
        PerAxis<double> high{};
        low.fill(1e300);
        high.fill(-1e300);
        double size = 0.0;
        for (const ThinnedPath::Point& point : path->points()) {
            for (const unsigned k : indices(axes_)) {
                low[k] = std::min(low[k], point.position[k]);
                high[k] = std::max(high[k], point.position[k]);
                size = std::max(size, high[k] - low[k]);
            }
        }
        path->finish(size / 20000.0, enough);
    }
}

} // namespace splinefeed::host
