// SPDX-License-Identifier: MIT
// WildRound: a machine, a program and an operator as unlike each other as a machine file and a waypoint file allow, as
// the files that `splinefeed run` takes. What fails can be run by hand.
#pragma once

#include "host_sim/run/runner.hpp"
#include "support/bezier_paths.hpp"

#include <cstdint>
#include <string>

namespace splinefeed_test {

struct WildRound {
    std::string machine; ///< text of the machine file, without a jerk limit
    std::string jerk;    ///< the same with jerk limits
    std::string program; ///< text of the waypoint file
    bool orders = false; ///< somebody steers
    std::uint64_t seed = 0;
    splinefeed::host::RunArguments arguments; ///< curve and window; the files are those of write_wild()

    /// What the operator does in a run that takes so long; the same for the same time.
    [[nodiscard]] std::string events(double seconds) const;
};

/// The same round for the same seed.
[[nodiscard]] WildRound wild_round(std::uint64_t seed);

/// Writes the files wild.csv, wild.toml and wild.events.csv into a folder, and returns the arguments of running them.
/// @param seconds  length of the run that is steered; 0: nobody steers
[[nodiscard]] splinefeed::host::RunArguments write_wild(const WildRound& round, bool jerk_limited, double seconds,
                                                        const std::string& folder);

/// The same for texts. @param arguments  curve and window; `events`  empty: nobody steers
[[nodiscard]] splinefeed::host::RunArguments write_texts(const splinefeed::host::RunArguments& arguments,
                                                         const std::string& machine, const std::string& program,
                                                         const std::string& events, const std::string& folder);

/// The files of a arguments and how to run them, for the report of a failure.
[[nodiscard]] std::string printed(const splinefeed::host::RunArguments& arguments, std::string_view scalar);

} // namespace splinefeed_test
