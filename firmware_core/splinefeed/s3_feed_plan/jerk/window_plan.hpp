// SPDX-License-Identifier: MIT
// WindowPlan: plans the cells of a JerkWindow leg by leg. A leg goes from a stop, or from where the machine will be, to
// the next stop, or to standstill at the end of the known path.
//
//      committed: final          planned: ends at standstill
//      |---------|---------------------------|
//      o---o---o---o---o---o---o---o---o---o---o---o   cells of the window
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"
#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

namespace splinefeed {

template <Scalar S, Floating R>
class WindowPlan {
public:
    explicit WindowPlan(JerkWindow<S, R>& window) noexcept : window_(&window), leg_(window.scratch()) {}

    /// Cells from the front on that are final.
    [[nodiscard]] std::size_t committed() const noexcept { return committed_; }
    /// Cells from the front on that have a plan, which ends at standstill.
    [[nodiscard]] std::size_t planned() const noexcept { return planned_; }
    /// Whether no cell came in since the last plan.
    [[nodiscard]] bool complete() const noexcept { return state_ == State::complete; }
    void outdate() noexcept { state_ = complete() ? State::outdated : state_; }
    /// @pre cells <= planned()
    void commit(std::size_t cells) noexcept { committed_ = cells; }
    /// A plan that was made elsewhere, without the cells behind it. It ends what runs.
    void take(std::size_t planned, std::size_t committed) noexcept {
        planned_ = planned;
        committed_ = committed;
        state_ = State::outdated;
        cancel();
    }
    /// The front cell is travelled. @pre committed() > 0
    void pop() noexcept {
        --committed_;
        --planned_;
        if (running()) { // it began behind it
            --first_;
            --at_;
        }
    }
    /// Forgets everything.
    void clear() noexcept {
        take(0, 0);
        hops_ = 1;
        covered_ = {};
    }

    /// Begins to plan anew what is not committed. @param ended  no cell comes behind the window
    void begin(bool ended) noexcept {
        leg_.take();
        leg_cells_ = 0;
        ended_ = ended;
        first_ = at_ = committed_;
    }
    [[nodiscard]] bool running() const noexcept { return leg_.held(); }
    /// Ends what runs, without a new plan.
    void cancel() noexcept { leg_.give_back(); }
    /// Ends what runs, and commits what it has planned, or a cell of the plan before. @pre planned() > 0
    void give_up() noexcept {
        committed_ = running() && at_ > first_ ? at_ : 1;
        cancel();
        outdate();
    }
    /// Plans legs from the front on, up to the middle of the window at least, and commits them. false: the budget is
    /// spent; call again. Cost: a cell that comes into a leg is a step of the budget. A
    /// step of a search is LegPlan's step_work().
    bool run(WorkBudget& work) noexcept;

    /// How often a leg was searched to its end.
    [[nodiscard]] std::uint64_t searched_legs() const noexcept { return searched_legs_; }
    /// How often such a leg could not be planned as fast as possible.
    [[nodiscard]] std::uint64_t slow_legs() const noexcept { return slow_legs_; }
    /// How often such a leg was slower than its path allows, because the window ends so near.
    [[nodiscard]] std::uint64_t window_limited() const noexcept { return window_limited_; }

private:
    enum class State : std::uint8_t {
        outdated, ///< cells came in since the last plan
        complete,
        goes_on ///< by an old plan, because no new one was found
    };

    /// v^2 from which the machine can stop in what is known ahead.
    struct Covered {
        R b = largest<R>();
        R ahead_mm = R(1);
        R growth{}; ///< of b by the next leg that does not reach it
        [[nodiscard]] bool binds() const noexcept { return growth > R(0); }
        /// With another look-ahead: as the acceleration or the jerk would have it, whichever is more.
        [[nodiscard]] R by(R mm) const noexcept {
            const R ratio = mm / ahead_mm;
            return b * larger(ratio, power_two_thirds(ratio * ratio));
        }
    };

    void add_cell() noexcept;
    Search search_leg(WorkBudget& work) noexcept;
    [[nodiscard]] bool stops_at(std::size_t end) const noexcept;
    [[nodiscard]] R ahead_mm(std::size_t first) const noexcept;
    [[nodiscard]] std::size_t final_cells(std::size_t first, std::size_t cells) const noexcept;
    void look_ahead(std::size_t committed) noexcept;
    std::size_t rest_to_rest(std::size_t first, std::size_t end) noexcept;

    JerkWindow<S, R>* window_;
    LegLease<R> leg_;           // that is planned now, from at_ on
    std::size_t leg_cells_ = 0; // so many; 0: none yet
    std::size_t first_ = 0;     // cell that is planned anew
    std::size_t at_ = 0;        // up to here
    std::size_t committed_ = 0;
    std::size_t planned_ = 0;
    std::size_t hops_ = 1; // cells that are passed from standstill to standstill if no plan is found; doubled each time
    std::uint64_t searched_legs_ = 0;
    std::uint64_t slow_legs_ = 0;
    std::uint64_t window_limited_ = 0;
    Covered covered_;
    R most_sq_{}; // cap of this leg by it
    State state_ = State::outdated;
    bool ended_ = false;
};

} // namespace splinefeed
