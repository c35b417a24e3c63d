// SPDX-License-Identifier: MIT
// WaypointFeeder: the waypoints of an input into a curve that is made while they come.
#pragma once

#include "host_sim/planning/path_feeder.hpp"

#include <vector>

namespace splinefeed {
struct CounterSeam; // of tests
} // namespace splinefeed

namespace splinefeed::host {

/// A closed curve has to be read completely first. It is pushed as the 16 points before the seam, the path with its
/// first point at both ends, and the 16 points after the seam.
class WaypointFeeder final : public PathFeeder {
public:
    /// `input` must outlive it. @pre the input has waypoints, and its curve streams
    WaypointFeeder(PathInput& input, WaypointSink sink);

    bool more(Pushed& pushed) override;
    [[nodiscard]] bool wait_for_row(Patience patience) override {
        return finished_ || input_->choice().closed || input_rows_->wait(patience);
    }

    [[nodiscard]] std::uint64_t rows() const noexcept override { return rows_read_; }
    [[nodiscard]] std::uint32_t row_of(std::uint32_t index) const noexcept override;
    [[nodiscard]] std::uint64_t line_of_row(std::uint32_t row) const noexcept override;

private:
    friend struct splinefeed::CounterSeam;

    static constexpr std::size_t lead = 16;               ///< waypoints on each side of the seam that shape a closed
                                                          ///< curve
    static constexpr std::size_t remembered = 1024;       ///< number of lines that are remembered
    static constexpr std::size_t most_closed = 4'000'000; ///< waypoints of a closed curve, 400 MB

    void read_all();
    bool next_row(WaypointRow& row, Role& role);
    void finish();

    PathInput* input_;
    WaypointSink sink_;
    std::unique_ptr<WaypointRows> input_rows_;
    std::vector<WaypointRow> all_;     // closed curves: the whole input
    std::vector<std::uint64_t> lines_; // line of row i at index i % remembered
    std::uint64_t rows_read_ = 0;
    std::uint64_t pushed_ = 0;
    bool finished_ = false;
};

} // namespace splinefeed::host
