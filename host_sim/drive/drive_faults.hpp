// SPDX-License-Identifier: MIT
// DriveFaults: the faults between a simulated drive and its host, and their times.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// The faults of `--faults`. Probabilities are per exchange, 0 to 1.
struct DriveFaults {
    struct Delay {
        double duration_ms = 0.0;
        double probability = 0.0;
    };
    enum class EventKind { disconnect, freeze, power_cycle, swap_words };
    struct Event {
        EventKind kind = EventKind::freeze;
        double time_s = 0.0;      ///< since the start of the drive
        double duration_ms = 0.0; ///< used by disconnect and freeze
    };

    double drop = 0.0;
    double corrupt = 0.0;
    double exception = 0.0;
    double duplicate = 0.0;
    double stale = 0.0; ///< an earlier reply is sent instead
    std::vector<Delay> delays;
    std::vector<Event> events;   ///< in order of time
    double clock_skew_ppm = 0.0; ///< the drive's time runs faster by this
    std::optional<std::uint64_t> seed;

    /// Whether anything depends on chance.
    [[nodiscard]] bool random() const noexcept;
};

/// Reads `drop=0.01,delay=50:0.1,freeze@2.5:300,...`. Throws UsageError.
[[nodiscard]] DriveFaults parse_drive_faults(std::string_view text);

/// The faults of one exchange.
struct ExchangeFaults {
    bool drop_request = false; ///< the request is lost before it has an effect
    bool drop_reply = false;
    bool corrupt = false;
    bool exception = false;
    bool repeat_request = false; ///< the request has its effect twice
    bool repeat_reply = false;
    bool stale = false;
    double delay_ms = 0.0;
    std::uint64_t bits = 0; ///< random bits for other choices
};

/// The same seed gives the same faults, exchange by exchange.
class FaultDice {
public:
    FaultDice(DriveFaults faults, std::uint64_t seed) : faults_(std::move(faults)), random_(seed) {}
    [[nodiscard]] ExchangeFaults next();

private:
    [[nodiscard]] double uniform() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }

    DriveFaults faults_;
    std::mt19937_64 random_;
};

} // namespace splinefeed::host
