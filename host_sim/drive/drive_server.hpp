// SPDX-License-Identifier: MIT
// DriveServer: runs a drive model on a line, in real time, with faults.
#pragma once

#include "host_sim/drive/drive_faults.hpp"
#include "host_sim/drive/drive_record.hpp"
#include "host_sim/drive/drive_wire.hpp"

#include <csignal>
#include <deque>

namespace splinefeed::host {

/// The model's time is CLOCK_MONOTONIC since the server was made, faster or slower by the clock skew of the faults. The
/// model is advanced to each whole millisecond, for the row of the record, and to the present time at each request.
class DriveServer {
public:
    /// Listens. Throws UsageError if that fails.
    DriveServer(DriveModel& model, const ListenAddress& address, DriveFaults faults, std::uint64_t seed);

    /// The address, with the port that was chosen.
    [[nodiscard]] const ListenAddress& address() const noexcept { return wire_.address(); }
    /// CLOCK_MONOTONIC at time 0 of the model. [s]
    [[nodiscard]] double start_s() const noexcept;
    /// Serves until `stop` is set. @param record  may be null; gets its rows; the caller commits it
    void run(const volatile std::sig_atomic_t& stop, DriveRecord* record);

private:
    using Clock = DriveWire::Clock;
    using Bytes = std::vector<std::uint8_t>;
    struct Due {
        Clock::time_point time;
        bool request = false; // a request that must still take effect; otherwise a reply that must be sent
        int channel = 0;
        Bytes bytes;
    };

    [[nodiscard]] std::uint64_t model_us(Clock::time_point time) const;
    [[nodiscard]] std::chrono::microseconds line_time(std::size_t bytes) const;
    void fire_events(Clock::time_point now);
    void advance(Clock::time_point now);
    void accept(DriveWire::Request request, Clock::time_point now);
    void serve(int channel, Bytes request, Clock::time_point now);
    [[nodiscard]] Bytes reply_to(const Bytes& request, const ExchangeFaults& faults);
    [[nodiscard]] bool damage_block(Bytes& request, std::uint64_t bits) const;
    [[nodiscard]] bool replace_by_stale(Bytes& reply) const;
    void send(int channel, Bytes reply, Clock::time_point due, double drip_ms);
    [[nodiscard]] Bytes foreign_frame(const Bytes& request);
    void flood(Clock::time_point now);
    [[nodiscard]] double passed_s(Clock::time_point time) const;
    void deliver(Clock::time_point now);
    [[nodiscard]] std::chrono::microseconds until_next(Clock::time_point now) const;

    DriveModel* model_;
    DriveRecord* record_ = nullptr;
    DriveWire wire_;
    DriveExchange exchange_;
    DriveFaults faults_;
    FaultDice dice_;
    Clock::time_point start_;
    Clock::time_point line_free_; // time at which the serial line is free
    std::optional<Clock::time_point> connects_;
    std::optional<Clock::time_point> thaws_;
    Clock::time_point hears_; // again
    Clock::time_point flooded_;
    ModelFaults model_faults_;
    std::size_t event_ = 0;
    std::uint64_t recorded_ms_ = 0; // rows written so far
    std::vector<Due> due_;
    std::deque<Bytes> sent_; // the latest replies, as they were before any damage
};

} // namespace splinefeed::host
