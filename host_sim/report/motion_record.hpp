// SPDX-License-Identifier: MIT
// MotionRecord: what a run did, in bounded memory: for the page that shows it.
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/analysis/linear_length.hpp"
#include "host_sim/output/program_summary.hpp"
#include "host_sim/program/event_file.hpp"
#include "host_sim/report/line_times.hpp"
#include "host_sim/report/target_record.hpp"
#include "host_sim/report/thinned_path.hpp"
#include "host_sim/report/time_strips.hpp"

#include "splinefeed/s0_program/words/program_event.hpp"
#include "splinefeed/s1_blended_path/path_element.hpp"

#include <array>
#include <deque>
#include <map>
#include <optional>

namespace splinefeed::host {

/// What the machine does in a piece of the path, in order of MotionRecord::totals().
enum class PieceKind : std::uint8_t { feed, rapid, approach, standing };

/// Gets the moves of a program as they are read, and the segments of a run as they are executed. Memory: that of its
/// parts, whatever the length of the run, and the moves between the program and the motion. Cost of a segment: about
/// 0.2 us for three axes.
class MotionRecord {
public:
    static constexpr std::size_t most_points = std::size_t{1} << 18U;
    static constexpr std::size_t most_programmed = std::size_t{1} << 17U;
    static constexpr std::size_t most_stops = 50000;
    static constexpr std::size_t most_waypoints = 20000;
    static constexpr std::size_t most_rows = 65536; ///< even
    static constexpr std::size_t most_events = 20000;

    enum class Why : std::uint8_t { turn, asked, exact_stop, program, held, end };
    struct Stop {
        double time_s = 0.0;
        double stood_s = 0.0;
        std::uint64_t row = 0;
        std::uint64_t line = 0; ///< 0: unknown
        double turn_deg = 0.0;  ///< between the directions before it and behind it
        Why why = Why::end;
        PerAxis<double> position{};
    };
    struct Operated {
        double time_s = 0.0;
        OperatorEvent event;
    };
    struct Total {
        double seconds = 0.0;
        double length_mm = 0.0;
        double max_speed_mm_s = 0.0;
    };

    /// Strips of the speed and, for each axis, of velocity, acceleration and jerk: in shares of their limits, the jerk
    /// of an axis without a limit in mm/s^3.
    explicit MotionRecord(const MachineDescription& machine, std::uint32_t segment_ticks);

    /// Where a program begins, and its moves in their order.
    void start(const PerAxis<Position>& position);
    void move(const PathElement<double>& move, bool rapid, std::uint64_t line);
    /// The machine stands at the end of the last one.
    void stop();
    /// A point that the path passes. More than most_waypoints would cover the path: none are kept.
    void waypoint(const PerAxis<Position>& position);
    /// How far the path is from the program somewhere on the way to a row.
    void deviates(std::uint64_t row, double mm);

    /// The segments from now on lead to this row. @param line  of the row; 0: unknown   @param move  the row is the end
    /// of that move, from 0. Moves before it that no row has named are passed on the way there: the lines of all of
    /// them share the way by their length.
    void come_to(std::uint64_t row, std::uint64_t line, std::optional<std::uint64_t> move);
    /// Why the machine stands in the segments from now on, until it moves.
    void waits(Why why) noexcept { waits_ = why; }
    void dwells(std::uint64_t line) {
        settle_chain();
        waits_ = Why::program;
        now_.line = line;
    }
    /// Whether it moves to where the path begins.
    void approach(bool approaches) noexcept { approaches_ = approaches; }
    /// An event of the program: in order of time.
    void happened(const ProgramSummary::Event& event, EventKind kind);
    void operated(double time_s, const OperatorEvent& event) { operated_.push_back({time_s, event}); }
    /// @param share  has just got the same segment
    void segment(const FeedSegment& segment, const LimitShare& share);
    /// Once, at the end of all motion.
    void finish();

    [[nodiscard]] const MachineDescription& machine() const noexcept { return *machine_; }
    [[nodiscard]] const TimeStrips& strips() const noexcept { return strips_; }
    [[nodiscard]] const ThinnedPath& path() const noexcept { return path_; }
    [[nodiscard]] const ThinnedPath& programmed() const noexcept { return programmed_; }
    /// None: they were too many.
    [[nodiscard]] const std::vector<PerAxis<double>>& waypoints() const noexcept { return waypoints_; }
    /// The largest distances from the program, of so many rows together.
    [[nodiscard]] const std::vector<float>& deviations() const noexcept { return deviations_; }
    [[nodiscard]] std::uint64_t rows_together() const noexcept { return rows_together_; }
    [[nodiscard]] const LineTimes& lines() const noexcept { return lines_; }
    [[nodiscard]] const std::vector<Stop>& stops() const noexcept { return stops_; }
    [[nodiscard]] std::uint64_t stop_count() const noexcept { return stop_count_; }
    [[nodiscard]] const std::vector<Operated>& operated() const noexcept { return operated_; }
    [[nodiscard]] const std::array<Total, 4>& totals() const noexcept { return totals_; }
    /// Along the linear axes; so are those of the totals and the strips.
    [[nodiscard]] double length_mm() const noexcept { return length_mm_; }
    /// Time by the number of the tool; 0: before the first one.
    [[nodiscard]] const std::map<std::int32_t, double>& tools() const noexcept { return tools_; }
    /// The first most_events of the program.
    [[nodiscard]] const std::vector<ProgramSummary::Event>& events() const noexcept { return events_; }
    [[nodiscard]] const LayerTimes& layers() const noexcept { return layers_; }
    /// For the thread of a target, and after the run.
    [[nodiscard]] TargetRecord& target() noexcept { return target_; }

private:
    struct Row {
        std::uint64_t line = 0;
        double length_mm = 0.0; ///< over all axes
        bool rapid = false;
        bool exact_stop = false;
        bool stop_at_end = false;
    };
    struct Passed {
        double seconds = 0.0;
        double way_mm = 0.0;
        std::uint8_t code = 0;
    };
    struct AxisFactors {
        double mm_per_unit = 0.0;
        double per_velocity = 0.0;
        double per_speeding = 0.0;
        double per_braking = 0.0;
        double per_jerk = 0.0;
        bool linear = true;
    };

    void pop_row();
    void measure(const FeedSegment& segment, double seconds);
    void settle_chain();
    void stand(double begin_s, double seconds);
    void travel(const FeedSegment& segment, double begin_s, double seconds, double way_mm, const LimitShare& share);
    void turn(const PerAxis<double>& direction);
    [[nodiscard]] PerAxis<double> place(const FeedSegment& segment, double u) const;

    const MachineDescription* machine_;
    int axes_;
    int height_; // the axis that layers rise along; -1: none
    PerAxis<AxisFactors> factors_{};
    std::vector<TimeStrips::Range> values_; // of the segment: one for each strip
    float acceleration_ = 0.0F;             // the largest share of a limit in the segment; the same below
    float jerk_ = 0.0F;
    double speed_way_ = 0.0; // the integral of the speed over the segment
    TimeStrips strips_;
    ThinnedPath path_;
    ThinnedPath programmed_;
    LineTimes lines_;
    std::vector<PerAxis<double>> waypoints_;
    bool too_many_ = false; // waypoints
    std::vector<float> deviations_;
    std::uint64_t rows_together_ = 1;
    std::vector<Stop> stops_;
    std::uint64_t stop_count_ = 0;
    std::vector<Operated> operated_;
    std::array<Total, 4> totals_{};
    std::map<std::int32_t, double> tools_;
    std::int32_t tool_ = 0;
    std::vector<ProgramSummary::Event> events_;
    LayerTimes layers_;
    TargetRecord target_;
    PerAxis<Position> here_{}; // where the last move of the program ends
    double programmed_mm_ = 0.0;
    std::deque<Row> rows_; // moves from first_row_ on
    std::uint64_t first_row_ = 0;
    std::uint64_t row_ = 0;
    bool at_row_ = false; // the first of rows_ has been come to
    Row now_{};
    std::vector<Row> chain_;     // now_ and the moves before it that are travelled with it; none: it is alone
    std::vector<Passed> passed_; // of the chain, so far
    double chain_begin_s_ = 0.0;
    Why waits_ = Why::end;
    bool approaches_ = false;
    std::uint64_t ticks_ = 0;
    LinearLength linear_;
    double length_mm_ = 0.0;
    double way_mm_ = 0.0;       // travelled over all axes
    ThinnedPath::Point last_{}; // waits for what comes behind it
    bool has_last_ = false;
    bool stood_ = false;
    bool open_stop_ = false; // the last stop's turn is not known yet
    PerAxis<double> direction_{};
};

} // namespace splinefeed::host
