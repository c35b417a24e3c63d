// SPDX-License-Identifier: MIT
// DriveFaults: the faults of a simulated drive and of the line to its host, and their times.
#pragma once

#include "host_sim/drive/drive_model.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// The faults of `--faults`. Probabilities are per exchange, 0 to 1.
struct DriveFaults {
    struct Spell {
        double duration_ms = 0.0;
        double probability = 0.0;
    };
    enum class EventKind {
        disconnect,
        freeze,
        power_cycle,
        swap_words,
        flood,
        refuse_stop,
        stuck_state,
        stuck_place,
        no_room,
        told_state,
        second_master,
    };
    struct Event {
        EventKind kind = EventKind::freeze;
        double time_s = 0.0; ///< since the start of the drive
        double amount = 0.0; ///< of told_state: the state; of what lasts: its duration [ms]
    };
    struct Silence {
        double request = 0.0; ///< counted from 1
        double duration_ms = 0.0;
    };

    double drop = 0.0;
    double corrupt = 0.0;
    double exception = 0.0;
    double duplicate = 0.0;
    double stale = 0.0;            ///< an earlier reply is sent instead
    double short_reply = 0.0;      ///< the reply breaks off
    double foreign = 0.0;          ///< a frame of another exchange is on the line before the reply
    double echo = 0.0;             ///< the request comes back before the reply: an adapter that hears itself
    std::vector<Spell> delays;     ///< of the reply, by so long
    std::vector<Spell> late;       ///< of the reply, by up to so long
    std::vector<Spell> drips;      ///< the reply comes byte by byte, each so long after the one before
    std::vector<Spell> mutes;      ///< no request is heard for so long
    std::vector<Silence> silences; ///< that request is not heard, and none for so long
    std::vector<Event> events;     ///< in order of time
    double dither_counts = 0.0;
    double clock_skew_ppm = 0.0; ///< the drive's time runs faster by this
    std::optional<std::uint64_t> seed;

    /// Whether anything depends on chance.
    [[nodiscard]] bool random() const noexcept;
    [[nodiscard]] bool lasts(EventKind kind, double time_s) const noexcept;
    /// What the drive itself does wrong at that instant.
    [[nodiscard]] ModelFaults of_model(double time_s) const noexcept;
};

/// Reads `drop=0.01,delay=50:0.1,freeze@2.5:300,...`. Throws UsageError.
[[nodiscard]] DriveFaults parse_drive_faults(std::string_view text);

/// All faults, as they are written: "drop=P, corrupt=P, ..., freeze@S:MS, ...".
[[nodiscard]] std::string list_drive_faults();

struct ExchangeFaults {
    bool drop_request = false; ///< the request is lost before it has an effect
    bool drop_reply = false;
    bool corrupt = false;
    bool exception = false;
    bool repeat_request = false; ///< the request has its effect twice
    bool repeat_reply = false;
    bool stale = false;
    bool short_reply = false;
    bool foreign = false;
    bool echo = false;
    double delay_ms = 0.0;
    double drip_ms = 0.0;
    double mute_ms = 0.0;
    std::uint64_t bits = 0; ///< random bits for other choices
};

/// The same seed gives the same faults, exchange by exchange.
class FaultDice {
public:
    FaultDice(DriveFaults faults, std::uint64_t seed) : faults_(std::move(faults)), random_(seed) {}
    [[nodiscard]] ExchangeFaults next();

private:
    [[nodiscard]] double uniform() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
    [[nodiscard]] double sum_ms(const std::vector<DriveFaults::Spell>& spells, bool up_to);

    DriveFaults faults_;
    std::mt19937_64 random_;
    double requests_ = 0.0;
};

} // namespace splinefeed::host
