// SPDX-License-Identifier: MIT
// Any waypoints, options and machine: the simulated machine keeps every limit, the segments chain exactly, the motion
// ends at rest on the last waypoint, and it takes no longer than its length and its stops explain.
#include "host_sim/config/machine_file.hpp"
#include "host_sim/machine/simulated_machine.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "splinefeed/trajectory.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

/// Numbers out of the fuzzer's bytes; zeros when they are used up.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    [[nodiscard]] bool empty() const { return at_ >= size_; }
    unsigned byte() { return at_ < size_ ? data_[at_++] : 0U; }
    unsigned below(unsigned n) { return byte() % n; }
    /// -1 to 1 in 2^16 steps.
    double unit() {
        const int high = static_cast<int>(byte());
        return (high * 256 + static_cast<int>(byte()) - 32768) / 32768.0;
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

struct Program {
    MachineDescription machine = default_machine();
    std::vector<PerAxis<double>> points;
    std::vector<double> feeds;
    std::vector<Corner> corners;
    unsigned method = 0;
    Parameterization parameterization{};
    double corner_angle = 60.0;
    double tension = 0.5;
    std::size_t window = 64;
    bool closed = false;
};

[[noreturn]] void fail(const char* what, double value) {
    std::fprintf(stderr, "%s: %.17g\n", what, value);
    std::abort();
}

Program make_program(Bytes& bytes) {
    constexpr unsigned most_points = 200;
    Program program;
    MachineSettings& settings = program.machine.settings;
    settings.axes = 1 + static_cast<int>(bytes.below(6));
    constexpr double accelerations[] = {1000.0, 100.0, 20000.0};
    constexpr double velocities[] = {100.0, 10.0, 1000.0};
    constexpr int periods[] = {1000, 250, 4000};
    for (const unsigned k : indices(settings.axes)) {
        settings.axis[k] = {.max_velocity_mm_s = velocities[bytes.below(3)],
                            .max_acceleration_mm_s2 = accelerations[bytes.below(3)],
                            .steps_per_mm = 320.0};
        program.machine.axis_name[k] = std::string(1, "xyzabc"[k]);
    }
    settings.max_feed_mm_s = velocities[bytes.below(3)];
    settings.centripetal_mm_s2 = bytes.below(4) == 0 ? 500.0 : 0.0;
    settings.chord_error_mm = bytes.below(4) == 0 ? 0.001 : 0.0;
    settings.sample_period_us = periods[bytes.below(3)];
    program.method = bytes.below(3);
    program.closed = bytes.below(4) == 0;
    program.parameterization = static_cast<Parameterization>(bytes.below(3));
    program.corner_angle = bytes.below(181);
    program.tension = bytes.below(41) / 20.0;
    program.window = 16U + bytes.byte();
    constexpr double reach[] = {10.0, 0.001, 0.1, 1.0, 50.0, 200.0, 1e-5, 1e-7};
    PerAxis<double> here{};
    for (const unsigned k : indices(settings.axes)) {
        here[k] = 1000.0 * std::round(4.0 * bytes.unit());
    }
    program.points.push_back(here);
    while (!bytes.empty() && program.points.size() < most_points) {
        const unsigned kind = bytes.byte();
        for (const unsigned k : indices(settings.axes)) {
            here[k] += reach[kind & 7U] * bytes.unit();
        }
        if ((kind & 8U) != 0 && program.points.size() > 1) {
            here = program.points[program.points.size() - 2]; // back, or the same again
        }
        program.points.push_back(here);
        program.feeds.resize(program.points.size());
        program.corners.resize(program.points.size());
        program.feeds.back() = (kind & 16U) != 0 ? 5.0 : 0.0;
        program.corners.back() = (kind & 0x60U) == 0x20U   ? Corner::forced
                                 : (kind & 0x60U) == 0x40U ? Corner::forbidden
                                                           : Corner::automatic;
    }
    program.feeds.resize(program.points.size());
    program.corners.resize(program.points.size());
    return program;
}

/// What goes into the curve, in order: for a closed one the points before the seam and after it as well.
struct Feed {
    std::size_t point;
    Role role;
};

std::vector<Feed> order_of(const Program& program) {
    constexpr std::size_t lead = 16;
    std::vector<Feed> order;
    const std::size_t count = program.points.size();
    const bool closed = program.closed && count > 3;
    for (std::size_t i = 0; closed && i < lead; ++i) {
        order.push_back({(i + lead * count - lead) % count, Role::lead_in});
    }
    for (std::size_t i = 0; i < count; ++i) {
        order.push_back({i, Role::path});
    }
    for (std::size_t i = 0; closed && i <= lead; ++i) {
        order.push_back({i % count, i == 0 ? Role::path : Role::lead_out});
    }
    return order;
}

template <Scalar S, class Curve>
void run_curve(const Program& program, Curve& curve) {
    const auto limits = MotionLimits<S>::make(program.machine.settings);
    if (!limits.has_value()) {
        fail("limits", 0.0);
    }
    const int axes = program.machine.settings.axes;
    std::vector<PlannedCell<S>> window(program.window);
    AccelerationPlanner<S> planner(window);
    auto made = Trajectory<S>::make(curve, *limits, planner);
    if (!made.has_value()) {
        fail("planner", 0.0);
    }
    Trajectory<S>& trajectory = *made;
    SimulatedMachine machine(program.machine, limits->segments_per_sample, {.enforce = true});
    const std::vector<Feed> order = order_of(program);
    std::size_t pushed = 0;
    bool finished = false;
    std::uint64_t segments = 0;
    FeedSegment last{};
    for (;;) {
        FeedSegment segment;
        if (trajectory.next(segment) == Pull::item) {
            for (unsigned k = 0; k < static_cast<unsigned>(axes) && segments > 0; ++k) {
                if (segment.start[k] != last.end[k] || segment.start_velocity[k] != last.end_velocity[k]) {
                    fail("chain", static_cast<double>(segments));
                }
            }
            last = segment;
            if (++segments > 20000000) {
                fail("too many segments", static_cast<double>(segments));
            }
            if (!machine.submit(segment) || machine.poll().phase == hal::PortPhase::fault) {
                break;
            }
            continue;
        }
        if (trajectory.state() == Pull::finished) {
            break;
        }
        if (finished) {
            fail("starved after the end", static_cast<double>(segments));
        }
        if (pushed < order.size()) {
            Waypoint<S> waypoint;
            const Feed feed = order[pushed++];
            for (const unsigned k : indices(axes)) {
                waypoint.position[k] = position_from_mm(program.points[feed.point][k]);
            }
            waypoint.feed_mm_s = from_double<S>(program.feeds[feed.point]);
            waypoint.corner = program.corners[feed.point];
            if (!curve.has_room() || !curve.push(waypoint, feed.role).ok()) {
                fail("push", static_cast<double>(pushed));
            }
        } else {
            finished = true;
            if (!curve.finish().ok()) {
                return; // no move at all
            }
        }
    }
    if (machine.fault()) {
        std::fprintf(stderr, "%s\n", describe(*machine.fault()).c_str());
        fail("fault in", static_cast<double>(program.method));
    }
    const bool closed = order.front().role == Role::lead_in;
    const PerAxis<double>& target = closed ? program.points.front() : program.points.back();
    const PerAxis<double> end = machine.position_mm();
    for (unsigned k = 0; k < static_cast<unsigned>(axes) && segments > 0; ++k) {
        // Waypoints that are merged, 0.1 um at most, end where the first of them is.
        if (last.end_velocity[k] != 0 || std::fabs(end[k] - target[k]) > 1.01e-4) {
            fail("end", end[k] - target[k]);
        }
    }
}

template <Scalar S>
void run_program(const Program& program) {
    CurveOptions<S> options;
    options.axes = program.machine.settings.axes;
    options.parameterization = program.parameterization;
    options.corner_cosine = from_double<S>(corner_cosine(program.corner_angle));
    if (program.method == 0) {
        G2Spline<S> curve(options);
        run_curve<S>(program, curve);
    } else if (program.method == 1) {
        CatmullRom<S> curve(options, from_double<S>(program.tension));
        run_curve<S>(program, curve);
    } else {
        Polyline<S> curve(options);
        run_curve<S>(program, curve);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const unsigned scalar = bytes.below(3);
    const Program program = make_program(bytes);
    if (scalar == 0) {
        run_program<Fixed>(program);
    } else if (scalar == 1) {
        run_program<double>(program);
    } else {
        run_program<float>(program);
    }
    return 0;
}
