// SPDX-License-Identifier: MIT
#include "host_sim/analysis/path_deviation.hpp"
#include "host_sim/curve/segment_cast.hpp"
#include "splinefeed/s1_blended_path/element_cast.hpp"

#include "host_sim/program/element_file.hpp"
#include "host_sim/program/input_format.hpp"
#include "random_elements.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "support/bezier_paths.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

MachineSettings machine_of(int axes, int linear) {
    MachineSettings machine;
    machine.axes = axes;
    for (int k = linear; k < axes; ++k) {
        machine.axis[static_cast<unsigned>(k)].rotary = true;
    }
    return machine;
}

PathElement<double> line_to(double x, double y, double tolerance) {
    PathElement<double> out;
    out.to = {position_from_mm(x), position_from_mm(y)};
    out.tolerance_mm = tolerance;
    return out;
}

/// A Bezier segment between places, offsets from its first point.
CurveSegment<double> segment_of(const std::vector<std::array<double, 2>>& points, std::uint32_t waypoint) {
    CurveSegment<double> out;
    out.axes = 2;
    out.degree = static_cast<int>(points.size()) - 1;
    out.waypoint = waypoint;
    PerAxis<PerDegree<double>> offsets{};
    for (unsigned k = 0; k < 2; ++k) {
        out.origin[k] = position_from_mm(points.front()[k]);
        out.end[k] = position_from_mm(points.back()[k]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            offsets[k][static_cast<unsigned>(i)] = (points[i][k] - points[0][k]) * 4096.0;
        }
    }
    out.assign(offsets);
    return out;
}

template <Scalar S>
void require_kept(const ElementProgram& program, int axes, double joint_mm) {
    TolerancePath<S> path(axes, {from_double<S>(joint_mm)});
    PathDeviation deviation(machine_of(axes, std::min(axes, 3)), joint_mm, std::same_as<S, float> ? 1e-6 : 0.0);
    PathDeviation told = deviation; // it leaves nothing out
    told.tell([](std::uint64_t, double) {});
    REQUIRE(path.start(program.start()).ok());
    deviation.start(program.start());
    told.start(program.start());
    CurveSegment<S> segment;
    std::size_t pushed = 0;
    for (Pull pull = Pull::starved; pull != Pull::finished;) {
        pull = path.next(segment);
        if (pull == Pull::item) {
            deviation.segment(in_double(segment));
            told.segment(in_double(segment));
        } else if (pull == Pull::starved && pushed < program.moves()) {
            const PathElement<double> move = program.element(pushed);
            CAPTURE(pushed);
            const Status status = path.push(element_cast<S>(move));
            CAPTURE(describe(status.error()));
            CHECK(status.ok());
            deviation.move(move, pushed);
            told.move(move, pushed);
            ++pushed;
        } else if (pull == Pull::starved) {
            static_cast<void>(path.finish());
        }
    }
    deviation.finish();
    told.finish();
    CHECK(deviation.linear().distance == told.linear().distance);
    CHECK(deviation.linear().line == told.linear().line);
    CHECK(deviation.rotary().distance == told.rotary().distance);
    CHECK(deviation.rotary().line == told.rotary().line);
    if (const auto& excess = deviation.excess()) {
        const std::uint32_t element = program.element_of(excess->place.move);
        FAIL_CHECK(describe(*excess, element_name(element, 0))
                   << ", move " << excess->place.move << ", axes " << axes << ", " << typeid(S).name());
    }
}

} // namespace

TEST_CASE("the distance of a cut corner is found on both sides") {
    // The bisector cut off: 1 mm from the corner along both lines, so 0.707 mm from the vertex, and inside by 0.5 mm
    // at most.
    for (const double tolerance : {0.70, 0.71}) {
        PathDeviation deviation(machine_of(2, 2), 0.0, 0.0);
        deviation.start({});
        deviation.move(line_to(10, 0, tolerance), 3);
        deviation.move(line_to(10, 10, tolerance), 4);
        deviation.segment(segment_of({{0, 0}, {9, 0}}, 0));
        deviation.segment(segment_of({{9, 0}, {10, 1}}, 0));
        deviation.segment(segment_of({{10, 1}, {10, 10}}, 1));
        deviation.finish();
        CHECK(deviation.linear().distance == Approx(std::sqrt(0.5)));
        CHECK(deviation.linear().move == 0);
        CHECK(deviation.linear().line == 3);
        CHECK(deviation.excess().has_value() == (tolerance < 0.705));
        CHECK_FALSE(deviation.has_rotary());
    }
}

TEST_CASE("a path that leaves the moves, skips one or stays short of the end is noticed") {
    const auto excess = [](const std::vector<CurveSegment<double>>& segments) {
        PathDeviation deviation(machine_of(2, 2), 0.0, 0.0);
        deviation.start({});
        for (const auto& [x, y] : {std::pair{10.0, 0.0}, std::pair{10.0, 5.0}, std::pair{0.0, 5.0}}) {
            deviation.move(line_to(x, y, 0.01), 0);
        }
        for (const CurveSegment<double>& segment : segments) {
            deviation.segment(segment);
        }
        deviation.finish();
        return deviation.excess() ? deviation.excess()->place.distance : 0.0;
    };
    const auto first = segment_of({{0, 0}, {10, 0}}, 0);
    const auto second = segment_of({{10, 0}, {10, 5}}, 1);
    const auto third = segment_of({{10, 5}, {0, 5}}, 2);
    CHECK(excess({first, second, third}) == 0.0);
    CHECK(excess({first, segment_of({{10, 0}, {10.03, 2.5}, {10, 5}}, 1), third}) == Approx(0.015));
    CHECK(excess({first, second, segment_of({{10, 5}, {0.5, 5}}, 2)}) == Approx(0.5));
    CHECK(excess({first, segment_of({{10, 0}, {0, 5}}, 2)}) > 4.0);
    CHECK(excess({first, second, segment_of({{10, 5}, {5, 5.011}, {0, 5}}, 2)}) == 0.0);
    CHECK(excess({first, second, segment_of({{10, 5}, {5, 5.021}, {0, 5}}, 2)}) == Approx(0.0105));
}

TEST_CASE("moves of which the path has nothing are noticed, but for those shorter than rounding") {
    const auto excess = [](const std::vector<std::pair<double, double>>& places) {
        PathDeviation deviation(machine_of(2, 2), 0.0, 0.0);
        deviation.start({position_from_mm(10.0), position_from_mm(5.0)});
        for (const auto& [x, y] : places) {
            deviation.move(line_to(x, y, 0.01), 7);
        }
        deviation.finish();
        return deviation.excess() ? deviation.excess()->place.distance : 0.0;
    };
    CHECK(excess({}) == 0.0);
    CHECK(excess({{10.0, 5.0}}) == 0.0);
    CHECK(excess({{10.0, 5.00015}, {10.0001, 5.00015}}) == 0.0);
    CHECK(excess({{10.0, 8.0}}) == Approx(3.0));
    CHECK(excess({{10.0, 5.0001}, {13.0, 9.0}, {10.0, 5.0}}) == Approx(5.0));
}

TEST_CASE("the tolerance of a joint is the smaller one of its moves, and none where the machine stops") {
    const auto kept = [](double before, double after, PathMode mode, double joint) {
        PathDeviation deviation(machine_of(2, 2), joint, 0.0);
        deviation.start({});
        PathElement<double> first = line_to(10, 0, before);
        first.mode = mode;
        deviation.move(first, 0);
        deviation.move(line_to(10, 10, after), 0);
        deviation.segment(segment_of({{0, 0}, {9.9, 0}}, 0));
        deviation.segment(segment_of({{9.9, 0}, {10, 0}, {10, 0}, {10, 0.1}}, 0)); // 0.0177 mm
        deviation.segment(segment_of({{10, 0.1}, {10, 10}}, 1));
        deviation.finish();
        return !deviation.excess();
    };
    CHECK(kept(0.02, 0.02, PathMode::continuous, 0.0));
    CHECK_FALSE(kept(0.02, 0.01, PathMode::continuous, 0.0));
    CHECK_FALSE(kept(0.01, 0.02, PathMode::continuous, 0.0));
    CHECK_FALSE(kept(0.02, 0.02, PathMode::exact_stop, 0.02));
    CHECK_FALSE(kept(0.02, 0.02, PathMode::exact_path, 0.01));
    CHECK(kept(0.02, 0.02, PathMode::exact_path, 0.02));
    CHECK(kept(0.0, 0.02, PathMode::continuous, 0.02));
}

TEST_CASE("rotary axes are measured by themselves, in degrees") {
    PathDeviation deviation(machine_of(2, 1), 0.0, 0.0);
    deviation.start({});
    deviation.move(line_to(10, 0, 0.1), 0);
    deviation.move(line_to(10, 90, 0.1), 0);
    deviation.segment(segment_of({{0, 0}, {9, 0}}, 0));
    deviation.segment(segment_of({{9, 0}, {10, 1}}, 0));
    deviation.segment(segment_of({{10, 1}, {10, 90}}, 1));
    deviation.finish();
    CHECK(deviation.has_rotary());
    CHECK(deviation.linear().distance < 1e-9); // x alone passes every place of the moves, and so does y
    CHECK(deviation.rotary().distance < 1e-9);
    PathDeviation other(machine_of(2, 1), 0.0, 0.0);
    other.start({});
    other.move(line_to(10, 0, 0.1), 0);
    other.segment(segment_of({{0, 0}, {5, 0.4}, {10, 0}}, 0));
    other.finish();
    CHECK(other.rotary().distance == Approx(0.2));
    REQUIRE(other.excess());
    CHECK(other.excess()->rotary);
    CHECK(describe(*other.excess(), "element 1") ==
          "the path is 0.2 degrees from element 1; its tolerance allows 1e-06 degrees");
}

TEST_CASE("arcs of many turns, and long segments, are measured where they are") {
    PathElement<double> helix;
    helix.shape = MoveShape::arc;
    helix.to = {position_from_mm(10.0), position_from_mm(0.0), position_from_mm(30.0)};
    helix.arc.normal = {0.0, 0.0, 1.0};
    helix.arc.sweep_rad = 200.0 * std::numbers::pi;
    const PathStrand strand({position_from_mm(10.0)}, helix, 3);
    const AxisSet all{3, {0, 1, 2}};
    for (const double turns : {0.0, 0.25, 17.5, 99.9}) {
        const double angle = turns * 2.0 * std::numbers::pi;
        const auto at = [&](double radius) {
            return PerAxis<double>{radius * std::cos(angle), radius * std::sin(angle), 0.3 * turns};
        };
        CHECK(strand.distance(at(10.0), all) < 1e-9);
        CHECK(strand.distance(at(10.1), all) == Approx(0.1).epsilon(1e-3));
        CHECK(strand.distance(at(9.9), all) == Approx(0.1).epsilon(1e-3));
    }
    CHECK(strand.distance({0.0, 0.0, 40.0}, all) == Approx(std::hypot(10.0, 10.0)).epsilon(0.01));
}

TEST_CASE("a move shorter than rounding is left out, and its tolerance with it") {
    for (const bool stops : {false, true}) {
        PathDeviation deviation(machine_of(2, 2), 0.0, 0.0);
        deviation.start({});
        deviation.move(line_to(10, 0, 0.1), 0);
        PathElement<double> tiny = line_to(10, 5e-5, 0.0);
        tiny.stop_at_end = stops;
        deviation.move(tiny, 0);
        deviation.move(line_to(10, 10, 0.1), 0);
        deviation.segment(segment_of({{0, 0}, {9.9, 0}}, 0));
        deviation.segment(segment_of({{9.9, 0}, {10, 0}, {10, 0}, {10, 0.1}}, 0));
        deviation.segment(segment_of({{10, 0.1}, {10, 10}}, 2));
        deviation.finish();
        CHECK(deviation.excess().has_value() == stops);
    }
}

TEST_CASE("chains keep their own tolerance, and corners beside them that of their moves") {
    struct Off {
        double chain = 0.0;
        double corner = 0.0;
        std::uint64_t chains = 0;
    };
    // A wave of lines of 0.1 mm, and at its end a corner of 90 degrees.
    const auto off = [](double tolerance, double chain_tolerance) {
        std::vector<PathElement<double>> moves;
        for (int i = 1; i <= 300; ++i) {
            moves.push_back(line_to(0.1 * i, 0.3 * std::sin(0.25 * i), tolerance));
        }
        const double y = 0.3 * std::sin(75.0);
        moves.push_back(line_to(40.0, y, tolerance));
        moves.push_back(line_to(40.0, y + 10.0, tolerance));
        TolerancePath<double> path(2, {});
        PathDeviation wave(machine_of(2, 2), 0.0, 0.0);
        PathDeviation all(machine_of(2, 2), 0.0, 0.0);
        REQUIRE(path.start({}).ok());
        wave.start({});
        all.start({});
        CurveSegment<double> segment;
        std::size_t next = 0;
        for (Pull pull = Pull::starved; pull != Pull::finished;) {
            pull = path.next(segment);
            if (pull == Pull::item) {
                all.segment(segment);
                if (segment.waypoint < 295) {
                    wave.segment(segment);
                }
            } else if (pull == Pull::starved && next < moves.size()) {
                PathElement<double>& move = moves[next++];
                move.chain_tolerance_mm = chain_tolerance;
                REQUIRE(path.push(move).ok());
                all.move(move, 0);
                wave.move(move, 0);
            } else if (pull == Pull::starved) {
                REQUIRE(path.finish().ok());
            }
        }
        all.finish();
        CHECK_FALSE(all.excess());
        return Off{wave.linear().distance, all.linear().distance, path.counts().chains};
    };
    const Off both = off(0.02, 100.0); // the smaller one counts
    CHECK(off(0.02, 0.02).chain == both.chain);
    CHECK(both.chains == 1);
    CHECK(both.chain > 0.006);
    CHECK(both.corner == Approx(0.02).epsilon(0.01));
    const Off fine = off(0.02, 0.004);
    CHECK(fine.chains == 1);
    CHECK(fine.chain <= 0.004);
    CHECK(fine.chain > 0.001);
    CHECK(fine.corner == Approx(0.02).epsilon(0.01));
    const Off none = off(0.02, 0.0);
    CHECK(none.chains == 0);
    CHECK(none.corner == Approx(0.02).epsilon(0.01));
}

TEST_CASE("cusps, and turns that only another axis tells apart, keep their tolerances in every scalar") {
    const auto keep = [](const char* elements, int axes) {
        const std::vector<std::string> names(every_axis.begin(), every_axis.begin() + axes);
        const nlohmann::json document{{"elements", nlohmann::json::parse(elements)}};
        const ElementProgram program = read_elements(document, "e.json", names, {});
        require_kept<double>(program, axes, 0.0);
        require_kept<Fixed>(program, axes, 0.0);
        require_kept<float>(program, axes, 0.0);
    };
    keep(R"([{"type": "bezier", "mode": "exact_path", "from": [4.0222, -11.7126, 0], "to": [3.696, -11.812, 0],
              "control_points": [[4.0222, -11.7126, 0], [3.9126, -11.7561, 0], [3.5385, -11.852, 0],
                                 [3.696, -11.812, 0]]}])",
         3);
    keep(R"([{"type": "bezier", "tolerance_mm": 0.05, "from": [0, 0, 0], "to": [-0.762, -0.939, 0],
              "control_points": [[0, 0, 0], [-1.02, -2.216, 0], [6.673, 0.638, 0], [-0.762, -0.939, 0]]},
             {"type": "line", "tolerance_mm": 0.05, "from": [-0.762, -0.939, 0], "to": [2.608, 17.58, 0]}])",
         3);
    keep(R"([{"type": "arc", "tolerance_mm": 0.01, "from": [0.2, 0, 0, 22.45], "to": [-0.2, 0, 1e-12, 22.12],
              "centre": [0, 0, 0], "axis": [0, 0, 1], "angle": 21.991148575}])",
         4);
}

TEST_CASE("spirals keep the slack of a path, and nothing is forgiven them") {
    constexpr std::uint64_t seed = 3504;
    for (int round = 0; round < splinefeed_test::rounds(100, 1000); ++round) {
        splinefeed_test::Random random(seed + static_cast<std::uint64_t>(round));
        CAPTURE(seed, round);
        const double radius = random.decades(0.1, 100.0);
        const double growth = radius * random.decades(1e-5, 0.06) * (random.chance(0.5) ? 1.0 : -1.0);
        const double rise = random.chance(0.5) ? 0.0 : radius * random.decades(0.01, 30.0);
        const double angle = random.decades(0.05, 200.0) * (random.chance(0.5) ? 1.0 : -1.0);
        PathElement<double> arc;
        arc.mode = PathMode::exact_path;
        arc.shape = MoveShape::arc;
        arc.arc.normal = {0.0, 0.0, 1.0};
        arc.arc.sweep_rad = angle;
        arc.to = {position_from_mm((radius + growth) * std::cos(angle)),
                  position_from_mm((radius + growth) * std::sin(angle)), position_from_mm(rise)};
        const PerAxis<Position> start{position_from_mm(radius)};
        TolerancePath<double> path(3, {});
        PathDeviation deviation(machine_of(3, 3), 0.0, 0.0);
        REQUIRE(path.start(start).ok());
        deviation.start(start);
        REQUIRE(path.push(arc).ok());
        deviation.move(arc, 0);
        REQUIRE(path.finish().ok());
        CurveSegment<double> segment;
        while (path.next(segment) == Pull::item) {
            deviation.segment(segment);
        }
        deviation.finish();
        CAPTURE(radius, growth, rise, angle, deviation.linear().distance);
        CHECK_FALSE(deviation.excess());
        CHECK(deviation.linear().distance < 1e-6);
        if (std::fabs(angle) > 3.0) {
            continue; // far from many turns each place takes a search
        }
        PathDeviation circle(machine_of(3, 3), 0.0, 0.0); // about the same axis, as if the radius grew at the end alone
        circle.start(start);
        circle.move(arc, 0);
        const PerAxis<Position> end = arc.to;
        PathElement<double> without = arc;
        without.to = {position_from_mm(radius * std::cos(angle)), position_from_mm(radius * std::sin(angle)), end[2]};
        TolerancePath<double> other(3, {});
        REQUIRE(other.start(start).ok());
        REQUIRE(other.push(without).ok());
        REQUIRE(other.finish().ok());
        while (other.next(segment) == Pull::item) {
            circle.segment(segment);
        }
        circle.finish();
        CHECK(circle.excess());
    }
}

TEST_CASE("random programs keep their tolerances in every scalar") {
    const int count = splinefeed_test::rounds(32, 6000);
    for (int round = 0; round < count; ++round) {
        const std::uint64_t seed = 1000 + static_cast<std::uint64_t>(round);
        CAPTURE(seed);
        splinefeed_test::RandomElements random(seed);
        const int axes = 3 + random.random().below(4);
        const nlohmann::json document = random.document(2 + random.random().below(30), axes);
        const std::vector<std::string> names(every_axis.begin(), every_axis.begin() + axes);
        const ElementProgram program = read_elements(document, "e.json", names, {});
        const double joint = random.random().below(2) == 0 ? 0.0 : 0.001;
        require_kept<double>(program, axes, joint);
        require_kept<Fixed>(program, axes, joint);
        require_kept<float>(program, axes, joint);
    }
}
