// SPDX-License-Identifier: MIT
#include "host_sim/machine/simulated_machine.hpp"

#include "host_sim/machine/segment_cubic.hpp"

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr unsigned no_axis = static_cast<unsigned>(max_axes);

bool is_linear(const std::string& name) {
    return name == "x" || name == "y" || name == "z";
}

} // namespace

struct SimulatedMachine::Motion {
    const FeedSegment* segment;
    double start_s;
    double duration_s;
    PerAxis<SegmentCubic> cubic;
    PerAxis<double> jump;          // of acceleration at the start, as jerk over one segment
    PerAxis<bool> axis_suspicious; // some limit of the axis is violated somewhere
    bool suspicious;
    double power; // v . a at the last tick
    bool turning; // rotary axes alone move: the feed is theirs
};

SimulatedMachine::SimulatedMachine(const MachineDescription& machine, int segments_per_sample, const Options& options)
    : description_(machine), options_(options), axes_(static_cast<unsigned>(machine.settings.axes)),
      segments_per_sample_(segments_per_sample), queue_(static_cast<std::size_t>(options.queue)) {
    assert(machine.settings.axes >= 1 && machine.settings.axes <= max_axes && segments_per_sample >= 1);
    assert(options.queue >= 1 && options.ticks_per_segment >= 1 && options.ticks_per_segment <= 1024);
    const bool any_linear = std::any_of(machine.axis_name.begin(), machine.axis_name.begin() + axes_, is_linear);
    const auto rotary = [&](const AxisSettings& axis) {
        return axis.rotary;
    };
    const auto* const first = machine.settings.axis.data();
    mixed_ = std::any_of(first, first + axes_, rotary) && !std::all_of(first, first + axes_, rotary);
    double path_noise_sq = 0.0;
    double turning_noise_sq = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        AxisAllowance& axis = axis_[k];
        axis = AxisAllowance(machine.settings.axis[k], machine.travel[k]);
        const double e = axis.velocity.noise;
        axis.on_path = mixed_ ? !axis.rotary : !any_linear || is_linear(machine.axis_name[k]);
        (axis.on_path ? path_noise_sq : turning_noise_sq) += e * e;
    }
    feed_ = Allowance(machine.settings.max_feed_mm_s, std::sqrt(path_noise_sq));
    turning_feed_ = Allowance(max_turning_deg_s(machine.settings), std::sqrt(turning_noise_sq));
}

// ---- the port

int SimulatedMachine::room() const noexcept {
    return static_cast<int>(queue_.size() - queued_);
}

bool SimulatedMachine::submit(const FeedSegment& segment) noexcept {
    if (fault_ || halted_ || queued_ == queue_.size()) {
        return false;
    }
    queue_[ring_index(head_ + queued_, queue_.size())] = segment;
    ++queued_;
    return true;
}

hal::PortState SimulatedMachine::poll() noexcept {
    if (!fault_ && !halted_) {
        if (queued_ > 0) {
            execute(queue_[head_]);
            head_ = ring_index(head_ + 1, queue_.size());
            --queued_;
        } else if (moving()) {
            fail(FaultKind::underrun, no_axis, cycle_time_s(), path_speed(), 0.0, "mm/s", waypoint_);
        }
    }
    const hal::PortPhase phase = fault_                    ? hal::PortPhase::fault
                                 : halted_                 ? hal::PortPhase::halted
                                 : queued_ > 0 || moving() ? hal::PortPhase::running
                                                           : hal::PortPhase::idle;
    return {phase, executed_};
}

void SimulatedMachine::halt() noexcept {
    queued_ = 0;
    halted_ = true;
}

void SimulatedMachine::finish() {
    if (!fault_ && untraced_ > 0) {
        trace_row();
    }
    if (trace_failure_) {
        std::rethrow_exception(trace_failure_);
    }
}

// ---- execution

bool SimulatedMachine::moving() const noexcept {
    return std::any_of(velocity_.begin(), velocity_.begin() + axes_, [](std::int64_t v) { return v != 0; });
}

double SimulatedMachine::path_speed() const noexcept {
    return std::sqrt(sum_of(static_cast<int>(axes_), [&](unsigned k) {
        const double v = static_cast<double>(velocity_[k]) / (axis_[k].units_per_mm * seconds(duration_ticks_));
        return axis_[k].on_path ? v * v : 0.0;
    }));
}

PerAxis<double> SimulatedMachine::position_mm() const noexcept {
    // Three roundings of 2^-53: below 4e-16 of the position.
    return each(static_cast<int>(axes_),
                [&](unsigned k) { return static_cast<double>(position_[k]) / axis_[k].units_per_mm; });
}

void SimulatedMachine::trace_row() noexcept {
    untraced_ = 0;
    if (options_.trace == nullptr) {
        return;
    }
    try {
        options_.trace->row(elapsed_ticks_, position_mm(), path_speed());
    } catch (...) {
        trace_failure_ = std::current_exception();
        options_.trace = nullptr;
    }
}

// Always false, for `return fail(...)`.
bool SimulatedMachine::fail(FaultKind kind, unsigned axis, double time_s, double value, double limit, const char* unit,
                            std::uint32_t waypoint) {
    const bool whole = axis == no_axis;
    fault_ = Fault{kind,     whole ? std::string{} : description_.axis_name[axis],
                   time_s,   value,
                   limit,    unit,
                   waypoint, !whole && axis_[axis].rotary};
    return false;
}

// The chain in position and velocity. Velocities of segments of different duration are compared as fractions.
bool SimulatedMachine::accept(const FeedSegment& segment) {
    const double now = cycle_time_s();
    if (segment.duration_ticks == 0) {
        return fail(FaultKind::duration, no_axis, now, 0.0, 0.0, "s", segment.waypoint);
    }
    for (unsigned k = 0; k < axes_; ++k) {
        const double units_per_mm = axis_[k].units_per_mm;
        if (started_ && segment.start[k] != position_[k]) {
            const double gap =
                static_cast<double>(static_cast<Wide128>(segment.start[k]) - position_[k]) / units_per_mm;
            return fail(FaultKind::chain, k, now, gap, 0.0, "mm", segment.waypoint);
        }
        const Wide128 gap = static_cast<Wide128>(segment.start_velocity[k]) * duration_ticks_ -
                            static_cast<Wide128>(velocity_[k]) * segment.duration_ticks;
        if (gap != 0) {
            const double mm_s =
                static_cast<double>(gap) / (units_per_mm * seconds(segment.duration_ticks) * duration_ticks_);
            return fail(FaultKind::chain, k, now, mm_s, 0.0, "mm/s", segment.waypoint);
        }
    }
    return true;
}

bool SimulatedMachine::execute(const FeedSegment& segment) {
    if (!accept(segment)) {
        return false;
    }
    waypoint_ = segment.waypoint;
    Motion motion; // NOLINT: survey() fills it
    motion.segment = &segment;
    motion.start_s = cycle_time_s();
    motion.duration_s = seconds(segment.duration_ticks);
    if (!started_) {
        for (unsigned k = 0; k < axes_; ++k) {
            position_[k] = segment.start[k];
            counts_[k] = nearest_count(position_[k]);
            acceleration_[k] = 0.0;
        }
        started_ = true;
        trace_row();
    }
    if (options_.measures) {
        survey(motion);
    } else {
        std::ranges::copy(segment.end, position_.begin());
    }
    for (int j = 0; options_.measures && j <= options_.ticks_per_segment; ++j) {
        if (!tick(motion, j)) {
            return false;
        }
    }
    for (unsigned k = 0; k < axes_; ++k) {
        velocity_[k] = segment.end_velocity[k];
        acceleration_[k] = options_.measures ? motion.cubic[k].acceleration(1.0) : 0.0;
    }
    duration_ticks_ = segment.duration_ticks;
    elapsed_ticks_ += segment.duration_ticks;
    ++executed_;
    if (++untraced_ == segments_per_sample_) {
        trace_row();
    }
    return true;
}

// Coefficients, and the extremes over the whole segment in closed form.
void SimulatedMachine::survey(Motion& motion) noexcept {
    const FeedSegment& segment = *motion.segment;
    const double duration = motion.duration_s;
    motion.suspicious = false;
    motion.turning = mixed_;
    motion.power = 0.0;
    for (unsigned k = 0; k < axes_; ++k) {
        const AxisAllowance& axis = axis_[k];
        const bool stands =
            segment.start[k] == segment.end[k] && segment.start_velocity[k] == 0 && segment.end_velocity[k] == 0;
        motion.turning = motion.turning && (axis.rotary || stands);
        SegmentCubic& cubic = motion.cubic[k];
        cubic = SegmentCubic(segment, k, axis.units_per_mm, duration);
        double velocity = std::max(std::fabs(cubic.velocity(0.0)), std::fabs(cubic.velocity(1.0)));
        if (cubic.peak_u() >= 0.0) {
            velocity = std::max(velocity, std::fabs(cubic.velocity(cubic.peak_u())));
        }
        const double start = cubic.acceleration(0.0);
        const Accelerations found = axis.accelerations(cubic, 0.0, 1.0);
        // Where acceleration jumps, the sampled jerk is the jump over a segment; a stream that chains in C2 has none.
        motion.jump[k] = (start - acceleration_[k]) / duration;
        const bool jerk_limited = axis.jerk.limit > 0.0;
        const double jerk = jerk_limited ? std::max(std::fabs(cubic.jerk()), std::fabs(motion.jump[k])) : 0.0;

        LimitUse& use = use_[k];
        use.velocity = std::max(use.velocity, velocity / axis.velocity.limit);
        use.acceleration =
            std::max({use.acceleration, found.speeding / axis.acceleration.limit, found.braking / axis.braking.limit});
        use.jerk = jerk_limited ? std::max(use.jerk, jerk / axis.jerk.limit) : 0.0;
        const double square = duration * duration;
        motion.axis_suspicious[k] = velocity > axis.velocity.most + axis.velocity.noise / duration ||
                                    found.speeding > axis.acceleration.most + axis.acceleration.noise / square ||
                                    found.braking > axis.braking.most + axis.braking.noise / square ||
                                    (jerk_limited && jerk > axis.jerk.most + axis.jerk.noise / (square * duration));
        motion.suspicious = motion.suspicious || motion.axis_suspicious[k];
    }
}

// From tick j-1 to tick j: checks, then moves.
bool SimulatedMachine::tick(Motion& motion, int j) {
    if (options_.enforce && motion.suspicious && !check_axes(motion, j)) {
        return false;
    }
    if (!check_path(motion, j)) {
        return false;
    }
    const int n = options_.ticks_per_segment;
    const double u = static_cast<double>(j) / n;
    PerAxis<std::int64_t> next; // NOLINT: written before it is read
    for (unsigned k = 0; k < axes_; ++k) {
        next[k] = motion.segment->start[k] + motion.cubic[k].travelled(j, n);
        if (options_.enforce && axis_[k].travel && !check_travel(motion, k, next[k], u)) {
            return false;
        }
    }
    for (unsigned k = 0; k < axes_; ++k) {
        const std::int64_t count = nearest_count(next[k]);
        pulses_[k] += static_cast<std::uint64_t>(std::abs(count - counts_[k]));
        counts_[k] = count;
        position_[k] = next[k];
    }
    return true;
}

// Finds the first violation of an axis limit in (tick j-1, tick j]; only called where there is one in the segment.
bool SimulatedMachine::check_axes(const Motion& motion, int j) {
    const double n = options_.ticks_per_segment;
    const double u = j / n;
    const double t = motion.duration_s;
    const double now = motion.start_s + t * u;
    const std::uint32_t waypoint = motion.segment->waypoint;
    for (unsigned k = 0; k < axes_; ++k) {
        const AxisAllowance& axis = axis_[k];
        const SegmentCubic& cubic = motion.cubic[k];
        if (!motion.axis_suspicious[k]) {
            continue;
        }
        const double jerk = std::max(std::fabs(cubic.jerk()), std::fabs(motion.jump[k]));
        if (axis.jerk.limit > 0.0 && jerk > axis.jerk.most + axis.jerk.noise / (t * t * t)) {
            return fail(FaultKind::jerk, k, now, jerk, axis.jerk.limit, "mm/s3", waypoint);
        }
        const Accelerations found = axis.accelerations(cubic, std::max(u - 1.0 / n, 0.0), u);
        if (found.speeding > axis.acceleration.most + axis.acceleration.noise / (t * t)) {
            return fail(FaultKind::acceleration, k, now, found.speeding, axis.acceleration.limit, "mm/s2", waypoint);
        }
        if (found.braking > axis.braking.most + axis.braking.noise / (t * t)) {
            return fail(FaultKind::braking, k, now, found.braking, axis.braking.limit, "mm/s2", waypoint);
        }
        const double most = axis.velocity.most + axis.velocity.noise / t;
        const bool peaked = cubic.peak_u() > u - 1.0 / n && cubic.peak_u() <= u;
        const double peak = peaked ? std::fabs(cubic.velocity(cubic.peak_u())) : 0.0;
        if (peak > most) {
            const double time = motion.start_s + t * cubic.peak_u();
            return fail(FaultKind::velocity, k, time, peak, axis.velocity.limit, "mm/s", waypoint);
        }
        const double velocity = std::fabs(cubic.velocity(u));
        if (velocity > most) {
            return fail(FaultKind::velocity, k, now, velocity, axis.velocity.limit, "mm/s", waypoint);
        }
    }
    return true;
}

// Path speed at tick j, and at its peak since tick j-1: where v . a changes from + to -. Near its peak the speed is
// flat: four steps of false position (Illinois) leave less than 1e-9 of it.
bool SimulatedMachine::check_path(Motion& motion, int j) {
    const auto measure = [&](double u, double& power) {
        double speed_sq = 0.0;
        power = 0.0;
        for (unsigned k = 0; k < axes_; ++k) {
            if (axis_[k].on_path != motion.turning) {
                const double v = motion.cubic[k].velocity(u);
                speed_sq += v * v;
                power += v * motion.cubic[k].acceleration(u);
            }
        }
        return std::sqrt(speed_sq);
    };
    const double n = options_.ticks_per_segment;
    double u = j / n;
    double power = 0.0;
    double speed = measure(u, power);
    if (j > 0 && motion.power >= 0.0 && power <= 0.0 && motion.power > power) {
        double low = (j - 1) / n;
        double high = u;
        double low_power = motion.power;
        double high_power = power;
        for (int step = 0; step < 4 && low_power > high_power; ++step) {
            const double middle = low + (high - low) * (low_power / (low_power - high_power));
            double middle_power = 0.0;
            const double peak = measure(middle, middle_power);
            if (peak > speed) {
                speed = peak;
                u = middle;
            }
            if (middle_power > 0.0) {
                low = middle;
                low_power = middle_power;
                high_power *= 0.5;
            } else {
                high = middle;
                high_power = middle_power;
                low_power *= 0.5;
            }
        }
    }
    motion.power = power;
    const Allowance& feed = motion.turning ? turning_feed_ : feed_;
    max_path_speed_ = motion.turning ? max_path_speed_ : std::max(max_path_speed_, speed);
    if (options_.enforce && speed > feed.most + feed.noise / motion.duration_s) {
        return fail(FaultKind::feed, no_axis, motion.start_s + motion.duration_s * u, speed, feed.limit,
                    motion.turning ? "degrees/s" : "mm/s", motion.segment->waypoint);
    }
    return true;
}

bool SimulatedMachine::check_travel(const Motion& motion, unsigned k, std::int64_t position, double u) {
    const AxisAllowance& axis = axis_[k];
    const double mm = static_cast<double>(position) / axis.units_per_mm;
    const double now = motion.start_s + motion.duration_s * u;
    if (mm >= axis.lowest && mm <= axis.highest) {
        const Allowance& end = axis.end_velocity;
        const double velocity = std::fabs(motion.cubic[k].velocity(u));
        if (end.limit > 0.0 && (mm < axis.open_low || mm > axis.open_high) &&
            velocity > end.most + end.noise / motion.duration_s) {
            return fail(FaultKind::travel_end, k, now, velocity, end.limit, "mm/s", motion.segment->waypoint);
        }
        return true;
    }
    const double limit = mm < axis.lowest ? axis.travel->low : axis.travel->high;
    return fail(FaultKind::travel, k, now, mm, limit, "mm", motion.segment->waypoint);
}

} // namespace splinefeed::host
