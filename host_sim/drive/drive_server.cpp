// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_server.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

using std::chrono::duration_cast;
using std::chrono::microseconds;

constexpr std::size_t kept_replies = 8;
constexpr std::size_t block_bytes = 22;      // of an exchange block of splinefeed-pvt: a write that long has a checksum
constexpr double quiet_characters = 3.5;     // at the end of a frame
constexpr microseconds quiet_at_least{1750}; // above 19200 baud
constexpr std::size_t flood_bytes = 4096;    // at once, where there is no pace
constexpr microseconds flood_every{200};

microseconds from_ms(double ms) {
    return microseconds(std::llround(ms * 1000.0));
}

} // namespace

DriveServer::DriveServer(DriveModel& model, const ListenAddress& address, DriveFaults faults, std::uint64_t seed)
    : model_(&model), wire_(address), exchange_(model, wire_.address()), faults_(std::move(faults)),
      dice_(faults_, seed), start_(Clock::now()), line_free_(start_) {}

double DriveServer::start_s() const noexcept {
    return std::chrono::duration<double>(start_.time_since_epoch()).count();
}

double DriveServer::passed_s(Clock::time_point time) const {
    return std::chrono::duration<double>(time - start_).count();
}

std::uint64_t DriveServer::model_us(Clock::time_point time) const {
    return static_cast<std::uint64_t>(std::max(us_per_s * passed_s(time) * (1.0 + faults_.clock_skew_ppm * 1e-6), 0.0));
}

void DriveServer::run(const volatile std::sig_atomic_t& stop, DriveRecord* record) {
    record_ = record;
    while (stop == 0) {
        fire_events(Clock::now());
        const bool deaf = thaws_.has_value() || connects_.has_value();
        wire_.wait(until_next(Clock::now()), deaf);
        Clock::time_point now = Clock::now();
        advance(now);
        if (!deaf) {
            for (DriveWire::Request& request : wire_.receive()) {
                now = Clock::now();
                advance(now);
                accept(std::move(request), now);
            }
        }
        if (!thaws_) {
            deliver(Clock::now());
            flood(Clock::now());
        }
    }
    // The record ends behind everything that was told.
    wire_.wait(microseconds(1000 - model_us(Clock::now()) % 1000 + 1), true);
    advance(Clock::now());
}

microseconds DriveServer::until_next(Clock::time_point now) const {
    // Rows may be written late; what happens to the drive may not.
    const microseconds longest(faults_.events.empty() ? 20000 : 1000);
    microseconds wait = longest - microseconds(model_us(now)) % longest;
    if (faults_.lasts(DriveFaults::EventKind::flood, passed_s(now))) {
        wait = std::min(wait, flood_every);
    }
    for (const Due& due : due_) {
        wait = std::min(wait, duration_cast<microseconds>(due.time - now));
    }
    return std::max(wait, microseconds(0));
}

void DriveServer::fire_events(Clock::time_point now) {
    if (const ModelFaults faults = faults_.of_model(passed_s(now)); faults != model_faults_) {
        advance(now);
        model_->set_faults(faults);
        model_faults_ = faults;
    }
    if (connects_ && *connects_ <= now) {
        connects_.reset();
        wire_.connect();
    }
    if (thaws_ && *thaws_ <= now) {
        thaws_.reset();
    }
    for (; event_ < faults_.events.size(); ++event_) {
        const DriveFaults::Event& event = faults_.events[event_];
        if (start_ + from_ms(event.time_s * 1000.0) > now) {
            return;
        }
        switch (event.kind) {
        case DriveFaults::EventKind::disconnect:
            wire_.disconnect();
            due_.clear();
            connects_ = now + from_ms(event.amount);
            break;
        case DriveFaults::EventKind::freeze: thaws_ = now + from_ms(event.amount); break;
        case DriveFaults::EventKind::power_cycle:
            advance(now);
            model_->power_cycle();
            due_.clear();
            if (!connects_) {
                wire_.disconnect();
                wire_.connect();
            }
            break;
        case DriveFaults::EventKind::swap_words: model_->swap_words(); break;
        case DriveFaults::EventKind::second_master:
            advance(now);
            model_->second_master();
            break;
        case DriveFaults::EventKind::flood:
        case DriveFaults::EventKind::refuse_stop:
        case DriveFaults::EventKind::stuck_state:
        case DriveFaults::EventKind::stuck_place:
        case DriveFaults::EventKind::no_room:
        case DriveFaults::EventKind::told_state: break; // they last
        }
    }
}

// Each row holds where the shafts were at its instant, however late it is written: between two looks at the clock a
// host may stand still, so nothing else lets the model's time pass.
void DriveServer::advance(Clock::time_point now) {
    const std::uint64_t now_us = model_us(now);
    for (; recorded_ms_ * 1000 <= now_us; ++recorded_ms_) {
        model_->advance(recorded_ms_ * 1000);
        if (record_ != nullptr) {
            record_->row(recorded_ms_, *model_);
        }
    }
    model_->advance(now_us);
}

microseconds DriveServer::line_time(std::size_t bytes) const {
    const ListenAddress& address = wire_.address();
    return address.kind == ListenAddress::Kind::tcp || !address.pace
               ? microseconds(0)
               : microseconds(std::llround(static_cast<double>(bytes) * address.character_us()));
}

// A paced frame that has arrived in no time would still be on its way.
void DriveServer::accept(DriveWire::Request request, Clock::time_point now) {
    const microseconds frame = line_time(request.bytes.size());
    if (frame.count() == 0) {
        serve(request.channel, std::move(request.bytes), now);
        return;
    }
    const auto quiet =
        std::max(quiet_at_least, microseconds(std::llround(quiet_characters * wire_.address().character_us())));
    const Clock::time_point arrived = std::max(now, line_free_) + frame + quiet;
    due_.push_back({arrived, true, request.channel, std::move(request.bytes)});
}

void DriveServer::serve(int channel, Bytes request, Clock::time_point now) {
    if (now < hears_) {
        return;
    }
    const ExchangeFaults faults = dice_.next();
    hears_ = now + from_ms(faults.mute_ms);
    if (faults.drop_request || now < hears_) {
        return;
    }
    const bool damages_request = faults.corrupt && (faults.bits & 1U) != 0 && !faults.exception;
    if (damages_request && wire_.address().kind == ListenAddress::Kind::rtu) {
        return; // its CRC would be wrong
    }
    const bool damaged = damages_request && damage_block(request, faults.bits >> 1U);
    Bytes reply = reply_to(request, faults);
    if (faults.drop_reply || reply.empty()) {
        return;
    }
    const Bytes intact = reply;
    const bool stale = faults.stale && replace_by_stale(reply);
    sent_.push_back(intact);
    if (sent_.size() > kept_replies) {
        sent_.pop_front();
    }
    if (faults.corrupt && !damaged && !stale) {
        const std::size_t bit = (faults.bits >> 1U) % (8 * reply.size());
        reply[bit / 8] = static_cast<std::uint8_t>(reply[bit / 8] ^ 1U << bit % 8);
    }
    if (faults.short_reply) {
        reply.resize(1 + (faults.bits >> 1U) % (reply.size() - 1));
    }
    Clock::time_point due = now + from_ms(faults.delay_ms);
    const auto put_before = [&](Bytes frame) {
        due += line_time(frame.size());
        send(channel, std::move(frame), due, 0.0);
    };
    if (faults.echo) {
        put_before(request);
    }
    if (faults.foreign) {
        put_before(foreign_frame(request));
    }
    due += line_time(reply.size());
    send(channel, reply, due, faults.drip_ms);
    if (faults.repeat_reply) {
        send(channel, std::move(reply), due + line_time(intact.size()), faults.drip_ms);
    }
}

// On a serial line another drive's answer to another master; on TCP our answer to an earlier request.
DriveServer::Bytes DriveServer::foreign_frame(const Bytes& request) {
    if (wire_.address().kind == ListenAddress::Kind::tcp) {
        return sent_.front();
    }
    constexpr std::uint8_t most_unit = 247;
    Bytes theirs = request;
    theirs.front() = static_cast<std::uint8_t>(theirs.front() % most_unit + 1);
    return exchange_.refuse(theirs, ModbusException::busy);
}

DriveServer::Bytes DriveServer::reply_to(const Bytes& request, const ExchangeFaults& faults) {
    if (faults.exception) {
        return exchange_.refuse(request,
                                (faults.bits & 2U) != 0 ? ModbusException::busy : ModbusException::device_failure);
    }
    if (faults.repeat_request) {
        static_cast<void>(exchange_.answer(request));
    }
    return exchange_.answer(request);
}

// Nothing protects a frame on TCP; what is written with a checksum of its own can be damaged, and must be found out.
bool DriveServer::damage_block(Bytes& request, std::uint64_t bits) const {
    const std::uint8_t function = request[exchange_.header()];
    const std::size_t data = exchange_.header() + (function == 16 ? 6 : 10);
    if ((function != 16 && function != 23) || request.size() < data + block_bytes) {
        return false;
    }
    const std::size_t bit = bits % (8 * (request.size() - data));
    std::uint8_t& byte = request[data + bit / 8];
    byte = static_cast<std::uint8_t>(byte ^ 1U << bit % 8);
    return true;
}

// The oldest one that could be taken for this reply. Over TCP with the number of this transaction: a gateway that mixes
// up its clients does that.
bool DriveServer::replace_by_stale(Bytes& reply) const {
    const std::size_t header = exchange_.header();
    const auto alike = [&](const Bytes& old) {
        return old.size() == reply.size() && old[header] == reply[header];
    };
    const auto found = std::ranges::find_if(sent_, alike);
    if (found == sent_.end() || *found == reply) {
        return false;
    }
    Bytes old = *found;
    if (wire_.address().kind == ListenAddress::Kind::tcp) {
        std::copy_n(reply.begin(), 2, old.begin());
    }
    reply = std::move(old);
    return true;
}

void DriveServer::send(int channel, Bytes reply, Clock::time_point due, double drip_ms) {
    if (drip_ms == 0.0) {
        due_.push_back({due, false, channel, std::move(reply)});
        return;
    }
    for (std::size_t i = 0; i < reply.size(); ++i) {
        due_.push_back({due + from_ms(static_cast<double>(i) * drip_ms), false, channel, {reply[i]}});
    }
}

// Bytes without an end to everybody, as fast as the line takes them.
void DriveServer::flood(Clock::time_point now) {
    const Clock::time_point since = std::max(flooded_, now - microseconds(1000));
    flooded_ = now;
    if (!faults_.lasts(DriveFaults::EventKind::flood, passed_s(now))) {
        return;
    }
    const double character_us = static_cast<double>(line_time(1000).count()) / 1000.0;
    const std::size_t count =
        character_us == 0.0
            ? flood_bytes
            : static_cast<std::size_t>(std::chrono::duration<double, std::micro>(now - since).count() / character_us);
    wire_.send_all(Bytes(count, 0x55));
}

void DriveServer::deliver(Clock::time_point now) {
    for (std::size_t i = 0; i < due_.size();) {
        if (due_[i].time > now) {
            ++i;
            continue;
        }
        Due due = std::move(due_[i]);
        due_.erase(due_.begin() + static_cast<std::ptrdiff_t>(i));
        if (due.request) {
            advance(now);
            serve(due.channel, std::move(due.bytes), now);
        } else {
            wire_.send(due.channel, due.bytes);
            line_free_ = now;
        }
    }
}

} // namespace splinefeed::host
