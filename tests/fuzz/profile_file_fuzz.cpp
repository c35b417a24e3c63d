// SPDX-License-Identifier: MIT
// Any bytes as a drive profile: a profile whose fields, groups and steps fit together, or one line that says what is
// wrong.
#include "fuzz/require.hpp"
#include "host_sim/config/profile_file.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <array>

using namespace splinefeed::hal::modbus;
using namespace splinefeed::host;
using splinefeed_test::require;

namespace {

void require_sound(const DriveProfile& profile) {
    for (const RegisterField& field : profile.fields) {
        require(field.address + field.registers() <= 65536 && field.lowest <= field.highest);
        require(field.value >= field.lowest && field.value <= field.highest);
        std::array<std::uint16_t, 4> registers{};
        for (const std::int64_t raw : {field.lowest, field.value, field.highest}) {
            put_raw(field, raw, registers);
            require(take_raw(field, registers) == raw);
            const RawValue back = raw_of(field, physical_of(field, raw));
            require(back.raw >= field.lowest && back.raw <= field.highest);
        }
    }
    for (const FieldGroup& group : profile.groups) {
        std::size_t registers = 0;
        for (const FieldIndex index : group.fields) {
            require(profile.fields.at(index).address == group.address + registers);
            registers += profile.fields[index].registers();
        }
        require(registers == group.registers && registers > 0 && registers <= 125);
    }
    for (const auto& steps : profile.commands) {
        for (const CommandStep& step : steps) {
            require(profile.fields.at(step.field).writable() && (step.value & ~step.mask) == 0);
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return splinefeed_test::read_or_refuse(
        data, size, [](std::string_view text) { require_sound(parse_profile(text, "fuzz.toml")); });
}
