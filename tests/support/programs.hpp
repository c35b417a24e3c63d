// SPDX-License-Identifier: MIT
//
// Programs of waypoints like those the machine is shown with, and what comes out at the end of the pipeline.
#pragma once

#include "pipeline.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"

namespace splinefeed_test {

struct Point {
    PerAxis<double> mm{};
    double feed_mm_s = 0.0;
    Corner corner = Corner::automatic;
};

struct Program {
    int axes = 3;
    std::vector<Point> points;
    bool polyline = false;
};

/// 61 points of a knotted loop in space.
inline Program loop_program() {
    Program program;
    for (int i = 0; i <= 60; ++i) {
        const double t = 6.283185307179586 * i / 60.0;
        program.points.push_back(
            {{40.0 * std::sin(2.0 * t) + 10.0 * std::cos(3.0 * t), 30.0 * std::cos(3.0 * t), 5.0 * std::sin(5.0 * t)}});
    }
    return program;
}

inline Program circle_program(int points, double radius = 30.0) {
    Program program;
    for (int i = 0; i <= points; ++i) {
        const double t = 6.283185307179586 * i / points;
        program.points.push_back({{radius * std::cos(t), radius * std::sin(t), 0.0}});
    }
    return program;
}

/// Lines to and fro over a wavy surface.
inline Program raster_program(int lines = 6) {
    Program program;
    for (int line = 0; line < lines; ++line) {
        for (int i = 0; i <= 40; ++i) {
            const double x = line % 2 == 0 ? i : 40 - i;
            const double y = 0.5 * line;
            program.points.push_back({{x, y, std::sin(0.3 * x) * std::cos(0.5 * y)}});
        }
    }
    return program;
}

inline Program star_program(bool polyline) {
    Program program;
    program.polyline = polyline;
    for (int i = 0; i <= 10; ++i) {
        const double t = 0.6283185307179586 * i;
        const double r = i % 2 == 0 ? 30.0 : 12.0;
        program.points.push_back({{r * std::cos(t), r * std::sin(t), 0.0}});
    }
    return program;
}

inline Program random_program(Random& random, int axes) {
    Program program;
    program.axes = axes;
    program.polyline = random.chance(0.3);
    Point point;
    const int points = random.integer(3, 25);
    const double size = random.decades(0.05, 20.0);
    const bool feeds = random.chance(0.5);
    for (int i = 0; i < points; ++i) {
        for (const unsigned k : splinefeed::indices(axes)) {
            point.mm[k] += size * random.decades(0.2, 5.0) * random.between(-0.3, 1.0);
        }
        point.feed_mm_s = feeds && random.chance(0.5) ? random.decades(1.0, 1000.0) : 0.0;
        point.corner = random.chance(0.1) ? Corner::forced : random.chance(0.1) ? Corner::forbidden : Corner::automatic;
        program.points.push_back(point);
    }
    return program;
}

/// No further than reach_mm from 0, in any axis.
inline Program random_program_within(Random& random, int axes, double reach_mm) {
    for (;;) {
        Program program = random_program(random, axes);
        double reach = 0.0;
        for (const Point& point : program.points) {
            for (const double mm : point.mm) {
                reach = std::max(reach, std::fabs(mm));
            }
        }
        if (reach < reach_mm) {
            return program;
        }
    }
}

/// Drives a pipeline by hand: pushes waypoints as it starves, `at_once` of them at a time.
template <class S, class Curve>
class Feeder {
public:
    Feeder(Curve& curve, const Program& program) : curve_(&curve), program_(&program) {}
    void feed(int at_once) {
        for (int i = 0; i < at_once && next_ < program_->points.size() && curve_->has_room(); ++i) {
            const Point& point = program_->points[next_++];
            Waypoint<S> waypoint;
            for (const unsigned k : splinefeed::indices(program_->axes)) {
                waypoint.position[k] = position_from_mm(point.mm[k]);
            }
            waypoint.feed_mm_s = from_double<S>(point.feed_mm_s);
            waypoint.corner = point.corner;
            static_cast<void>(curve_->push(waypoint).ok());
        }
        if (next_ == program_->points.size() && !finished_) {
            static_cast<void>(curve_->finish().ok());
            finished_ = true;
        }
    }

private:
    Curve* curve_;
    const Program* program_;
    std::size_t next_ = 0;
    bool finished_ = false;
};

struct Stream {
    std::vector<FeedSegment> segments;
    std::uint64_t limited = 0; ///< JerkPlan::window_limited
    bool endless = false;
    std::uint64_t slow_legs = 0; ///< JerkPlan::slow_legs
};

constexpr std::size_t most_starvations = 100'000;

/// Least time for a straight move: each axis at its velocity, the path at the feed. 0: the machine's feed
inline double least_seconds(const PerAxis<double>& move_mm, double feed_mm_s, const MachineSettings& machine) {
    double seconds = 0.0;
    double square = 0.0;
    for (const unsigned k : splinefeed::indices(machine.axes)) {
        seconds = std::max(seconds, std::fabs(move_mm[k]) / machine.axis[k].max_velocity_mm_s);
        square += machine.axis[k].rotary ? 0.0 : move_mm[k] * move_mm[k];
    }
    const double feed = feed_mm_s > 0.0 ? std::min(feed_mm_s, machine.max_feed_mm_s) : machine.max_feed_mm_s;
    return std::max(seconds, std::sqrt(square) / feed);
}

/// The chords between the points; no curve through them is faster.
inline double least_seconds(const Program& program, const MachineSettings& machine) {
    double seconds = 0.0;
    for (std::size_t i = 1; i < program.points.size(); ++i) {
        PerAxis<double> move{};
        for (const unsigned k : splinefeed::indices(program.axes)) {
            move[k] = program.points[i].mm[k] - program.points[i - 1].mm[k];
        }
        seconds += least_seconds(move, program.points[i].feed_mm_s, machine);
    }
    return seconds;
}

template <Scalar S>
double least_seconds(const std::vector<CurveSegment<S>>& segments, const MachineSettings& machine) {
    double seconds = 0.0;
    for (const CurveSegment<S>& segment : segments) {
        PerAxis<double> move{};
        for (const unsigned k : splinefeed::indices(segment.axes)) {
            const auto& control = segment.control[k];
            const auto last = static_cast<unsigned>(segment.degree);
            move[k] = std::ldexp(to_double(control[last]) - to_double(control[0]), segment.unit_log2);
        }
        seconds += least_seconds(move, to_double(segment.block_feed_mm_s()), machine);
    }
    return seconds;
}

/// So many segments are no motion any more that ends: five times as long as it has to take, but at least 400,000.
template <Scalar S>
std::size_t most_segments(double least_s, const MotionLimits<S>& limits) {
    return std::max(std::size_t{400'000}, static_cast<std::size_t>(5.0 * least_s * to_double(limits.segments_per_s)));
}

template <Scalar S, Floating R, class Curve>
Stream stream_through(Curve& curve, const Program& program, const MotionLimits<S>& limits, std::size_t most,
                      std::size_t window_size, Random* interleaving) {
    AnyTrajectory<S, R> any(curve, limits, window_size);
    Trajectory<S>& trajectory = any.trajectory();
    Feeder<S, Curve> feeder(curve, program);
    Stream stream;
    FeedSegment segment;
    std::size_t starvations = 0;
    while (trajectory.state() != Pull::finished && !stream.endless) {
        if (interleaving != nullptr && interleaving->chance(0.02)) {
            feeder.feed(interleaving->integer(1, 8));
        }
        if (trajectory.next(segment) == Pull::item) {
            stream.segments.push_back(segment);
            stream.endless = stream.segments.size() >= most;
        } else if (trajectory.state() == Pull::starved) {
            feeder.feed(interleaving != nullptr ? interleaving->integer(0, 3) : 1000);
            stream.endless =
                ++starvations >= most_starvations; // starved for ever: full of waypoints, yet asking for more
        }
    }
    stream.limited = any.window_limited();
    stream.slow_legs = any.slow_legs();
    return stream;
}

/// The feed segments of a program. `interleaving`: pushes and pulls in random order.
template <Scalar S, Floating R = double>
Stream stream_of(const Program& program, const MachineSettings& machine, std::size_t window_size = 1024,
                 Random* interleaving = nullptr) {
    const auto limits = limits_for<S, R>(machine).value();
    CurveOptions<S> options;
    options.axes = program.axes;
    const std::size_t most = most_segments(least_seconds(program, machine), limits);
    if (program.polyline) {
        Polyline<S> curve(options);
        return stream_through<S, R>(curve, program, limits, most, window_size, interleaving);
    }
    G2Spline<S> curve(options);
    return stream_through<S, R>(curve, program, limits, most, window_size, interleaving);
}

/// The feed segments of Bezier segments as they stand.
template <Scalar S, Floating R = double>
Stream stream_of(std::vector<CurveSegment<S>> segments, const MachineSettings& machine, std::size_t window_size = 1024,
                 std::uint64_t seed = 0, int patience = 0) {
    const auto limits = limits_for<S, R>(machine).value();
    const std::size_t most = most_segments(least_seconds(segments, machine), limits);
    ListSource<S> source(std::move(segments), seed, patience);
    AnyTrajectory<S, R> any(source, limits, window_size);
    Trajectory<S>& trajectory = any.trajectory();
    Stream stream;
    FeedSegment segment;
    while (trajectory.state() != Pull::finished && !stream.endless) {
        if (trajectory.next(segment) == Pull::item) {
            stream.segments.push_back(segment);
            stream.endless = stream.segments.size() >= most;
        }
    }
    stream.limited = any.window_limited();
    stream.slow_legs = any.slow_legs();
    return stream;
}

template <Scalar S, Floating R = double>
Stream stream_of(const BezierPath& path, const MachineSettings& machine, std::size_t window_size = 1024,
                 const PerAxis<double>& start = {}, std::uint64_t seed = 0, int patience = 0) {
    return stream_of<S, R>(segments_of<S>(path, start), machine, window_size, seed, patience);
}

} // namespace splinefeed_test
