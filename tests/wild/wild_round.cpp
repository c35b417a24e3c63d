// SPDX-License-Identifier: MIT
#include "wild_round.hpp"

#include "host/temporary_folder.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <vector>

namespace splinefeed_test {

using splinefeed::host::RunArguments;
using splinefeed::host::ScalarKind;

namespace {

using Point = std::array<double, 6>;

constexpr std::string_view axis_names = "xyzabc";

void make_machine(Random& random, int axes, WildRound& round) {
    constexpr std::array periods{250, 500, 1000, 2000, 4000};
    const bool alike = random.chance(0.2);
    // One number a statement: compilers evaluate a call's arguments in either order.
    const double feed = random.decades(1.0, 1000.0);
    const int period =
        random.chance(0.5) ? periods[static_cast<unsigned>(random.integer(0, 4))] : random.integer(250, 4000);
    std::string text = fmt::format("sample_period_us = {}\n[path]\nmax_feed_mm_s = {:.6g}\n", period, feed);
    if (random.chance(0.3)) {
        text += fmt::format("centripetal_mm_s2 = {:.6g}\n", random.decades(30.0, 1e4));
    }
    if (random.chance(0.2)) {
        text += fmt::format("chord_error_mm = {:.6g}\n", random.decades(1e-5, 0.1));
    }
    round.machine = round.jerk = text;
    const double velocity = random.decades(3.0, 1000.0);
    const double acceleration = random.decades(30.0, 3e4);
    const double rise = random.decades(1e-3, 0.3);
    const double decades = random.chance(0.5) ? 3.0 : 30.0; // to either side
    const int linear = random.chance(0.2) ? random.integer(0, axes) : axes;
    for (int k = 0; k < axes; ++k) {
        const auto own = [&](double value, double low, double high) {
            return std::clamp(alike ? value : value * random.decades(1.0 / decades, decades), low, high);
        };
        const double limit = own(acceleration, 30.0, 1e5);
        const double steps = random.decades(10.0, 1e4);
        const double fastest = own(velocity, 1.0, 1000.0);
        std::string axis =
            fmt::format("[[axis]]\nname = \"{}\"\nmax_velocity_mm_s = {:.6g}\nmax_acceleration_mm_s2 = {:.6g}\n"
                        "steps_per_mm = {:.6g}\n",
                        axis_names[static_cast<unsigned>(k)], fastest, limit, steps);
        if (k >= linear) {
            axis += "kind = \"rotary\"\n";
        }
        if (random.chance(0.2)) {
            axis +=
                fmt::format("max_braking_mm_s2 = {:.6g}\n", std::clamp(limit * random.decades(0.3, 3.0), 30.0, 1e5));
        }
        round.machine += axis;
        round.jerk += axis;
        if (k == 0 || random.chance(0.9)) {
            round.jerk += fmt::format("max_jerk_mm_s3 = {:.6g}\n", std::min(limit / own(rise, 3e-4, 1.0), 1e9));
        }
    }
}

Point direction(Random& random, int axes) {
    Point d{};
    double sum = 0.0;
    while (sum < 0.01) {
        sum = 0.0;
        for (const unsigned k : splinefeed::indices(axes)) {
            d[k] = random.between(-1.0, 1.0);
            sum += d[k] * d[k];
        }
    }
    for (double& x : d) {
        x /= std::sqrt(sum);
    }
    return d;
}

// From point to point: steps over up to four decades, to and fro about one direction, or wherever.
std::vector<Point> make_points(Random& random, int axes) {
    std::vector<Point> points;
    const int count = random.chance(0.1) ? 2 : random.integer(3, 60);
    const double size = random.decades(0.02, 20.0);
    const double spread = random.chance(0.3) ? 1.0 : random.decades(3.0, 100.0); // to either side
    const int shape = random.integer(0, 3);
    Point at{};
    for (const unsigned k : splinefeed::indices(axes)) {
        at[k] = random.between(-50.0, 50.0);
    }
    Point along = direction(random, axes);
    if (random.chance(0.3)) { // one axis hardly moves
        along[static_cast<unsigned>(random.integer(0, axes - 1))] *= random.decades(1e-5, 0.1);
    }
    for (int i = 0; i < count; ++i) {
        points.push_back(at);
        if (random.chance(0.05)) {
            continue; // once more
        }
        const double step = size * random.decades(1.0 / spread, spread);
        const double much = shape == 0 ? 3.0 : shape == 1 ? 0.5 : 0.05;
        const double way = shape == 3 ? (random.chance(0.5) ? step : -step) : step;
        const Point turn = direction(random, axes);
        if (shape < 3) {
            for (const unsigned k : splinefeed::indices(axes)) {
                along[k] += much * turn[k];
            }
            double sum = 0.0;
            for (const double x : along) {
                sum += x * x;
            }
            for (double& x : along) {
                x /= std::sqrt(sum);
            }
        }
        for (const unsigned k : splinefeed::indices(axes)) {
            at[k] += way * along[k] + (shape == 3 ? 0.02 * step * turn[k] : 0.0);
        }
    }
    return points;
}

void make_program(Random& random, int axes, bool columns, WildRound& round) {
    const bool feeds = columns && random.chance(0.3);
    const bool corners = columns && random.chance(0.3);
    std::vector<std::string> header;
    for (int k = 0; k < axes; ++k) {
        header.emplace_back(1, axis_names[static_cast<unsigned>(k)]);
    }
    if (feeds) {
        header.emplace_back("feed");
    }
    if (corners) {
        header.emplace_back("corner");
    }
    round.program = fmt::format("{}\n", fmt::join(header, ","));
    for (const Point& point : make_points(random, axes)) {
        std::vector<std::string> row;
        for (const unsigned k : splinefeed::indices(axes)) {
            row.push_back(fmt::format("{:.6f}", point[k]));
        }
        if (feeds) {
            row.push_back(random.chance(0.5) ? fmt::format("{:.6g}", random.decades(1.0, 1000.0)) : "");
        }
        if (corners) {
            row.emplace_back(random.chance(0.7) ? "" : random.chance(0.5) ? "1" : "0");
        }
        round.program += fmt::format("{}\n", fmt::join(row, ","));
    }
}

void write(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace

WildRound wild_round(std::uint64_t seed) {
    constexpr std::array curves{"g2",        "g2-bezier", "catmull-rom",           "catmull-rom-modified",
                                "bspline",   "polyline",  "bspline-interpolation", "ferguson",
                                "beta-chain"};
    constexpr std::array windows{16, 24, 64, 256, 1024};
    Random random(seed);
    WildRound round;
    round.seed = seed;
    const int axes = random.integer(1, 6);
    const auto curve = static_cast<unsigned>(random.integer(0, 8));
    make_machine(random, axes, round);
    make_program(random, axes, curve < 6, round);
    round.arguments.motion.quiet = true;
    round.arguments.path.curve.method = curves[curve];
    round.arguments.path.curve.closed = curve != 7 && random.chance(0.2);
    round.arguments.path.curve.smooth = curve >= 2 && curve <= 3 && random.chance(0.2);
    if (curve < 6 && random.chance(0.4)) {
        round.arguments.path.curve.corner_angle = random.chance(0.5) ? "180" : "20";
    }
    round.arguments.motion.planner.window_cells =
        static_cast<std::size_t>(windows[static_cast<unsigned>(random.integer(0, 4))]);
    round.orders = random.chance(0.4);
    return round;
}

std::string WildRound::events(double seconds) const {
    Random random(seed + 1);
    std::string text = "t,event,value\n";
    double t = 0.0;
    for (int i = random.integer(1, 6); i > 0; --i) {
        t += random.between(0.0, 0.4 * seconds);
        if (random.chance(0.4)) {
            text += fmt::format("{:.4f},hold,\n", t);
            t += random.decades(1e-3, 0.3);
            text += fmt::format("{:.4f},resume,\n", t);
        } else if (random.chance(0.2)) {
            text += fmt::format("{:.4f},override,0\n", t);
            t += random.decades(1e-3, 0.3);
            text += fmt::format("{:.4f},override,{:.2f}\n", t, random.between(0.3, 2.0));
        } else {
            text += fmt::format("{:.4f},override,{:.2f}\n", t, random.between(0.3, 2.0));
        }
    }
    return text;
}

RunArguments write_texts(const RunArguments& arguments, const std::string& machine, const std::string& program,
                         const std::string& events, const std::string& folder) {
    RunArguments written = arguments;
    written.path.input = folder + "/wild.csv";
    written.machine = folder + "/wild.toml";
    write(written.path.input, program);
    write(written.machine, machine);
    if (!events.empty()) {
        written.motion.events = folder + "/wild.events.csv";
        write(written.motion.events, events);
    }
    return written;
}

RunArguments write_wild(const WildRound& round, bool jerk_limited, double seconds, const std::string& folder) {
    const std::string& machine = jerk_limited ? round.jerk : round.machine;
    return write_texts(round.arguments, machine, round.program, seconds > 0.0 ? round.events(seconds) : "", folder);
}

std::string printed(const RunArguments& arguments, std::string_view scalar) {
    std::string text =
        fmt::format("splinefeed run wild.csv -m wild.toml --scalar {}{} --curve {} --window {}{}{}{}\n", scalar,
                    arguments.motion.planner.jerk_scalar == ScalarKind::float32 ? " --jerk-scalar float" : "",
                    *arguments.path.curve.method, arguments.motion.planner.window_cells,
                    arguments.path.curve.closed ? " --closed" : "", arguments.path.curve.smooth ? " --smooth" : "",
                    arguments.motion.events.empty() ? "" : " --events wild.events.csv");
    if (arguments.path.curve.corner_angle) {
        text.insert(text.size() - 1, " --corner-angle " + *arguments.path.curve.corner_angle);
    }
    for (const std::string& file : {arguments.machine, arguments.path.input, arguments.motion.events}) {
        text += file.empty() ? "" : fmt::format("# {}\n{}", file, contents(file));
    }
    return text;
}

} // namespace splinefeed_test
