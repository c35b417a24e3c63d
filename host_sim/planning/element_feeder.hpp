// SPDX-License-Identifier: MIT
// ElementFeeder: the moves of a program into a path within their tolerance.
#pragma once

#include "host_sim/planning/move_sources.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include <deque>
#include <exception>
#include <memory>
#include <optional>

namespace splinefeed::host {

/// Owns the path. more() takes one step of the program at a time, so nothing is read before the path needs it. If a
/// program does not say in advance where the machine has to stand, a move waits here until the next step that says so
/// is known, and with it up to most_behind steps that happen behind it and do not say it: a message before a dwell, for
/// example.
template <Scalar S>
class ElementFeeder {
public:
    static constexpr std::size_t most_behind = 64;

    /// `input` must outlive it. @pre input.within_tolerance()
    explicit ElementFeeder(PathInput& input);

    [[nodiscard]] CurveSource<S>& source() noexcept { return path_; }
    [[nodiscard]] const TolerancePath<S>& path() const noexcept { return path_; }
    [[nodiscard]] MoveSource<S>& program() noexcept { return *program_; }
    [[nodiscard]] const MoveSource<S>& program() const noexcept { return *program_; }

    /// What more() did.
    struct Pushed {
        bool start = false;           ///< it told where the first move begins
        PerAxis<Position> position{}; ///< there, or at the end of the last move
        const SourceStep<S>* move{};  ///< it pushed this move; null: none; valid until the next call
        const SourceStep<S>* step{};  ///< a dwell or an event behind the moves so far; null: none; valid as above
        std::optional<std::uint32_t>
            row{};                    ///< of the last move before the step that has a length; none: there was none
        std::uint32_t short_rows = 0; ///< rows behind that one: moves without a length, of which a chain may take some
    };
    /// Takes the start or the next step, or finishes the path; false if there is none. Throws InputError; the path then
    /// ends with the moves before. @pre the path is starved
    bool more(Pushed& pushed);
    /// The machine needs what there is, and the input pauses: a move that waits is pushed, with a stop at its end.
    /// false: none waits. @pre the path is starved
    bool release(Pushed& pushed);
    /// MoveSource::awaits_answer(), once everything before is delivered.
    [[nodiscard]] bool awaits_answer() const noexcept {
        return !finished_ && failure_ == nullptr && due_ == 0 && program_->awaits_answer();
    }
    [[nodiscard]] bool wait_for_row(typename MoveSource<S>::Patience patience) {
        return finished_ || failure_ != nullptr || due_ > 0 || program_->wait(patience);
    }

private:
    bool take(Pushed& pushed);
    void take_due(Pushed& pushed);
    void push_held(Pushed& pushed);
    void push(SourceStep<S>& step, Pushed& pushed);
    void limit_tolerance(SourceStep<S>& step) const;
    [[nodiscard]] bool has_length(const SourceStep<S>& step) const;
    void finish();

    const PathInput* input_;
    std::unique_ptr<MoveSource<S>> program_;
    TolerancePath<S> path_;
    SourceStep<S> step_; // read last
    SourceStep<S> held_; // a move that waits for what comes behind it
    struct Behind {
        SourceStep<S> step;
        std::optional<std::uint32_t> row;
    };
    std::deque<Behind> behind_;        // dwells and events behind the move that waits, or one that was pushed
    std::size_t due_ = 0;              // so many of them are behind moves that were pushed
    SourceStep<S> pushed_;             // the move that was pushed last
    PerAxis<Position> here_{};         // where the last move so far ends, held or not
    std::optional<std::uint32_t> row_; // of the last move with a length
    std::uint32_t short_rows_ = 0;     // behind it
    std::exception_ptr failure_;       // thrown behind the moves before it
    std::uint32_t moves_ = 0;          // pushed
    bool holds_ = false;
    bool started_ = false;
    bool finished_ = false;
};

} // namespace splinefeed::host
