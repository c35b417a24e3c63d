// SPDX-License-Identifier: MIT
// ModelFaults: what a simulated drive says or does that it should not, at present.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

namespace splinefeed::host {

struct ModelFaults {
    bool refuses_stops = false;           ///< quick stop, halt and hold; of a spindle: stop
    bool stuck_state = false;             ///< its state is told as it was
    bool stuck_place = false;             ///< its position and progress are told as they were
    bool no_room = false;                 ///< its ring is told to be full
    std::optional<std::uint16_t> state{}; ///< told instead of its state
    int dither_counts = 0;                ///< its position is told up to so far off, another way each time

    [[nodiscard]] bool operator==(const ModelFaults&) const = default;
};

/// The noise of an encoder: whole counts, up to `most` to each side. The same in each run.
class CountNoise {
public:
    [[nodiscard]] int next(int most) {
        return most == 0 ? 0 : static_cast<int>(random_() % (2U * static_cast<unsigned>(most) + 1U)) - most;
    }

private:
    std::minstd_rand random_{1};
};

} // namespace splinefeed::host
