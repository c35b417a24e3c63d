// SPDX-License-Identifier: MIT
#include "host_sim/drive/register_file.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr int addresses = 65536; // of a table

int places_of(const DriveProfile& profile) {
    int places = addresses;
    for (const RegisterField& field : profile.fields) {
        places = std::max(places, place_in(field.table, addresses));
    }
    return places;
}

std::size_t begin_of(const RegisterField& field) {
    return static_cast<std::size_t>(field.place());
}

} // namespace

std::int64_t with_test(std::int64_t raw, const FieldTest& test, bool truth) {
    const std::int64_t mask = test.mask;
    const std::int64_t made = (raw & ~mask) | static_cast<std::int64_t>(test.value);
    return truth ? made : holds(test, raw) ? raw ^ (mask & -mask) : raw;
}

RegisterFile::RegisterFile(const DriveProfile& profile)
    : fields_(profile.fields), places_(places_of(profile)), read_(static_cast<std::size_t>(places_)), written_(read_),
      reader_(read_.size(), nobody), writer_(read_.size(), nobody) {
    for (std::uint32_t i = 0; i < fields_.size(); ++i) {
        const RegisterField& field = fields_[i];
        for (std::size_t at = begin_of(field); at < begin_of(field) + field.registers(); ++at) {
            reader_[at] = field.readable() ? i : reader_[at];
            writer_[at] = field.writable() ? i : writer_[at];
        }
    }
    reset();
}

void RegisterFile::reset() {
    for (FieldIndex i = 0; i < fields_.size(); ++i) {
        set(i, fields_[i].value);
    }
    last_count_ = 0;
}

// One image where a field is both read and written: the one that is read.
std::span<std::uint16_t> RegisterFile::image_of(const RegisterField& field) {
    return std::span(field.readable() ? read_ : written_).subspan(begin_of(field), field.registers());
}

std::int64_t RegisterFile::raw(FieldIndex index) const {
    const RegisterField& field = fields_[index];
    return take_raw(field, std::span(field.readable() ? read_ : written_).subspan(begin_of(field), field.registers()));
}

void RegisterFile::set(FieldIndex index, std::int64_t raw) {
    put_raw(fields_[index], raw, image_of(fields_[index]));
}

bool RegisterFile::was_written(FieldIndex index) const {
    const RegisterField& field = fields_[index];
    return field.place() >= last_place_ && field.place() < last_place_ + static_cast<int>(last_count_);
}

void RegisterFile::swap_words() {
    for (FieldIndex i = 0; i < fields_.size(); ++i) {
        const std::int64_t value = raw(i);
        RegisterField& field = fields_[i];
        field.word_order =
            field.word_order == Significance::high_first ? Significance::low_first : Significance::high_first;
        set(i, value);
    }
}

// Neither end of the span cuts a number in two.
bool RegisterFile::whole(const std::vector<std::uint32_t>& owner, int place, std::size_t count) const {
    const auto first = static_cast<std::size_t>(place);
    const std::size_t behind = first + count;
    const std::uint32_t begins = owner[first];
    const std::uint32_t ends = owner[behind - 1];
    return begins != nobody && begin_of(fields_[begins]) == first &&
           (ends == nobody || begin_of(fields_[ends]) + fields_[ends].registers() == behind);
}

bool RegisterFile::in_table(int place, std::size_t count) const {
    const int last = place + static_cast<int>(count) - 1;
    return count > 0 && place >= 0 && last < places_ && place / addresses == last / addresses;
}

ModbusException RegisterFile::read(int place, std::span<std::uint16_t> out) const {
    if (place >= places_) {
        return ModbusException::illegal_function; // of a table that the drive does not have
    }
    if (!in_table(place, out.size()) || !whole(reader_, place, out.size())) {
        return ModbusException::illegal_address;
    }
    std::copy_n(read_.begin() + place, out.size(), out.begin());
    return ModbusException::none;
}

ModbusException RegisterFile::write(int place, std::span<const std::uint16_t> values) {
    if (place >= places_) {
        return ModbusException::illegal_function; // of a table that the drive does not have
    }
    if (!in_table(place, values.size()) || !whole(writer_, place, values.size())) {
        return ModbusException::illegal_address;
    }
    std::size_t at = 0;
    while (at < values.size()) {
        const std::uint32_t index = writer_[static_cast<std::size_t>(place) + at];
        if (index == nobody) {
            return ModbusException::illegal_address;
        }
        const RegisterField& field = fields_[index];
        const std::int64_t value = take_raw(field, values.subspan(at, field.registers()));
        if (value < field.lowest || value > field.highest) {
            return ModbusException::illegal_value;
        }
        at += field.registers();
    }
    for (at = 0; at < values.size();) {
        const RegisterField& field = fields_[writer_[static_cast<std::size_t>(place) + at]];
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(at), field.registers(), image_of(field).begin());
        at += field.registers();
    }
    last_place_ = place;
    last_count_ = values.size();
    return ModbusException::none;
}

} // namespace splinefeed::host
