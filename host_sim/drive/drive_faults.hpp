// SPDX-License-Identifier: MIT
// DriveFaults: what goes wrong between a simulated drive and its host, and when.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// What `--faults` asks for. Probabilities are per exchange, 0 to 1.
struct DriveFaults {
    struct Delay {
        double duration_ms = 0.0;
        double probability = 0.0;
    };
    enum class EventKind { disconnect, freeze, power_cycle, swap_words };
    struct Event {
        EventKind kind = EventKind::freeze;
        double time_s = 0.0;      ///< since the drive was started
        double duration_ms = 0.0; ///< of disconnect and freeze
    };

    double drop = 0.0;
    double corrupt = 0.0;
    double exception = 0.0;
    double duplicate = 0.0;
    double stale = 0.0; ///< an earlier reply comes instead
    std::vector<Delay> delays;
    std::vector<Event> events;   ///< in order of time
    double clock_skew_ppm = 0.0; ///< the drive's time passes faster by this
    std::optional<std::uint64_t> seed;

    /// Whether anything depends on chance.
    [[nodiscard]] bool random() const noexcept;
};

/// Reads `drop=0.01,delay=50:0.1,freeze@2.5:300,...`. Throws UsageError.
[[nodiscard]] DriveFaults parse_drive_faults(std::string_view text);

/// What happens to one exchange.
struct ExchangeFaults {
    bool drop_request = false; ///< before it takes effect
    bool drop_reply = false;
    bool corrupt = false;
    bool exception = false;
    bool repeat_request = false; ///< it takes effect twice
    bool repeat_reply = false;
    bool stale = false;
    double delay_ms = 0.0;
    std::uint64_t bits = 0; ///< for whatever else is left to chance
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
