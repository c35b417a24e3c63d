// SPDX-License-Identifier: MIT
#include "host_sim/program/element_file.hpp"

#include "host_sim/base/json_text.hpp"
#include "host_sim/program/element_curves.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

const std::vector<std::string> xyz{"x", "y", "z"};

ElementProgram read(const std::string& elements, const std::vector<std::string>& axes = xyz,
                    const std::string& more = "") {
    const std::string text = R"({"elements": [)" + elements + "]" + more + "}";
    return read_elements(parse_json(text, "e.json"), "e.json", axes, {});
}

PerAxis<double> mm(const PerAxis<Position>& place) {
    PerAxis<double> out{};
    for (unsigned k = 0; k < out.size(); ++k) {
        out[k] = to_mm(place[k]);
    }
    return out;
}

/// A place of a Bezier move that begins at `from`.
PerAxis<double> at(const PerAxis<double>& from, const BezierShape<double>& bezier, double t) {
    PerAxis<double> out = from;
    for (unsigned k = 0; k < out.size(); ++k) {
        PerDegree<double> row = bezier.points[k];
        for (unsigned last = static_cast<unsigned>(bezier.degree); last > 0; --last) {
            for (unsigned i = 0; i < last; ++i) {
                row[i] += t * (row[i + 1] - row[i]);
            }
        }
        out[k] += row[0] / 4096.0;
    }
    return out;
}

const std::string line = R"({"from": [0, 0, 0], "to": [10, 0, 0], "feed_mm_s": 20})";
const std::string quarter =
    R"({"type": "arc", "from": [10, 0, 0], "to": [0, 10, 0], "centre": [0, 0, 0], "axis": [0, 0, 2], )"
    R"("angle": 1.570796, "rapid": true})";

} // namespace

TEST_CASE("Elements become moves with their feeds, modes and tolerances") {
    const ElementProgram program =
        read(R"({"type": "line", "from": [1, 2, 3], "to": [10, 0, 0], "feed_mm_s": 20, "mode": "exact_path",
                 "line_number": 7, "turns": 3},)" +
             quarter + R"(,{"from": [0, 10, 0], "to": [0, 0, 0], "tolerance_mm": 0.5, "mode": "exact_stop"})");
    REQUIRE(program.moves() == 3);
    CHECK(program.elements() == 3);
    CHECK(program.line_of(0) == 7);
    CHECK(program.line_of(1) == 0);
    CHECK(mm(program.start())[2] == 3.0);
    const PathElement<double> first = program.element(0);
    CHECK(first.shape == MoveShape::line);
    CHECK(first.mode == PathMode::exact_path);
    CHECK(first.feed_mm_s == 20.0);
    CHECK(first.tolerance_mm == 0.01);
    CHECK(mm(first.to)[0] == 10.0);
    const PathElement<double> arc = program.element(1);
    CHECK(arc.shape == MoveShape::arc);
    CHECK(arc.mode == PathMode::continuous);
    CHECK(arc.feed_mm_s == 0.0);
    CHECK(arc.tolerance_mm == 0.1);
    CHECK(arc.arc.normal[2] == 1.0);
    CHECK(arc.arc.sweep_rad == Approx(std::numbers::pi / 2).epsilon(1e-12)); // as the end has it
    const PathElement<double> last = program.element(2);
    CHECK(last.tolerance_mm == 0.5);
    CHECK(last.mode == PathMode::exact_stop);
    CHECK(element_name(0, 7) == "element 1 (line 7)");
    CHECK(element_name(4, 0) == "element 5");
}

TEST_CASE("Dwells and events stop the machine before them") {
    const std::string two = line + R"(,{"from": [10, 0, 0], "to": [20, 0, 0]})";
    const ElementProgram program =
        read(two, xyz, R"(, "dwells": [{"after_element": 1, "seconds": 2.5}], "events": [{"after_element": 0}])");
    CHECK(program.element(0).stop_at_end);
    CHECK_FALSE(program.element(1).stop_at_end);
    REQUIRE(program.dwells().size() == 1);
    CHECK(program.dwells()[0].before == 1);
    CHECK(program.dwells()[0].seconds == 2.5);
    CHECK(read(two, xyz, R"(, "events": [{"after_element": 2, "what": "stop"}])").element(1).stop_at_end);
}

TEST_CASE("Axes are found by their names") {
    const std::string turn = R"({"from": [0, 0, 5, 0], "to": [10, 0, 5, 90]})";
    const ElementProgram program = read(turn, {"a", "x"});
    CHECK(mm(program.element(0).to)[0] == 90.0);
    CHECK(mm(program.element(0).to)[1] == 10.0);
    CHECK(axes_of_elements(parse_json(R"({"elements": [)" + turn + "]}", "e.json")) ==
          std::vector<std::string>{"x", "y", "z", "a"});
}

TEST_CASE("Arcs that the core does not take become Bezier segments") {
    for (const std::vector<std::string>& axes : {std::vector<std::string>{"y", "x"}, {"x", "y", "a"}}) {
        const ElementProgram program = read(line + "," + quarter, axes);
        CHECK(program.moves() > 3);
        const unsigned x = axes[0] == "x" ? 0 : 1;
        PerAxis<double> from{};
        for (std::size_t i = 0; i < program.moves(); ++i) {
            const PathElement<double> move = program.element(i);
            if (i > 0) {
                REQUIRE(move.shape == MoveShape::bezier);
                for (const double t : {0.0, 0.3, 0.7, 1.0}) {
                    const PerAxis<double> place = at(from, move.bezier, t);
                    CHECK(std::hypot(place[x], place[1 - x]) == Approx(10.0).margin(1e-6));
                }
            }
            from = mm(move.to);
        }
    }
    const ElementProgram spiral = read(
        R"({"type": "arc", "from": [10, 0, 0], "to": [-12, 0, 4], "centre": [0, 0, 0], "axis": [0, 0, 1], "angle": 3.14159265})");
    CHECK(spiral.element(0).shape == MoveShape::bezier);
    CHECK(spiral.elements() == 1);
    CHECK(mm(spiral.end())[0] == -12.0);
}

TEST_CASE("Splines become Bezier segments") {
    const ElementProgram bezier = read(
        R"({"type": "bezier", "from": [0, 0, 0, 0], "to": [3, 0, 0, 9], "control_points": [[0, 0, 0], [1, 2, 0], [2, 2, 0], [3, 0, 0]]})",
        {"x", "y", "a"});
    const BezierShape<double> shape = bezier.element(0).bezier;
    CHECK(shape.degree == 3);
    CHECK(shape.points[1][1] == 2.0 * 4096.0);
    CHECK(shape.points[2][1] == Approx(3.0 * 4096.0)); // in proportion to the parameter
    const std::string points = R"("from": [0, 0, 0], "to": [4, 0, 0],
        "control_points": [[0, 0, 0], [1, 3, 0], [2, -1, 2], [3, 2, 0], [4, 0, 0]], "knots": [0, 0, 0, 0, 1, 2, 2, 2, 2], "order": 4)";
    const ElementProgram plain = read(R"({"type": "nurbs", "weights": [2, 2, 2, 2, 2], )" + points + "}");
    CHECK(plain.moves() == 2);
    CHECK(plain.element(0).bezier.degree == 3);
    CHECK(plain.element(0).bezier.points[1][1] == Approx(3.0 * 4096.0));
    // A quarter of a circle, exactly.
    const ElementProgram rational = read(
        R"({"type": "nurbs", "from": [5, 0, 0], "to": [0, 5, 0], "control_points": [[5, 0, 0], [5, 5, 0], [0, 5, 0]],
            "weights": [1, 0.70710678118654752, 1], "knots": [0, 0, 0, 1, 1, 1], "order": 3, "mode": "exact_stop"})");
    REQUIRE(rational.moves() > 1);
    PerAxis<double> from = mm(rational.start());
    for (std::size_t i = 0; i < rational.moves(); ++i) {
        const PathElement<double> move = rational.element(i);
        CHECK(move.bezier.degree == 5);
        CHECK((move.mode == PathMode::exact_stop) == (i + 1 == rational.moves()));
        for (const double t : {0.1, 0.5, 0.8}) {
            const PerAxis<double> place = at(from, move.bezier, t);
            CHECK(std::hypot(place[0], place[1]) == Approx(5.0).margin(1e-6));
        }
        from = mm(move.to);
    }
}
