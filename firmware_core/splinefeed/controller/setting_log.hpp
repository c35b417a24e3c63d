// SPDX-License-Identifier: MIT
// SettingLog: values by their keys, in two sectors of a flash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace splinefeed {

/// Two sectors of equal size of a flash that is mapped into memory. A byte that is erased is 0xFF.
class LogFlash {
public:
    static constexpr std::size_t page = 256;
    static constexpr std::size_t word = 4;

    /// What stands there. @param sector  0 or 1
    [[nodiscard]] virtual std::span<const std::uint8_t> bytes(unsigned sector) const noexcept = 0;
    /// Clears bits: those that `data` has as 0. @pre `at` and the size are whole words, within one page; `data` is not
    /// in the flash
    virtual void program(unsigned sector, std::size_t at, std::span<const std::uint8_t> data) noexcept = 0;
    virtual void erase(unsigned sector) noexcept = 0;

protected:
    LogFlash() = default;
    LogFlash(const LogFlash&) = default;
    LogFlash& operator=(const LogFlash&) = default;
    ~LogFlash() = default;
};

/// A value that is to be kept; empty: it is forgotten.
struct LogEntry {
    std::uint16_t key = 0; ///< up to SettingLog::largest_key
    std::span<const std::uint8_t> value;
};

/// A sector is a head and records, which are written forwards into erased bytes. Records of one change count when the
/// last of them is whole. A sector that is full, or that a power loss has left with a torn record, is not written any
/// more. Then the newest records go into the other sector, whose head is written last: it makes them count.
/// So whenever the power fails, all values are those before the change, or all are those behind it. Head: mark,
/// sequence, CRC. Record: key, size, CRC, value. The CRC of a record counts the sequence, so what an erase has left of
/// older ones is none. What is not of this log is taken as empty. Cost of a change: the sector is read some times.
class SettingLog {
public:
    static constexpr std::uint16_t largest_key = 0xFFFE;
    static constexpr std::size_t longest = 96;
    /// What a value takes of a sector, beside its bytes in whole words; and what the head takes.
    static constexpr std::size_t record_head = 8;
    static constexpr std::size_t sector_head = 12;

    /// `flash` must outlive it.
    explicit SettingLog(LogFlash& flash) noexcept : flash_(&flash) { open(); }

    /// As it stands in the flash, until the next change; empty: there is none.
    [[nodiscard]] std::span<const std::uint8_t> find(std::uint16_t key) const noexcept;
    /// Keeps all of them or none; what is there already is not written. false: there is no room, or the flash does not
    /// take it. @pre no key comes twice; no value is longer than `longest`
    bool keep(std::span<const LogEntry> entries) noexcept;

private:
    struct Record {
        std::uint16_t key = 0;
        bool last = false; // of its change
        std::span<const std::uint8_t> value;
        std::size_t next = 0; // where the record behind it stands; 0: there is none here
    };

    void open() noexcept;
    [[nodiscard]] Record record(std::size_t at) const noexcept;
    [[nodiscard]] bool is_whole(std::size_t at, const Record& record) const noexcept;
    [[nodiscard]] bool holds(const LogEntry& entry) const noexcept;
    [[nodiscard]] bool holds(std::span<const LogEntry> entries) const noexcept;
    [[nodiscard]] bool is_newest(const Record& record) const noexcept;
    void append(std::span<const LogEntry> entries) noexcept;
    void renew(std::span<const LogEntry> entries) noexcept;
    void program(unsigned sector, std::size_t at, std::span<const std::uint8_t> data) noexcept;
    std::size_t write(unsigned sector, std::size_t at, const LogEntry& entry, bool last,
                      std::uint32_t sequence) noexcept;

    LogFlash* flash_;
    std::span<const std::uint8_t> live_{}; // the sector that counts; empty: none
    unsigned sector_ = 1;                  // its number
    std::uint32_t sequence_ = 0;
    std::size_t end_ = 0; // of what counts
    bool clean_ = false;  // behind that all is erased
};

} // namespace splinefeed
