// SPDX-License-Identifier: MIT
// ModuleBus: I/O modules on one Modbus line, in a thread of its own: coils that are switched, and bits that are read.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::hal::modbus {

/// A bit of a module.
struct ModuleBit {
    int unit = 1;
    BitTable table = BitTable::coils;
    int address = 0;  ///< as on the line, from 0
    std::string name; ///< for messages: "output 3 (coil 2 of modbus-tcp://192.168.0.20)"
};

struct ModuleBusSettings {
    std::uint32_t answer_ms = 100; ///< a module answers within this time
    std::uint32_t lost_ms = 1000;  ///< a module that has not answered for so long is lost
    std::uint32_t look_ms = 100;   ///< how often a coil, or an input, of each module is looked at in any case
    int retries = 3;               ///< of each exchange in open()
};

/// A coil is written as soon as it is set, and again until its module confirms. Each module has one of its coils read
/// in turn. One that is not as it was set (a module that was off and on again, a watchdog, somebody else) is trouble,
/// like a module that is lost or refuses. Once there is trouble, or end() was called, all coils become as they are
/// safe, as soon as their modules answer, and nothing is set any more.
///
/// All functions but add_... and open() may be called by any thread at any time, and return at once.
class ModuleBus {
public:
    ModuleBus(const LinkAddress& wire, const ModuleBusSettings& settings, const MakeWire& make = make_link,
              Clock& clock = system_clock());
    ModuleBus(const ModuleBus&) = delete;
    ModuleBus& operator=(const ModuleBus&) = delete;
    /// Makes the coils safe, for up to lost_ms.
    ~ModuleBus();

    /// Before open(). Return the index for set() and watch().
    [[nodiscard]] std::size_t add_coil(ModuleBit bit, bool safe);
    [[nodiscard]] std::size_t add_input(ModuleBit bit);

    /// Reads every bit once, writes every coil as it is safe, and starts the thread. Returns an empty text, or which
    /// bit cannot be used and why; a bit that cannot be read is found before anything is written.
    [[nodiscard]] std::string open();
    void set(std::size_t coil, bool on);
    void end();
    /// The name of a coil that is not known to be as it was set last; empty: all are.
    [[nodiscard]] std::string unconfirmed() const;

    /// From now on this input is read, all the time.
    void watch(std::size_t input);
    void unwatch();
    struct Reading {
        bool on = false;
        std::uint64_t asked_us = 0; ///< on the clock: before the module was asked
    };
    /// A reading of the watched input, which the module was asked for after watch(), and which was not taken yet.
    [[nodiscard]] std::optional<Reading> take();

    /// Why something is not as it should be; empty: all is.
    [[nodiscard]] std::string trouble() const;

private:
    struct Coil {
        ModuleBit bit;
        bool safe = false;
        bool wanted = false;
        std::optional<bool> told{}; // what the module has confirmed; nothing: unknown
    };
    struct Module {
        int unit = 0;
        std::vector<std::size_t> coils;
        std::vector<std::size_t> inputs;
        std::uint64_t answered_us = 0;
        std::uint64_t look_us = 0; // next
        std::size_t turn = 0;
    };

    [[nodiscard]] Module& module_of(int unit);
    [[nodiscard]] bool connected();
    [[nodiscard]] LinkAnswer read(const ModuleBit& bit, bool& out);
    [[nodiscard]] LinkAnswer write(const ModuleBit& bit, bool on);
    template <class Exchange>
    [[nodiscard]] std::string try_out(const ModuleBit& bit, const Exchange& exchange);
    void work();
    [[nodiscard]] bool may_not_read(int unit) const;
    void write_coils();
    void read_watched();
    void look(Module& module);
    void look_at_coil(std::size_t index);
    void fail(const std::string& what);
    bool took(const ModuleBit& bit, const LinkAnswer& answer);

    ModuleBusSettings settings_;
    Clock* clock_;
    LinkAddress wire_;
    std::unique_ptr<ModbusWire> link_;
    std::vector<Module> modules_; // used by the thread
    std::vector<ModuleBit> inputs_;

    mutable std::mutex mutex_; // protects the members up to the next comment
    std::vector<Coil> coils_;
    bool ended_ = false;
    std::string trouble_;
    std::optional<std::size_t> watched_;
    std::uint64_t watches_ = 0; // calls of watch() and unwatch()
    std::optional<Reading> reading_;

    std::atomic<bool> leaves_{false};
    std::unique_ptr<ClockThread> thread_;
};

} // namespace splinefeed::hal::modbus
