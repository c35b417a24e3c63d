// SPDX-License-Identifier: MIT
// Server: a controller with its machine, its senders and its console, in real time.
#pragma once

#include "host_sim/base/signal_watch.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/run/user_pause.hpp"
#include "host_sim/serve/sender_door.hpp"
#include "host_sim/serve/served_motion.hpp"

#include "splinefeed/controller/controller.hpp"

namespace splinefeed::host {

/// Its thread obeys: it waits for no disk, no reader and no sender.
class Server {
public:
    /// All must outlive it. @param state  writes behind; null: nothing is kept   @param begins  offsets, and where the
    /// machine stands
    /// @param says  tells the operator's terminal what happens
    Server(const ControllerSettings& settings, ServedMotion& motion, LiveMachine& live, StateKeeper* state,
           const MachineState& begins, bool says);
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] SenderDoor& door() noexcept { return *door_; }
    /// A line that was typed at the server's terminal.
    void type(std::string_view line);
    /// Serves until `signals` ask for the end, or the state cannot be written, and the machine stands. A second request
    /// stops it at once. What is then kept of the state is still to be written.
    void run(SignalWatch& signals);

private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] std::uint32_t now_ms() const;
    [[nodiscard]] bool is_at_rest() const;
    void obey(SignalWatch& signals);
    void suspend();
    void step();
    void answer();
    void keep();

    LineMotion* motion_;
    LiveMachine* live_;
    StateKeeper* state_;
    std::vector<char> lines_;
    std::vector<char> answers_;
    std::vector<char> text_; // of them, on its way
    Controller controller_;
    std::unique_ptr<SenderDoor> door_;
    Clock::time_point start_ = Clock::now();
    int requests_ = 0; // to end, that were obeyed
    bool says_;
    bool leaves_ = false;
    UserSuspend suspend_;
    WorkOffsets offsets_; // that the state has
};

} // namespace splinefeed::host
