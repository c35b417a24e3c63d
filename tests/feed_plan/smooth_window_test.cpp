// SPDX-License-Identifier: MIT
//
// What the cells of a window ask for: no less than each of the cells that the average can be in, found step by step.
#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_window.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 5150;

/// There is no stop at the end of the cell.
bool moves_behind(const std::vector<SmoothCell<double>>& cells, std::size_t i) {
    return i + 1 < cells.size() && cells[i + 1].bound_sq > 0.0;
}

/// Mean distance over so many ticks from the end of cell i on, at the bounds of the cells; backward from its start.
Real reach(const std::vector<SmoothCell<double>>& cells, std::size_t i, Real ticks, bool backward) {
    Real time = 0.0L;
    Real way = 0.0L;
    Real area = 0.0L;
    const Real step = ticks / 20000.0L;
    std::size_t j = i;
    Real left = 0.0L; // ticks of cell j
    for (; time < ticks; time += step) {
        while (left <= 0.0L && (backward ? cells[j].bound_sq > 0.0 : moves_behind(cells, j))) {
            j = backward ? j - 1 : j + 1;
            left += real(cells[j].bound_ticks);
        }
        if (left > 0.0L) {
            way += step * real(cells[j].cell.length_mm) / real(cells[j].bound_ticks);
            left -= step;
        }
        area += way * step;
    }
    return area / ticks;
}

} // namespace

TEST_CASE("a cell's demand is that of all that the average can reach", "[feed_plan][smooth]") {
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    for (AxisSettings& axis : machine.axis) {
        axis.max_jerk_mm_s3 = 1e5;
    }
    const auto limits = MotionLimits<double>::make(machine).value();
    Random random(seed);
    ListSource<double> source(random_path(random, 2, 5, 4.0, 0.0, 0.0));
    const Planned<double> planned = plan_of<double>(source, limits, 512);
    std::vector<SmoothCell<double>> storage(planned.cells.size() + 8);
    SmoothWindow<double> window(limits, storage);
    for (const PlannedCell<double>& c : planned.cells) {
        window.append(c.cell, c.cap_sq, 1e4, c.exit_sq);
    }
    window.prepare(false);
    REQUIRE(window.prepared() == window.size());
    std::vector<SmoothCell<double>> cells;
    for (std::size_t i = 0; i < window.size(); ++i) {
        cells.push_back(window.at(i));
    }
    std::size_t wide = 0;
    for (std::size_t i = 0; i < cells.size(); i += 3) {
        const Real ticks = static_cast<Real>(cells[i].smoothing_q8) / 256.0L;
        const Real ahead = reach(cells, i, ticks, false);
        const Real behind = reach(cells, i, ticks, true);
        std::size_t first = i;
        while (cells[first].bound_sq > 0.0) {
            --first;
        }
        std::size_t end = i + 1;
        while (moves_behind(cells, end - 1)) {
            ++end;
        }
        PathDerivativeBounds<double> most;          // of no more than a hundredth of the reach beyond it
        for (std::size_t j = first; j < end; ++j) { // of the same leg
            const Real way = static_cast<Real>(units_between(cells[i].start, cells[j].start)) * 0x1p-40L;
            const Real from = way - real(cells[i].cell.length_mm);
            const Real to = way + real(cells[j].cell.length_mm);
            if (from < 1.01L * ahead && -to < 1.01L * behind) {
                most.join(PathDerivativeBounds<double>::of(cells[j].cell, 1e4, 1e4), 2);
            }
            if (from < ahead && -to < behind) {
                const auto own = PathDerivativeBounds<double>::of(cells[j].cell, 1e4, 1e4);
                for (unsigned k = 0; k < 2; ++k) {
                    CAPTURE(seed, i, j, k);
                    REQUIRE(cells[i].demand.axis[k].first >= own.axis[k].first);
                    REQUIRE(cells[i].demand.axis[k].second >= own.axis[k].second);
                    REQUIRE(cells[i].demand.axis[k].third_with >= own.axis[k].third_with);
                    REQUIRE(cells[i].demand.axis[k].third_against >= own.axis[k].third_against);
                }
                ++wide;
            }
        }
        for (unsigned k = 0; k < 2; ++k) {
            CAPTURE(seed, i, k);
            REQUIRE(cells[i].demand.axis[k].second <= most.axis[k].second);
            REQUIRE(cells[i].demand.axis[k].third_with <= most.axis[k].third_with);
            REQUIRE(cells[i].demand.axis[k].third_against <= most.axis[k].third_against);
        }
    }
    CHECK(wide > 2 * cells.size() / 3); // more than the cells themselves
}

TEST_CASE("in a window that is too small the average stays in what is known", "[feed_plan][smooth]") {
    MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = 1e4; // averaged over up to 100 ms, in which it goes 10 mm
    const auto limits = MotionLimits<double>::make(machine).value();
    ListSource<double> source(BezierPath(1000, line_shape(1, 3, {0.05})));
    const Planned<double> planned = plan_of<double>(source, limits, 4096);
    std::vector<SmoothCell<double>> storage(24);
    SmoothWindow<double> window(limits, storage);
    std::size_t slower = 0;
    for (const PlannedCell<double>& c : planned.cells) {
        while (!window.has_room()) {
            window.prepare(false);
            const std::size_t known = window.prepared();
            window.prepare(true);
            REQUIRE(window.prepared() > window.front());
            slower += window.prepared() > known ? 1U : 0U;
            std::vector<SmoothCell<double>> cells;
            Real length = 0.0L;
            for (std::size_t i = 0; i < window.size(); ++i) {
                cells.push_back(window.at(i));
                length += real(cells[i].cell.length_mm);
            }
            // And what comes behind it, at the speed at its end
            cells.push_back(cells.back());
            cells.back().cell.length_mm *= 1e6;
            cells.back().bound_ticks *= 1e6;
            for (std::size_t i = 0; i < window.prepared(); ++i) {
                length -= real(cells[i].cell.length_mm); // behind cell i
                const Real ticks = static_cast<Real>(cells[i].smoothing_q8) / 256.0L;
                CAPTURE(i, window.size(), static_cast<double>(length), static_cast<double>(ticks));
                REQUIRE((i < window.front() || reach(cells, i, ticks, false) <= length * 1.001L));
            }
            window.pass_front();
            if (window.front() > 4) {
                window.release();
            }
        }
        window.append(c.cell, c.cap_sq, 1e4, c.exit_sq);
    }
    CHECK(slower > 20);
}
