// SPDX-License-Identifier: MIT
//
// Single step, as motmod asks for it: a step ends where the line that the module shows is another one.
#include "tp_control.hpp"

#include "support/bezier_paths.hpp"
#include "support/rounds.hpp"

using namespace linuxcnc_test;
using splinefeed_test::first_round;
using splinefeed_test::Random;
using splinefeed_test::rounds;

namespace {

constexpr double pi = 3.14159265358979323846;

/// motmod around the module: pause, step, resume.
class Operator {
public:
    explicit Operator(const tpc_machine& machine) : control(machine) {}

    void pause() { paused_ = true; }
    void step() {
        from_ = id_;
        stepping_ = true;
        paused_ = false;
    }
    void resume() { stepping_ = paused_ = false; }
    void period() {
        if (stepping_ && id_ != from_) {
            paused_ = true;
            stepping_ = false;
        }
        control.input.hold = paused_ ? 1 : 0;
        control.input.steps = stepping_ ? 1 : 0;
        control.period();
        REQUIRE(std::string(control.out.error == nullptr ? "no error" : control.out.error) == "no error");
        if (control.out.first == control.out.last) {
            id_ = 0;
        } else if (control.out.in_step == 0 || id_ == 0) {
            id_ = control.out.first + 1U;
        }
    }
    void periods(int n) {
        for (int i = 0; i < n; ++i) {
            period();
        }
    }
    /// A step, until the machine stands behind it.
    void whole_step() {
        step();
        int n = 0;
        for (period(); n < 100'000 && (stepping_ || control.out.speed > 0.0); ++n) {
            period();
        }
        REQUIRE(n < 100'000);
        periods(60); // and it stays there
        REQUIRE(control.out.speed == 0.0);
    }
    [[nodiscard]] double x() const { return control.out.position[0]; }
    [[nodiscard]] double y() const { return control.out.position[1]; }
    [[nodiscard]] bool over() const { return control.out.first == control.out.last; }

    Control control;

private:
    unsigned id_ = 0;
    unsigned from_ = 0;
    bool stepping_ = false;
    bool paused_ = false;
};

constexpr tpc_mode modes[] = {TPC_CONTINUOUS, TPC_EXACT_PATH, TPC_EXACT_STOP};

} // namespace

TEST_CASE("a step from a pause ends on the end of each move, and does not begin the next one", "[linuxcnc]") {
    const std::pair<double, double> ends[] = {{60.0, 0.0}, {60.0, -20.0}, {120.0, -20.0}, {180.0, -20.0}};
    for (const tpc_mode mode : modes) {
        for (const double jerk : {0.0, 30'000.0}) {
            for (const int standing : {0, 500}) { // periods between the pause and the first step: 0: it moves
                Operator at(machine_of(3, 0.001, jerk));
                for (const auto& [x, y] : ends) {
                    tpc_move move = line_to(x, y, 100.0, 0.05);
                    move.mode = mode;
                    REQUIRE(at.control.add(move) == 0);
                }
                while (at.x() < 15.0) {
                    at.period();
                }
                at.pause();
                at.periods(standing);
                CAPTURE(mode, jerk, standing);
                for (const auto& [x, y] : ends) {
                    at.whole_step();
                    CHECK(at.x() == Approx(x).margin(1e-9));
                    CHECK(at.y() == Approx(y).margin(1e-9));
                }
                CHECK(at.over());
                CHECK(at.control.use() <= 1.0001);
            }
        }
    }
}

TEST_CASE("a step ends on the next end where the machine cannot stop on that of its move", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        Operator at(machine_of(3, 0.001, jerk));
        for (const double x : {60.0, 120.0, 180.0}) {
            REQUIRE(at.control.add(line_to(x, 0.0, 100.0)) == 0);
        }
        while (at.x() < 59.0) {
            at.period();
        }
        at.whole_step(); // while it moves
        CHECK(at.x() == Approx(120.0).margin(1e-9));
        at.whole_step();
        CHECK(at.x() == 180.0);
        CHECK(at.control.use() <= 1.0001);
    }
}

TEST_CASE("behind single step moves are joined again", "[linuxcnc]") {
    Operator at(machine_of(3, 0.001, 0.0));
    for (const double x : {20.0, 40.0, 60.0, 80.0}) {
        REQUIRE(at.control.add(line_to(x, 0.0, 50.0)) == 0);
    }
    at.periods(100);
    at.pause();
    at.periods(300);
    at.whole_step();
    CHECK(at.x() == Approx(20.0).margin(1e-9));
    at.resume();
    while (at.x() < 30.0) {
        at.period();
    }
    while (at.x() < 70.0) {
        at.period();
        CHECK(at.control.out.speed == Approx(50.0));
    }
}

TEST_CASE("what a step leaves of an arc keeps its whole turns, and its circle", "[linuxcnc]") {
    for (const double jerk : {0.0, 30'000.0}) {
        for (const double sweep : {2.0 * pi, -2.0 * pi, 6.5 * pi, -1.5 * pi}) {
            for (const double part : {0.0, 0.2, 0.5, 0.75}) { // of its time at its feed, before the pause
                Operator at(machine_of(3, 0.001, jerk));
                tpc_move arc = line_to(0.0, 0.0, 50.0, 0.2);
                arc.arc = 1;
                arc.centre[0] = -5.0;
                arc.normal[2] = 1.0;
                arc.sweep_rad = sweep;
                arc.to[0] = -5.0 + 5.0 * std::cos(sweep);
                arc.to[1] = 5.0 * std::sin(sweep);
                REQUIRE(at.control.add(arc) == 0);
                REQUIRE(at.control.add(line_to(20.0, 0.0, 50.0, 0.2)) == 0);
                at.periods(static_cast<int>(part * std::fabs(sweep) * 5.0 / 50.0 * 1000.0));
                REQUIRE(at.control.out.first == 0);
                at.pause();
                at.periods(400);
                at.whole_step();
                CAPTURE(jerk, sweep, part);
                CHECK(at.x() == Approx(arc.to[0]).margin(1e-9));
                CHECK(at.y() == Approx(arc.to[1]).margin(1e-9));
                double turned = 0.0;
                const auto& places = at.control.places;
                for (std::size_t n = 1; n < places.size(); ++n) {
                    const double a[] = {places[n - 1][0] + 5.0, places[n - 1][1], places[n][0] + 5.0, places[n][1]};
                    turned += std::atan2(a[0] * a[3] - a[1] * a[2], a[0] * a[2] + a[1] * a[3]);
                    CHECK(std::hypot(a[2], a[3]) == Approx(5.0).margin(0.2));
                }
                CHECK(turned == Approx(sweep).margin(1e-6));
                CHECK(at.control.use() <= 1.0001);
            }
        }
    }
}

TEST_CASE("wherever an operator steps, each step ends on an end, and no limit is exceeded", "[linuxcnc]") {
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(60, 2000)); ++n) {
        Random random(4711 + n);
        const double jerk = random.chance(0.5) ? 30'000.0 : 0.0;
        const double size = random.decades(0.1, 20.0); // small ones are joined into chains
        const double tolerance = random.decades(0.005, 0.2);
        Operator at(machine_of(3, random.chance(0.5) ? 0.001 : 0.00025, jerk));
        CAPTURE(n, jerk, size, tolerance);
        std::vector<std::pair<double, double>> ends;
        double x = 0.0;
        double y = 0.0;
        for (int i = 0; i < random.integer(3, 40); ++i) {
            tpc_move move = line_to(x + random.between(-size, size), y + random.between(-size, size),
                                    random.decades(5.0, 100.0), tolerance);
            move.mode = modes[random.chance(0.7) ? 0 : random.integer(0, 2)];
            move.rapid = random.chance(0.1) ? 1 : 0;
            const double radius = 0.5 * std::hypot(move.to[0] - x, move.to[1] - y);
            if (random.chance(0.4) && radius > 0.01) { // a half circle, or one and a half
                move.arc = 1;
                move.centre[0] = 0.5 * (move.to[0] + x);
                move.centre[1] = 0.5 * (move.to[1] + y);
                move.normal[2] = random.chance(0.5) ? 1.0 : -1.0;
                move.sweep_rad = (random.chance(0.5) ? 1.0 : -1.0) * (random.chance(0.2) ? 3.0 : 1.0) * pi;
            }
            if (at.control.add(move) != 0) {
                continue;
            }
            x = move.to[0];
            y = move.to[1];
            ends.emplace_back(x, y);
        }
        while (!at.over()) {
            at.periods(random.integer(0, 400));
            if (random.chance(0.8)) {
                at.pause();
                at.periods(random.chance(0.3) ? random.integer(0, 40) : 500);
            }
            for (int k = random.integer(1, 5); k > 0 && !at.over(); --k) {
                const unsigned first = at.control.out.first;
                at.whole_step();
                const unsigned over = at.control.out.first;
                REQUIRE(over > first);
                CHECK(at.x() == Approx(ends[over - 1].first).margin(1.5e-4));
                CHECK(at.y() == Approx(ends[over - 1].second).margin(1.5e-4));
            }
            at.resume();
        }
        CHECK(at.x() == Approx(x).margin(1.5e-4)); // less than 0.1 um is no move
        CHECK(at.y() == Approx(y).margin(1.5e-4));
        CHECK(at.control.use() <= 1.0001);
        CHECK(at.control.figures().late == 0);
    }
}
