// SPDX-License-Identifier: MIT
//
// Motions that are steered while they run, and an independent view of them: where on the path every sample is, and how
// long braking takes from there.
#pragma once

#include "stream_reference.hpp"

#include <functional>

namespace splinefeed_test {

enum class Order { hold, resume, abort, override_feed, limit_feed, override_rapids };

/// What is asked for before a segment is made.
struct Event {
    std::size_t segment = 0;
    Order order = Order::hold;
    double value = 0.0;
};

struct SteeredRun {
    std::vector<FeedSegment> segments;
    Activity activity = Activity::running;
    bool finished = false;
    bool endless = false;
    std::size_t busy = 0; // calls whose work was not enough
    PerAxis<Position> position{};
};

template <Scalar S>
void give(Trajectory<S>& trajectory, const Event& event) {
    switch (event.order) {
    case Order::hold: trajectory.hold(); break;
    case Order::resume: trajectory.resume(); break;
    case Order::abort: trajectory.abort(); break;
    case Order::override_rapids: trajectory.override_rapids(from_double<S>(event.value)); break;
    case Order::override_feed: trajectory.override_feed(from_double<S>(event.value)); break;
    case Order::limit_feed: trajectory.limit_feed(from_double<S>(event.value)); break;
    }
}

/// Runs to the end of the program, or to where the machine stands with no event left. While it stands and events are to
/// come, segments of standing still pass the time. @param supply  called when the input is starved
/// @param work  of a call of next(); where it was not enough, the next call follows
template <Scalar S>
void run_steered(Trajectory<S>& trajectory, const std::vector<Event>& events, SteeredRun& run,
                 const std::function<void()>& supply = {}, UnderrunPolicy underrun = UnderrunPolicy::wait,
                 const std::function<unsigned()>& work = {}) {
    FeedSegment segment;
    std::size_t next = 0;
    for (;;) {
        while (next < events.size() && events[next].segment <= run.segments.size()) {
            give(trajectory, events[next++]);
        }
        if (trajectory.next(segment, underrun, work ? work() : WorkBudget::unlimited) == Pull::item) {
            run.segments.push_back(segment);
        } else if (trajectory.state() == Pull::busy) {
            ++run.busy;
            continue;
        } else if (trajectory.state() == Pull::starved && supply) {
            supply();
            continue;
        } else if (trajectory.state() == Pull::held && next < events.size()) {
            if (!trajectory.stand(segment)) {
                break;
            }
            run.segments.push_back(segment);
        } else {
            break;
        }
        if (run.segments.size() >= 400'000) {
            run.endless = true;
            break;
        }
    }
    run.finished = trajectory.state() == Pull::finished;
    run.activity = trajectory.activity();
    run.position = trajectory.position();
}

template <Scalar S, Floating R = double>
SteeredRun run_steered(const BezierPath& path, const MachineSettings& machine, std::size_t window_size,
                       const std::vector<Event>& events) {
    const auto limits = limits_for<S, R>(machine).value();
    ListSource<S> source(segments_of<S>(path, {}), 0, 0);
    AnyTrajectory<S, R> any(source, limits, window_size);
    SteeredRun run;
    run_steered<S>(any.trajectory(), events, run);
    return run;
}

/// The sample, in units, that a segment starts next to.
inline Real sample_units(const FeedSegment& s, unsigned k) {
    const AxisMotion m = motion_of(s, k);
    return static_cast<Real>(m.p0) - static_cast<Real>(m.a0) / 6.0L;
}

inline bool ends_at_rest(const FeedSegment& s, unsigned axes) {
    bool rest = true;
    for (unsigned k = 0; k < axes; ++k) {
        const AxisMotion m = motion_of(s, k);
        rest = rest && m.v1 == 0 && m.a1 == 0;
    }
    return rest;
}

/// The path as the planner's cells have it, to be looked at from outside.
template <Scalar S>
class Track {
public:
    struct Place {
        std::size_t cell = 0;
        Real x = 0.0L; ///< fraction of its length
    };

    Track(const BezierPath& path, const MachineSettings& machine)
        : Track(ListSource<S>(path), MotionLimits<S>::make(machine).value(), machine) {}
    Track(ListSource<S> source, const MotionLimits<S>& limits, const MachineSettings& machine)
        : machine_(&machine), limits_(limits) {
        cells_ = cells_of<S>(source, limits.refinement);
        Real s = 0.0L;
        for (const Cell<S>& cell : cells_) {
            start_.push_back(s);
            s += exact(cell.length_mm);
        }
        length_ = s;
    }

    [[nodiscard]] Real s_of(const Place& place) const {
        return start_[place.cell] + place.x * exact(cells_[place.cell].length_mm);
    }
    [[nodiscard]] Real length() const { return length_; }

    /// Finds the sample on the path, at `place` or further on; its distance from the path [mm].
    Real find(const FeedSegment& segment, Place& place) const {
        PerAxis<Real> p{};
        for (const unsigned k : splinefeed::indices(machine_->axes)) {
            p[k] = sample_units(segment, k) / units_per_mm(machine_->axis[k]);
        }
        Real best = 1e30L;
        Place found = place;
        for (std::size_t i = place.cell; i < cells_.size() && i < place.cell + 400; ++i) {
            const Real x = nearest(cells_[i], p);
            const Real d = distance(cells_[i], x, p);
            if (d < best) {
                best = d;
                found = {i, x};
            }
            if (best < 1e-10L || (best < 1e-6L && d > 1e-3L)) {
                break;
            }
        }
        place = found;
        return best;
    }

    /// Least time to rest from a speed: braking as hard as the axes may be planned to, in steps of time. That is less
    /// than their limits by what MotionLimits::make keeps for rounding and joints, 2 % with float; and by what a float
    /// does not know of a bend.
    [[nodiscard]] Real braking_s(const Place& place, Real speed, Real step = 2e-6L) const {
        Real s = s_of(place);
        Real t = 0.0L;
        std::size_t cell = place.cell;
        while (speed > 0.0L && s < length_) {
            const Real a = least_acceleration(cell, s, speed * speed);
            const Real middle = speed + a * step / 2.0L;
            const Real am = middle > 0.0L ? least_acceleration(cell, s + speed * step / 2.0L, middle * middle) : a;
            if (speed + am * step <= 0.0L) {
                return t + speed / -am;
            }
            s += (speed + am * step / 2.0L) * step;
            speed += am * step;
            t += step;
        }
        return t;
    }

private:
    Real distance(const Cell<S>& cell, Real x, const PerAxis<Real>& p) const {
        Real unused = 0.0L;
        const Jet jet = evaluate(cell, inverse_at(cell, x, unused));
        Real sum = 0.0L;
        for (const unsigned k : splinefeed::indices(cell.axes)) {
            const Real d = exact_mm(cell.origin[k]) + jet.r[k] - p[k];
            sum += d * d;
        }
        return std::sqrt(sum);
    }
    Real nearest(const Cell<S>& cell, const PerAxis<Real>& p) const {
        const auto ahead = [&](Real x) { // of the foot of p, along the path
            Real unused = 0.0L;
            const Jet jet = evaluate(cell, inverse_at(cell, x, unused));
            Real sum = 0.0L;
            for (const unsigned k : splinefeed::indices(cell.axes)) {
                sum += (exact_mm(cell.origin[k]) + jet.r[k] - p[k]) * jet.d1[k];
            }
            return sum;
        };
        if (ahead(0.0L) >= 0.0L) {
            return 0.0L;
        }
        if (ahead(1.0L) <= 0.0L) {
            return 1.0L;
        }
        Real low = 0.0L;
        Real high = 1.0L;
        for (int i = 0; i < 60; ++i) {
            const Real middle = (low + high) / 2.0L;
            (ahead(middle) < 0.0L ? low : high) = middle;
        }
        return (low + high) / 2.0L;
    }
    Real least_acceleration(std::size_t& i, Real s, Real b) const {
        while (i + 1 < cells_.size() && start_[i + 1] <= s) {
            ++i;
        }
        Real unused = 0.0L;
        const Real x = std::min(1.0L, (s - start_[i]) / exact(cells_[i].length_mm));
        const Direction d = direction_at(cells_[i], inverse_at(cells_[i], x, unused));
        Real least = -1e30L;
        for (const unsigned k : splinefeed::indices(machine_->axes)) {
            const Real limit = exact(limits_.acceleration_mm_s2[k]) - unsure_bend(cells_[i], k) * b;
            if (std::fabs(d.tangent[k]) > 1e-12L) {
                const Real sign = d.tangent[k] > 0.0L ? 1.0L : -1.0L;
                least = std::max(least, (-limit - sign * d.curvature[k] * b) / std::fabs(d.tangent[k]));
            }
        }
        return least;
    }

    /// By how much the second derivative may be larger or smaller than the cell says. With float that is up to 2^-23 of
    /// a long move over the cell's length: no plan may use it. With the other scalars it is left out, and the bound is
    /// stricter.
    [[nodiscard]] Real unsure_bend(const Cell<S>& cell, unsigned k) const {
        if constexpr (std::same_as<S, float>) {
            return exact(cell.shape[k].error_bound) / exact(cell.length_mm);
        }
        return 0.0L;
    }

    const MachineSettings* machine_;
    MotionLimits<S> limits_;
    std::vector<Cell<S>> cells_;
    std::vector<Real> start_;
    Real length_ = 0.0L;
};

} // namespace splinefeed_test
