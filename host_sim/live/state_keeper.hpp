// SPDX-License-Identifier: MIT
// StateKeeper: keeps the state file of a machine true while it moves.
#pragma once

#include "host_sim/config/state_file.hpp"
#include "host_sim/ports/run_target.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

namespace splinefeed::host {

/// From the first motion on, the file says that no place is known; a run that is killed leaves that behind. Only the
/// end of the run, which knows where the axes stand, writes places again. For any thread.
class StateKeeper {
public:
    enum class Writes : std::uint8_t {
        at_once, ///< each function may wait for the disk, and throws OutputError
        behind,  ///< a thread writes what was said last, and nobody waits: is_kept() says when that is done
    };

    /// @param file  must outlive it   @param begins  offsets and places as the run begins
    StateKeeper(const StateFile& file, MachineState begins, Writes writes = Writes::at_once);
    StateKeeper(const StateKeeper&) = delete;
    StateKeeper& operator=(const StateKeeper&) = delete;
    /// Waits until all that was said is written, or cannot be.
    ~StateKeeper();

    /// Something is about to move. If this throws, or before this is kept, it must not: nobody could be told where it
    /// then stands.
    void moves();
    /// The program has come to other offsets.
    void offsets(const WorkOffsets& offsets);
    /// The axes stand at these places. [mm]
    void stands(const PerAxis<double>& mm);
    /// The run has ended, and the target says where its axes stand. Without places nothing has moved: the file becomes
    /// what it was. @pre not that where it writes behind
    void ends(std::span<const RunTarget::AxisPlace> places);

    /// Whether the file has all that was said. Throws OutputError where it could not be written; then nothing more is.
    [[nodiscard]] bool is_kept();
    [[nodiscard]] bool has_failed();
    /// Waits until it is kept. Throws OutputError.
    void finish();

private:
    void write();
    void work();

    const StateFile* file_;
    Writes writes_;
    std::mutex mutex_; // protects the members below
    std::condition_variable changed_;
    MachineState kept_;
    std::uint64_t said_ = 0;    // changes of it,
    std::uint64_t written_ = 0; // and those that the file has
    std::exception_ptr failure_;
    bool over_ = false;
    bool moves_ = false;
    std::optional<std::string> before_; // text of the file before it was written; nothing: there was none
    std::thread thread_;
};

} // namespace splinefeed::host
