// SPDX-License-Identifier: MIT
// RunInputs: digital inputs of a run on a real target.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::host {

/// A level of an input.
struct InputReading {
    bool active = false;
    std::uint64_t asked_us = 0; ///< on the host's clock: the level is not older
};

/// For one thread, but trouble(). All functions return at once.
class RunInputs {
public:
    RunInputs() = default;
    RunInputs(const RunInputs&) = delete;
    RunInputs& operator=(const RunInputs&) = delete;
    virtual ~RunInputs() = default;

    /// From now on this input is read; false: it is one of another kind.
    [[nodiscard]] virtual bool watch(std::int32_t number) = 0;
    /// Nothing is read any more.
    virtual void unwatch() = 0;
    /// A reading since watch() that was not taken yet.
    [[nodiscard]] virtual std::optional<InputReading> take() = 0;
    /// Why they cannot be read; empty: they can. May be called by any thread.
    [[nodiscard]] virtual std::string trouble() const = 0;
};

} // namespace splinefeed::host
