// SPDX-License-Identifier: MIT
#include "host_sim/drive/register_file.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>

namespace splinefeed::host {

using namespace hal::modbus;

std::int64_t with_test(std::int64_t raw, const FieldTest& test, bool truth) {
    const std::int64_t mask = test.mask;
    const std::int64_t made = (raw & ~mask) | static_cast<std::int64_t>(test.value);
    return truth ? made : holds(test, raw) ? raw ^ (mask & -mask) : raw;
}

RegisterFile::RegisterFile(const DriveProfile& profile)
    : fields_(profile.fields), read_(addresses), written_(addresses), reader_(addresses, nobody),
      writer_(addresses, nobody) {
    for (std::uint32_t i = 0; i < fields_.size(); ++i) {
        const RegisterField& field = fields_[i];
        for (std::size_t at = field.address; at < field.address + field.registers(); ++at) {
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
    return std::span(field.readable() ? read_ : written_).subspan(field.address, field.registers());
}

std::int64_t RegisterFile::raw(FieldIndex index) const {
    const RegisterField& field = fields_[index];
    return take_raw(field, std::span(field.readable() ? read_ : written_).subspan(field.address, field.registers()));
}

void RegisterFile::set(FieldIndex index, std::int64_t raw) {
    put_raw(fields_[index], raw, image_of(fields_[index]));
}

bool RegisterFile::was_written(FieldIndex index) const {
    const RegisterField& field = fields_[index];
    return field.address >= last_address_ && field.address < last_address_ + static_cast<int>(last_count_);
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
bool RegisterFile::whole(const std::vector<std::uint32_t>& owner, int address, std::size_t count) const {
    const auto first = static_cast<std::size_t>(address);
    const std::size_t behind = first + count;
    const std::uint32_t begins = owner[first];
    const std::uint32_t ends = owner[behind - 1];
    return begins != nobody && fields_[begins].address == first &&
           (ends == nobody || fields_[ends].address + fields_[ends].registers() == behind);
}

ModbusException RegisterFile::read(int address, std::span<std::uint16_t> out) const {
    if (out.empty() || address < 0 || address + static_cast<int>(out.size()) > addresses ||
        !whole(reader_, address, out.size())) {
        return ModbusException::illegal_address;
    }
    std::copy_n(read_.begin() + address, out.size(), out.begin());
    return ModbusException::none;
}

ModbusException RegisterFile::write(int address, std::span<const std::uint16_t> values) {
    if (values.empty() || address < 0 || address + static_cast<int>(values.size()) > addresses ||
        !whole(writer_, address, values.size())) {
        return ModbusException::illegal_address;
    }
    std::size_t at = 0;
    while (at < values.size()) {
        const std::uint32_t index = writer_[static_cast<std::size_t>(address) + at];
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
        const RegisterField& field = fields_[writer_[static_cast<std::size_t>(address) + at]];
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(at), field.registers(), image_of(field).begin());
        at += field.registers();
    }
    last_address_ = address;
    last_count_ = values.size();
    return ModbusException::none;
}

} // namespace splinefeed::host
