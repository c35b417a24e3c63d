// SPDX-License-Identifier: MIT
// ScalarStream: a MoveStream in one scalar: path within a tolerance, trajectory.
#pragma once

#include "splinefeed/move_stream/move_stream.hpp"
#include "splinefeed/s1_blended_path/element_cast.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s1_curve/curve_filter.hpp"
#include "splinefeed/trajectory.hpp"

namespace splinefeed {

/// The path is made anew at each place() and restart(). Memory: that of TolerancePath and a move.
template <Scalar S>
class ScalarStream final : public MoveStream {
public:
    /// Moves within their tolerance. All that it refers to must outlive it. @pre Trajectory::make() accepts limits and
    /// planner
    /// @param rules   path_rules() of the machine
    /// @param filter  between path and plan; null: nothing
    ScalarStream(const MotionLimits<S>& limits, Planner<S>& planner, const PathRules<S>& rules,
                 CurveFilter<S>* filter = nullptr) noexcept;
    /// A curve that comes whole, or is fed by somebody else: no move is pushed, and it has one place.
    ScalarStream(const MotionLimits<S>& limits, Planner<S>& planner, CurveFilter<S>& curve) noexcept;
    /// The path alone, to be looked at by curve(): nothing of what comes out may be called.
    ScalarStream(int axes, const PathRules<S>& rules, CurveFilter<S>* filter) noexcept;
    ScalarStream(const ScalarStream&) = delete;
    ScalarStream& operator=(const ScalarStream&) = delete;

    Status place(const PerAxis<Position>& position) noexcept override;
    void restart() noexcept override;
    [[nodiscard]] bool has_room() const noexcept override { return !stops_ && path_->has_room(); }
    [[nodiscard]] Result<bool> push(const PathElement<ProgramScalar>& move) noexcept override {
        if constexpr (std::same_as<S, ProgramScalar>) { // without a copy on a chip's stack
            return take(move);
        } else {
            return take(element_cast<S>(move));
        }
    }
#if __STDC_HOSTED__
    [[nodiscard]] Result<bool> push(const PathElement<double>& move) noexcept override {
        return take(element_cast<S>(move));
    }
#endif
    bool stop() noexcept override;
    void go_on() noexcept override {
        stops_ = false;
    }
    Status finish() noexcept override;
    [[nodiscard]] std::uint32_t moves() const noexcept override {
        return moves_;
    }
    [[nodiscard]] bool keeps_back() const noexcept override {
        return keeps_;
    }
    [[nodiscard]] bool closed() const noexcept override {
        return !keeps_ && kept_.stop_at_end;
    }
    [[nodiscard]] const PerAxis<Position>& end() const noexcept override {
        return end_;
    }

    Pull next(FeedSegment& out, Supply supply, unsigned work) noexcept override;
    bool look_ahead(unsigned work) noexcept override;
    [[nodiscard]] bool passed(std::uint32_t moves) const noexcept override {
        return static_cast<std::int32_t>(moves - reached_) <= 0 || exhausted();
    }
    [[nodiscard]] bool exhausted() const noexcept override {
        return exhausted_;
    }
    [[nodiscard]] bool at_rest() const noexcept override {
        return at_rest_;
    }
    [[nodiscard]] bool stands() const noexcept override {
        return stops_ && exhausted_;
    }
    bool stand(FeedSegment& out) noexcept override {
        return trajectory_.stand(out);
    }
    [[nodiscard]] Pull state() const noexcept override {
        return trajectory_.state();
    }
    [[nodiscard]] bool has_failed() const noexcept override {
        return (filter_ != nullptr && filter_->has_ended()) || (planner_ != nullptr && !status().ok());
    }
    [[nodiscard]] Status status() const noexcept override {
        return trajectory_.status();
    }

    void hold() noexcept override {
        trajectory_.hold();
    }
    void resume() noexcept override {
        trajectory_.resume();
    }
    void abort() noexcept override {
        trajectory_.abort();
    }
    [[nodiscard]] Activity activity() const noexcept override {
        return trajectory_.activity();
    }
    void override_feed(Fixed ratio) noexcept override {
        trajectory_.override_feed(converted<S>(ratio));
    }
    void override_rapids(Fixed ratio) noexcept override {
        trajectory_.override_rapids(converted<S>(ratio));
    }
    void limit_feed(Fixed mm_s) noexcept override {
        trajectory_.limit_feed(converted<S>(mm_s));
    }

    /// Goes on along what the filter gives from now on, which begins where the motion stands. @pre at_rest(), and a
    /// segment was delivered since place()
    void turn() noexcept {
        const Status status = trajectory_.start(curve());
        SPLINEFEED_ASSERT(status.ok());
        static_cast<void>(status);
        exhausted_ = false;
    }

    /// What the plan reads.
    [[nodiscard]] CurveSource<S>& curve() noexcept;
    [[nodiscard]] Trajectory<S>& trajectory() noexcept {
        return trajectory_;
    }
    [[nodiscard]] const Trajectory<S>& trajectory() const noexcept {
        return trajectory_;
    }
    /// @pre it is made of moves
    [[nodiscard]] PathCounts counts() const noexcept {
        return path_->counts();
    }

private:
    Status begin_path() noexcept;
    [[nodiscard]] Result<bool> take(const PathElement<S>& move) noexcept;
    bool release(bool stops) noexcept;

    const MotionLimits<S>* limits_;
    Planner<S>* planner_;
    CurveFilter<S>* filter_;
    int axes_;
    PathRules<S> rules_{};
    Slot<TolerancePath<S>> path_;
    Trajectory<S> trajectory_;
    PathElement<S> kept_;       // the newest move
    PerAxis<Position> place_{}; // where the motion began
    PerAxis<Position> end_{};   // of the newest move
    std::uint32_t moves_ = 0;
    std::uint32_t reached_ = 0; // the move that the last segment belongs to
    bool keeps_ = false;
    bool stops_ = false; // at the end of the moves so far
    bool moved_ = false; // a segment was delivered since place()
    bool at_rest_ = true;
    bool exhausted_ = true;
};

extern template class ScalarStream<double>;
extern template class ScalarStream<float>;
extern template class ScalarStream<Fixed>;

} // namespace splinefeed
