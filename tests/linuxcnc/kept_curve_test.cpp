// SPDX-License-Identifier: MIT
#include "linuxcnc/kept_curve.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"

#include <memory>

using namespace splinefeed;
using splinefeed::linuxcnc::KeptCurve;
using splinefeed_test::Random;

namespace {

/// A chain of random quintics and lines; every seventh stops.
class Chain final : public CurveSource<double> {
public:
    Pull next(CurveSegment<double>& out) noexcept override {
        Random random(1 + sent);
        out = {};
        out.axes = 3;
        out.degree = sent % 3 == 2 ? 1 : 5;
        out.feed_mm_s = 10.0 + sent;
        out.stop_at_end = sent % 7 == 6;
        out.waypoint = sent / 2;
        out.origin = at;
        PerAxis<PerDegree<double>> offsets{};
        for (unsigned k = 0; k < 3; ++k) {
            for (unsigned i = 1; i <= static_cast<unsigned>(out.degree); ++i) {
                offsets[k][i] = offsets[k][i - 1] + random.between(0.1, 1.0) * chord_units_per_mm;
            }
        }
        out.assign(offsets);
        for (unsigned k = 0; k < 3; ++k) {
            out.end[k] = displaced(out.origin[k], out.control[k][static_cast<unsigned>(out.degree)], out.unit_log2);
        }
        at = out.end;
        ++sent;
        return sent > most ? Pull::starved : Pull::item;
    }
    PerAxis<Position> at{};
    std::uint32_t sent = 0;
    std::uint32_t most = ~0U;
};

PerAxis<Position> place_on(const CurveSegment<double>& segment, double u) {
    PerAxis<Position> out{};
    for (unsigned k = 0; k < 3; ++k) {
        PerDegree<double> p = segment.control[k];
        for (int r = segment.degree; r > 0; --r) {
            for (unsigned i = 0; i < static_cast<unsigned>(r); ++i) {
                p[i] += u * (p[i + 1] - p[i]);
            }
        }
        out[k] = displaced(segment.origin[k], p[0], segment.unit_log2);
    }
    return out;
}

double apart_mm(const PerAxis<Position>& a, const PerAxis<Position>& b) {
    double most = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        most = std::max(most, std::fabs(to_mm({a[k].raw - b[k].raw})));
    }
    return most;
}

} // namespace

TEST_CASE("the way back is the same curve, from where the machine turns to where it began", "[linuxcnc]") {
    for (const double u : {0.0, 1e-7, 0.3, 0.5, 0.999, 1.0}) {
        Chain chain;
        const auto curve = std::make_unique<KeptCurve>();
        curve->begin(chain);
        std::vector<CurveSegment<double>> there;
        CurveSegment<double> segment;
        for (unsigned n = 0; n < 20; ++n) { // the plan knows more than the machine has travelled
            REQUIRE(curve->next(segment) == Pull::item);
            CHECK(segment.waypoint == n);
            CHECK(curve->move_of(n) == n / 2);
            there.push_back(segment);
        }
        const PerAxis<Position> at = place_on(there[12], u);
        curve->turn(at, 12, true, 0);
        PerAxis<Position> end = at;
        unsigned count = 0;
        while (curve->next(segment) == Pull::item) {
            CAPTURE(u, segment.waypoint);
            REQUIRE(segment.waypoint <= 12);
            const CurveSegment<double>& same = there[segment.waypoint];
            CHECK(apart_mm(place_on(segment, 0.0), end) < (count == 0 ? 1e-11 : 1e-9));
            CHECK(segment.feed_mm_s == same.feed_mm_s);
            CHECK(segment.stop_at_end == (segment.waypoint == 0 || (segment.waypoint - 1) % 7 == 6));
            if (segment.waypoint != 12) {
                for (const double v : {0.25, 0.5, 0.75}) {
                    CHECK(apart_mm(place_on(segment, v), place_on(same, 1.0 - v)) < 2e-5);
                }
            } else {
                CHECK(apart_mm(place_on(segment, 0.5), place_on(same, 0.5 * u)) < 1e-9);
            }
            end = segment.end;
            ++count;
        }
        CHECK(count == (u > 1e-6 ? 13U : 12U));
        CHECK(apart_mm(end, PerAxis<Position>{}) < 1e-11);

        // Forward again, from within the way back, and on with what is new.
        const PerAxis<Position> again = place_on(there[3], 0.4);
        curve->turn(again, 3, false, 0);
        end = again;
        for (unsigned n = 3; n < 30; ++n) {
            REQUIRE(curve->next(segment) == Pull::item);
            CHECK(segment.waypoint == n);
            CHECK(segment.stop_at_end == (n % 7 == 6));
            CHECK(apart_mm(place_on(segment, 0.0), end) < 1e-9);
            end = segment.end;
        }
        CHECK(chain.sent == 30);
    }
}

TEST_CASE("the oldest segments are forgotten, and old moves are not travelled back", "[linuxcnc]") {
    Chain chain;
    const auto curve = std::make_unique<KeptCurve>();
    curve->begin(chain);
    CurveSegment<double> segment;
    CurveSegment<double> last;
    for (unsigned n = 0; n < 3 * KeptCurve::capacity; ++n) {
        REQUIRE(curve->next(segment) == Pull::item);
        last = segment;
    }
    const unsigned on = last.waypoint;
    curve->turn(place_on(last, 0.5), on, true, 0);
    unsigned count = 0;
    for (; curve->next(segment) == Pull::item; ++count) {
        CHECK(segment.waypoint == on - count);
    }
    CHECK(count == KeptCurve::capacity);
    CHECK(segment.stop_at_end);
    curve->turn(place_on(last, 0.5), on, true, curve->move_of(on) - 50);
    for (count = 0; curve->next(segment) == Pull::item; ++count) {
    }
    CHECK(count == 102 - (on % 2 == 0 ? 1U : 0U));
    curve->forget();
    curve->turn(place_on(last, 1.0), on, true, 0);
    CHECK(curve->next(segment) == Pull::starved);
    curve->turn(place_on(last, 1.0), on, false, 0);
    REQUIRE(curve->next(segment) == Pull::item);
    CHECK(segment.waypoint == on + 1);
}
