// SPDX-License-Identifier: MIT
// ServedMachine: what a server drives by a controller: the simulated machine, or a real target.
#pragma once

#include "host_sim/ports/run_target.hpp"

#include "splinefeed/controller/controlled_machine.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace splinefeed::host {

/// For the thread of the server.
class ServedMachine : public ControlledMachine {
public:
    using Time = std::chrono::steady_clock::time_point;

    ServedMachine(const ServedMachine&) = delete;
    ServedMachine& operator=(const ServedMachine&) = delete;
    virtual ~ServedMachine() = default;

    /// Once a millisecond.
    virtual void advance(Time now) = 0;
    /// Whether it takes a segment now.
    [[nodiscard]] virtual bool has_room() const = 0;
    /// It has so little motion left that the plan must not wait for more lines.
    [[nodiscard]] virtual bool is_dry() const = 0;
    virtual void submit(const FeedSegment& segment) = 0;
    /// The motion rests behind the last segment, and nothing follows for now.
    virtual void rest() = 0;
    [[nodiscard]] virtual bool stands() const = 0;
    /// Where the axes stand, for the state file.
    [[nodiscard]] virtual std::vector<RunTarget::AxisPlace> places() const = 0;
    /// The server ends: drives and outputs become what they are to be. Returns what was not confirmed; empty: nothing.
    [[nodiscard]] virtual std::string finish() { return {}; }

    void offsets_changed() noexcept override { offsets_changed_ = true; }
    /// Whether the program's offsets have changed since the last call.
    [[nodiscard]] bool take_offsets_change() noexcept { return std::exchange(offsets_changed_, false); }

protected:
    ServedMachine() = default;

private:
    bool offsets_changed_ = false;
};

} // namespace splinefeed::host
