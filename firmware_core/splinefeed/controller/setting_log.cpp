// SPDX-License-Identifier: MIT
#include "splinefeed/controller/setting_log.hpp"

#include "splinefeed/base/assertion.hpp"

#include <array>

namespace splinefeed {

namespace {

constexpr std::uint32_t mark = 0x31534653; // "SFS1", the form of the log
constexpr std::uint16_t last_bit = 0x8000;
constexpr std::uint8_t erased = 0xFF;

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, unsigned size) noexcept {
    std::uint32_t out = 0;
    for (unsigned i = 0; i < size; ++i) {
        out |= static_cast<std::uint32_t>(bytes[at + i]) << 8 * i;
    }
    return out;
}

void put_number(std::uint8_t* out, std::uint32_t number, unsigned size) noexcept {
    for (unsigned i = 0; i < size; ++i) {
        out[i] = static_cast<std::uint8_t>(number >> 8 * i);
    }
}

// CRC-32, reflected 0x04C11DB7, without the inversion at its end. @param before  of what came before
std::uint32_t crc_of(std::span<const std::uint8_t> bytes, std::uint32_t before) noexcept {
    for (const std::uint8_t byte : bytes) {
        before ^= byte;
        for (int bit = 0; bit < 8; ++bit) {
            before = (before >> 1) ^ (0xEDB88320U & (0U - (before & 1U)));
        }
    }
    return before;
}

bool is_erased(std::span<const std::uint8_t> bytes) noexcept {
    for (const std::uint8_t byte : bytes) {
        if (byte != erased) {
            return false;
        }
    }
    return true;
}

bool is_same(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) noexcept {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
        same = a[i] == b[i];
    }
    return same;
}

constexpr std::size_t whole_words(std::size_t size) noexcept {
    return (size + LogFlash::word - 1) / LogFlash::word * LogFlash::word;
}

std::size_t size_of(const LogEntry& entry) noexcept {
    return SettingLog::record_head + whole_words(entry.value.size());
}

} // namespace

void SettingLog::open() noexcept {
    live_ = {};
    sector_ = 1;
    sequence_ = 0;
    for (const unsigned sector : {0U, 1U}) {
        const std::span<const std::uint8_t> bytes = flash_->bytes(sector);
        SPLINEFEED_ASSERT(bytes.size() >= sector_head);
        const std::uint32_t sequence = number_at(bytes, 4, 4);
        const bool is_log = number_at(bytes, 0, 4) == mark && number_at(bytes, 8, 4) == crc_of(bytes.first(8), ~0U);
        if (is_log && (live_.empty() || sequence > sequence_)) {
            live_ = bytes;
            sector_ = sector;
            sequence_ = sequence;
        }
    }
    end_ = sector_head;
    Record found;
    for (std::size_t at = end_; (found = record(at)).next != 0 && is_whole(at, found); at = found.next) {
        end_ = found.last ? found.next : end_;
    }
    clean_ = !live_.empty() && is_erased(live_.subspan(end_));
}

SettingLog::Record SettingLog::record(std::size_t at) const noexcept {
    Record out;
    if (at + record_head <= live_.size()) {
        const std::uint32_t size = number_at(live_, at + 2, 2);
        const std::size_t bytes = size & ~std::uint32_t{last_bit};
        out.key = static_cast<std::uint16_t>(number_at(live_, at, 2));
        out.last = (size & last_bit) != 0;
        if (bytes <= longest && at + record_head + whole_words(bytes) <= live_.size()) {
            out.value = live_.subspan(at + record_head, bytes);
            out.next = at + record_head + whole_words(bytes);
        }
    }
    return out;
}

bool SettingLog::is_whole(std::size_t at, const Record& record) const noexcept {
    const std::uint32_t head = crc_of(live_.subspan(at, 4), ~sequence_);
    return number_at(live_, at + 4, 4) == crc_of(record.value, head);
}

std::span<const std::uint8_t> SettingLog::find(std::uint16_t key) const noexcept {
    std::span<const std::uint8_t> out;
    for (std::size_t at = sector_head; at < end_;) {
        const Record found = record(at);
        out = found.key == key ? found.value : out;
        at = found.next;
    }
    return out;
}

bool SettingLog::holds(const LogEntry& entry) const noexcept {
    return is_same(find(entry.key), entry.value);
}

bool SettingLog::holds(std::span<const LogEntry> entries) const noexcept {
    for (const LogEntry& entry : entries) {
        if (!holds(entry)) {
            return false;
        }
    }
    return true;
}

// Where bytes cannot be written any more, the other sector is tried.
bool SettingLog::keep(std::span<const LogEntry> entries) noexcept {
    for (const bool anew : {false, true}) {
        if (holds(entries)) {
            return true;
        }
        anew ? renew(entries) : append(entries);
        open();
    }
    return holds(entries);
}

void SettingLog::append(std::span<const LogEntry> entries) noexcept {
    std::size_t size = 0;
    const LogEntry* last = nullptr;
    for (const LogEntry& entry : entries) {
        if (!holds(entry)) {
            size += size_of(entry);
            last = &entry;
        }
    }
    std::size_t at = end_;
    if (!clean_ || size > live_.size() - at) {
        return;
    }
    for (const LogEntry& entry : entries) {
        at = holds(entry) ? at : write(sector_, at, entry, &entry == last, sequence_);
    }
}

bool SettingLog::is_newest(const Record& record) const noexcept {
    return find(record.key).data() == record.value.data() && !record.value.empty();
}

// Into the other sector: what counts, with the new values in place of the old ones.
void SettingLog::renew(std::span<const LogEntry> entries) noexcept {
    const unsigned sector = 1U - sector_;
    const std::uint32_t sequence = sequence_ + 1;
    flash_->erase(sector);
    const std::size_t most = flash_->bytes(sector).size();
    std::size_t at = sector_head;
    const auto copy = [&](const LogEntry& entry) {
        if (at != 0 && !entry.value.empty()) {
            at = at + size_of(entry) <= most ? write(sector, at, entry, true, sequence) : 0; // 0: no room
        }
    };
    for (std::size_t from = sector_head; from < end_;) {
        const Record old = record(from);
        bool stays = is_newest(old);
        for (const LogEntry& entry : entries) {
            stays = stays && entry.key != old.key;
        }
        if (stays) {
            copy({old.key, old.value});
        }
        from = old.next;
    }
    for (const LogEntry& entry : entries) {
        copy(entry);
    }
    if (at != 0) {
        std::array<std::uint8_t, sector_head> head{};
        put_number(head.data(), mark, 4);
        put_number(&head[4], sequence, 4);
        put_number(&head[8], crc_of(std::span(head).first(8), ~0U), 4);
        program(sector, 0, head);
    }
}

std::size_t SettingLog::write(unsigned sector, std::size_t at, const LogEntry& entry, bool last,
                              std::uint32_t sequence) noexcept {
    SPLINEFEED_ASSERT(entry.key <= largest_key && entry.value.size() <= longest);
    std::array<std::uint8_t, record_head + longest> bytes{};
    const std::size_t size = entry.value.size();
    put_number(bytes.data(), entry.key, 2);
    put_number(&bytes[2], static_cast<std::uint32_t>(size) | (last ? last_bit : 0U), 2);
    for (std::size_t i = 0; i < whole_words(size); ++i) {
        bytes[record_head + i] = i < size ? entry.value[i] : erased;
    }
    put_number(&bytes[4], crc_of(entry.value, crc_of(std::span(bytes).first(4), ~sequence)), 4);
    program(sector, at, std::span(bytes).first(record_head + whole_words(size)));
    return at + record_head + whole_words(size);
}

void SettingLog::program(unsigned sector, std::size_t at, std::span<const std::uint8_t> data) noexcept {
    while (!data.empty()) {
        const std::size_t room = LogFlash::page - at % LogFlash::page;
        const std::size_t part = data.size() < room ? data.size() : room;
        flash_->program(sector, at, data.first(part));
        data = data.subspan(part);
        at += part;
    }
}

} // namespace splinefeed
