// SPDX-License-Identifier: MIT
// SimulatedLink: a Modbus line on a virtual clock, with simulated drives behind it and everything that goes wrong on
// the way.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/hal/modbus/link/open_answers.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <deque>
#include <map>
#include <random>
#include <vector>

namespace splinefeed_test {

/// From one instant to another. [us]
struct Span {
    std::uint64_t from_us = 0;
    std::uint64_t to_us = 0;

    [[nodiscard]] bool has(std::uint64_t now_us) const noexcept { return now_us >= from_us && now_us < to_us; }
};

/// What happens to an exchange, each with a probability of its own.
struct WireFaults {
    double lost_request = 0.0;
    double lost_answer = 0.0;
    double corrupt = 0.0;   ///< rtu: the frame's CRC; tcp: a bit of a written block that has a checksum of its own
    double exception = 0.0; ///< the wire's exception instead of an effect
    double repeated = 0.0;  ///< the request takes effect twice
    double stale = 0.0;     ///< an earlier answer comes instead
    double late = 0.0;      ///< the answer is late, by up to late_us
    std::uint64_t late_us = 100'000;
    double broken = 0.0;  ///< the answer breaks off, or its bytes come so slowly that it is not whole in time
    double foreign = 0.0; ///< a frame of another exchange comes before the answer
};

/// A drive on a line: its own clock, and when it does not answer.
class Station {
public:
    Station(splinefeed::host::DriveModel& model, double clock_ppm) : model_(&model), rate_(1.0 + clock_ppm * 1e-6) {}

    std::vector<Span> frozen; ///< requests wait until it thaws; their answers are too late
    std::vector<Span> mute;   ///< requests are lost

    [[nodiscard]] splinefeed::host::DriveModel& model() noexcept { return *model_; }
    /// Its time passes, and what waited for it to thaw takes effect.
    void advance(std::uint64_t now_us);
    /// The end of the span in which it is; 0: it answers.
    [[nodiscard]] std::uint64_t thaws_us(std::uint64_t now_us) const noexcept;
    [[nodiscard]] bool is_mute(std::uint64_t now_us) const noexcept;
    void postpone(std::uint64_t until_us, std::function<void()> effect);

private:
    struct Waiting {
        std::uint64_t until_us = 0;
        std::function<void()> effect;
    };

    splinefeed::host::DriveModel* model_;
    double rate_;
    std::uint64_t began_us_ = 0;
    std::deque<Waiting> waiting_;
};

/// What lines of one wire have in common: it outlives them.
struct SimulatedWire {
    std::map<int, Station*> stations; ///< by unit
    WireFaults faults;
    splinefeed::host::ModbusException exception = splinefeed::host::ModbusException::busy;
    Span faults_at{0, UINT64_MAX}; ///< when they may happen
    std::vector<Span> unplugged;   ///< nobody is connected
    std::vector<Span> flooded;     ///< bytes come without an end
    /// From the request of that number on, counted from 1, none is heard for so long: {number, us}
    std::vector<std::pair<std::uint64_t, std::uint64_t>> silences;
    std::uint64_t requests = 0;
    Span silent{0, 0};              ///< at present
    std::uint64_t latency_us = 200; ///< there and back, beyond the line's rate; up to twice that
    double pace = 1.0;              ///< how long frames take, by the rate of the line
    std::uint64_t hiccups = 0;      ///< faults that happened
    std::mt19937_64 random{1};
};

class SimulatedLink final : public splinefeed::hal::modbus::ModbusWire {
public:
    using LinkAddress = splinefeed::hal::modbus::LinkAddress;
    using LinkAnswer = splinefeed::hal::modbus::LinkAnswer;
    using LinkTiming = splinefeed::hal::modbus::LinkTiming;
    using RequestKind = splinefeed::hal::modbus::RequestKind;

    SimulatedLink(SimulatedWire& wire, const LinkAddress& address, const LinkTiming& timing,
                  splinefeed::hal::Clock& clock)
        : wire_(wire), address_(address), timing_(timing), clock_(clock) {}

    bool connect() noexcept override;
    void close() noexcept override { connected_ = false; }
    [[nodiscard]] bool connected() const noexcept override { return connected_; }
    [[nodiscard]] std::string error() const override { return "it is unplugged"; }
    LinkAnswer read(int unit, int address, std::span<std::uint16_t> out) noexcept override;
    LinkAnswer write(int unit, int address, std::span<const std::uint16_t> values) noexcept override;
    LinkAnswer exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                        std::span<std::uint16_t> out) noexcept override;
    LinkAnswer read_inputs(int unit, int address, std::span<std::uint16_t> out) noexcept override;
    LinkAnswer read_bit(int unit, splinefeed::hal::modbus::BitTable table, int address, bool& out) noexcept override;
    LinkAnswer write_coil(int unit, int address, bool on) noexcept override;
    void resynchronise() noexcept override {
        if (address_.wire == splinefeed::hal::modbus::Wire::rtu) { // what was on its way then is discarded
            dirty_ = behind_ = true;
        }
    }
    [[nodiscard]] std::uint64_t next_us() const noexcept override;
    [[nodiscard]] std::uint64_t read_from_us(int unit) const noexcept override {
        return open_.until_us(unit, RequestKind::reading, 0);
    }
    [[nodiscard]] bool owes_answer(int unit) const noexcept override { return open_.owes(unit, clock_.now_us()); }
    [[nodiscard]] const LinkAddress& address() const noexcept override { return address_; }
    [[nodiscard]] splinefeed::hal::Clock& clock() const noexcept override { return clock_; }

private:
    using Registers = std::vector<std::uint16_t>;
    /// What a request does in a drive; `out` gets what is read.
    using Effect = std::function<splinefeed::host::ModbusException(splinefeed::host::DriveModel&, Registers& out)>;

    LinkAnswer transact(int unit, Registers written, std::span<std::uint16_t> out,
                        const std::function<Effect(Registers)>& effect);
    [[nodiscard]] bool happens(double probability);
    [[nodiscard]] bool unplugged() const noexcept;
    [[nodiscard]] bool is_silent();
    /// An answer on its way to us: to a request that was given up.
    struct OnWay {
        std::uint64_t at_us = 0;
        int unit = 0;
        RequestKind kind = RequestKind::reading;
        Registers registers;
    };
    [[nodiscard]] OnWay* first_before(std::uint64_t instant_us);
    LinkAnswer take_other(LinkAnswer answer, const OnWay& mine, std::span<std::uint16_t> out);
    LinkAnswer fail(LinkAnswer answer, splinefeed::hal::modbus::LinkFault fault, std::uint64_t at_us) noexcept;

    SimulatedWire& wire_;
    LinkAddress address_;
    LinkTiming timing_;
    splinefeed::hal::Clock& clock_;
    std::uint64_t quiet_from_us_ = 0;
    bool connected_ = false;
    bool dirty_ = false;
    bool behind_ = false;
    std::map<std::pair<int, std::size_t>, Registers> earlier_; // answers, by unit and size
    std::vector<OnWay> on_way_;                                // on a serial line
    splinefeed::hal::modbus::OpenAnswers open_;
};

} // namespace splinefeed_test
