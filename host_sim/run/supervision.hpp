// SPDX-License-Identifier: MIT
// Supervision: the thread that supervises the target of a run. It depends on no planner, input or output.
#pragma once

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/run/program_orders.hpp"
#include "host_sim/run/state_keeper.hpp"
#include "host_sim/run/target_feed.hpp"

#include <atomic>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace splinefeed::host {

/// It prepares the target, passes the plan's segments to it, polls its port every millisecond, and obeys the user's
/// signals: the first request to end the run stops all axes on the path, the second one is a quick stop. If the target
/// needs the plan to be held, the planner learns it from hold_asked().
///
/// A run has one end, whatever its reason: everything was executed, a signal, the target, the outputs' own trouble, a
/// plan that was given up with stop(), an exception of the target. In this order all axes are held and stand, the
/// outputs of the program - spindle, coolant, digital outputs - have ended, the drives are left as the machine file
/// says, the state file has their places, and ending() says what is true. Each step is bounded. Outputs end earlier,
/// before the axes stand, when a drive is in fault and at the second request.
///
/// If the run ends early and the planner does not return within stall_s because an output is blocked, the thread ends
/// the process with the run's message and exit status 1. After the end of a run a signal does this at once.
class Supervision final : public ProgramOrders {
public:
    static constexpr std::uint64_t hand_over_us = TargetFeed::hand_over_us;
    static constexpr int stall_s = 2;

    /// No thread runs before the first segment. All arguments must outlive it.
    /// @param outputs, state, record  null: there are none
    Supervision(RunTarget& target, SignalWatch& signals, ProgramOutputs* outputs = nullptr,
                StateKeeper* state = nullptr, TargetRecord* record = nullptr)
        : target_(&target), port_(&target.port()), signals_(&signals), outputs_(outputs), state_(state),
          feed_(target, outputs, record) {}
    Supervision(const Supervision&) = delete;
    Supervision& operator=(const Supervision&) = delete;
    /// If the run is not over: stop(), and waits for the end.
    ~Supervision();

    // For the planner's thread:

    /// Passes a segment on, as soon as there is room for it. The first one defines where the axes stand. false: the run
    /// is over. Throws OutputError if the state file cannot be written; nothing has moved then.
    /// @param line  of the program, that the segment comes from; 0: unknown
    /// @param moves  of the program up to this one, or waypoints; for Reached
    [[nodiscard]] bool submit(const FeedSegment& segment, std::uint64_t line = 0, std::uint64_t moves = 0);
    /// No more segments come. If the last one ends at rest, the run ends when everything is executed; otherwise nobody
    /// can say how the motion goes on, and this is a stop().
    void complete();
    /// The plan is given up: all axes stop as after the first signal, and the run ends.
    /// @param why  for the message
    void stop(const std::string& why = {});
    /// complete(), and waits until the run is over. false: it ended before everything was executed; ending() says why.
    [[nodiscard]] bool finish();
    /// Whether submit() would return without waiting.
    [[nodiscard]] bool room() const noexcept { return feed_.room(); }
    [[nodiscard]] bool over() const noexcept { return over_.load(); }
    /// Whether it has begun and is not over.
    [[nodiscard]] bool runs() const noexcept { return thread_.joinable() && !over(); }
    void order(const ProgramAction& action, bool standing) override { feed_.order(action, standing); }
    [[nodiscard]] bool carried_out() const override { return feed_.carried_out(); }
    [[nodiscard]] int input() const override { return outputs_ != nullptr ? outputs_->answer() : 0; }
    [[nodiscard]] bool spindle_stands() const override { return outputs_ == nullptr || outputs_->spindle_stands(); }
    /// Whether the plan has to be held, and ends there.
    [[nodiscard]] bool hold_asked() const noexcept { return feed_.hold_asked(); }
    [[nodiscard]] UserSteering take_steering() noexcept { return signals_->take_steering(); }
    /// Segments that were submitted, for the thread that submits, and those that were executed.
    [[nodiscard]] std::uint64_t submitted() const noexcept { return feed_.pushed(); }
    [[nodiscard]] std::uint64_t executed() const noexcept { return feed_.executed(); }
    /// Why the run ended early, and where the machine stands. @pre finish() returned
    [[nodiscard]] const std::string& ending() const noexcept { return ending_; }
    /// "; the machine stands at ..." @pre as above
    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    /// The line of the program on which the machine stands; 0: unknown. @pre as above
    [[nodiscard]] std::uint64_t line() const { return reached().line; }
    /// What the machine has come to, while it moves.
    struct Reached {
        std::uint64_t line = 0;
        std::uint64_t moves = 0;
        std::vector<RunTarget::AxisPlace> places{}; // of the last tenth of a second
    };
    [[nodiscard]] Reached reached() const;
    /// Where the axes stand; empty: nothing has moved. @pre as above
    [[nodiscard]] const std::vector<RunTarget::AxisPlace>& places() const noexcept { return places_; }
    void describe(Summary& summary) const { target_->describe(summary); }

private:
    void work() noexcept;
    void end(const std::string& reason) noexcept;
    [[nodiscard]] std::string begin();
    [[nodiscard]] std::string supervise();
    [[nodiscard]] int requests();
    void begin_line(std::uint64_t line, std::uint64_t moves);
    void come_to(std::uint64_t executed);
    [[nodiscard]] std::string outputs_end() const;
    [[nodiscard]] std::string with_trouble(const std::string& ending) const;
    void await_planner() noexcept;

    RunTarget* target_;
    hal::MotionPort* port_; // of the target
    SignalWatch* signals_;
    ProgramOutputs* outputs_;
    StateKeeper* state_;
    TargetFeed feed_;
    bool at_rest_ = true; // at the end of the last segment; used by the planner only
    struct LineBegin {
        std::uint64_t line = 0;
        std::uint64_t moves = 0;
        std::uint64_t segment = 0; // its first one
    };
    mutable std::mutex lines_mutex_;
    std::deque<LineBegin> lines_;              // protected by it; from the line where the machine is
    std::vector<RunTarget::AxisPlace> passed_; // protected by it
    unsigned looks_ = 0;
    std::atomic<bool> complete_{false}; // no more segments come, and the last one ends at rest
    std::atomic<bool> stop_{false};     // the plan is given up
    std::string stop_why_;              // written before stop_
    std::atomic<bool> leaves_{false};   // the planner's thread needs no other thread any more
    std::atomic<bool> over_{false};
    // Used by the thread, and after over_ by any thread:
    bool began_ = false;
    std::string ending_; // empty: everything was executed
    std::string where_;
    std::vector<RunTarget::AxisPlace> places_;
    std::thread thread_;
};

} // namespace splinefeed::host
