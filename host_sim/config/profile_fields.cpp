// SPDX-License-Identifier: MIT
// The sections of a profile that say where numbers are: [link], [[field]], [[group]].
#include "host_sim/config/profile_keys.hpp"
#include "host_sim/config/profile_sections.hpp"
#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::array<PhysicalUnit, field_roles> role_units{
    PhysicalUnit::number,        PhysicalUnit::number,        PhysicalUnit::number,       PhysicalUnit::number,
    PhysicalUnit::number,        PhysicalUnit::counts,        PhysicalUnit::counts_per_s, PhysicalUnit::counts_per_s,
    PhysicalUnit::counts_per_s2, PhysicalUnit::counts_per_s2, PhysicalUnit::counts,       PhysicalUnit::counts_per_s,
    PhysicalUnit::counts,        PhysicalUnit::counts,        PhysicalUnit::number,       PhysicalUnit::ms};

void read_wires(const TomlChecker& check, const toml::table& table, LinkSettings& link) {
    const toml::node& node = check.required(table, "wires", "[link]", R"(a list of "rtu" and "tcp")");
    const toml::array& list = check.array(node, "wires", R"(a list of "rtu" and "tcp")");
    link.rtu = false;
    for (const toml::node& entry : list) {
        (check.choice(entry, "wires", wire_names) == 0 ? link.rtu : link.tcp) = true;
    }
    if (!link.rtu && !link.tcp) {
        check.fail(node, R"(wires must name "rtu", "tcp" or both)");
    }
}

void read_functions(const TomlChecker& check, const toml::table& table, LinkSettings& link) {
    constexpr std::string_view form = "a list of 1 to 6, 16 and 23";
    constexpr std::array<std::int64_t, 8> known{1, 2, 3, 4, 5, 6, 16, 23};
    const toml::node& node = check.required(table, "functions", "[link]", form);
    link.functions = 0;
    for (const toml::node& entry : check.array(node, "functions", form)) {
        const std::int64_t function = TomlChecker::whole_of(entry).value_or(0);
        if (std::ranges::find(known, function) == known.end()) {
            check.fail(entry, "functions must be 1 to 6, 16 and 23, those of them that the drive has");
        }
        link.functions |= 1U << static_cast<unsigned>(function);
    }
    if (!link.has(3) || !(link.has(6) || link.has(16))) {
        check.fail(node, "functions must hold 3, which reads, and 6 or 16, which write");
    }
}

// Unit 0 is a broadcast, which nobody answers, and 248 to 254 are reserved.
void read_unit(const TomlChecker& check, const toml::table& table, LinkSettings& link) {
    const toml::node* const node = table.get("unit");
    if (node == nullptr) {
        return;
    }
    if (link.tcp && TomlChecker::whole_of(*node) == single_unit) {
        link.unit = single_unit;
        return;
    }
    link.unit = static_cast<int>(check.whole(*node, "unit", {1, most_unit}));
}

void read_exchanges(const TomlChecker& check, const toml::node& node, LinkSettings& link) {
    constexpr std::string_view form = "pairs of baud rate and ms, like [[9600, 24.9], [115200, 3.08]]";
    constexpr FileKey time = number_key({}, 0, 60000, "ms", {});
    for (const toml::node& entry : check.array(node, "exchange_ms", form)) {
        const toml::array* const pair = entry.as_array();
        if (pair == nullptr || pair->size() != 2) {
            check.fail(entry, "exchange_ms must be {}", form);
        }
        link.exchanges.push_back({static_cast<int>(check.whole((*pair)[0], "the baud rate",
                                                               TomlChecker::whole_range(link_table.row("baud")))),
                                  check.microseconds((*pair)[1], "the time of an exchange", time)});
    }
}

std::int64_t lowest_raw(const RegisterField& field) {
    return !field.is_signed         ? 0
           : field.width_bits == 64 ? std::numeric_limits<std::int64_t>::min()
                                    : -(std::int64_t{1} << (field.width_bits - 1U));
}

std::int64_t highest_raw(const RegisterField& field) {
    const unsigned bits = field.width_bits - (field.is_signed ? 1U : 0U);
    return bits >= 63 ? std::numeric_limits<std::int64_t>::max() : (std::int64_t{1} << bits) - 1;
}

void read_scale(const TomlChecker& check, const toml::table& table, RegisterField& field) {
    constexpr std::int64_t largest = 1'000'000'000'000'000;
    if (const toml::node* node = table.get("scale")) {
        constexpr std::string_view form = "two whole numbers: register = physical * first / second";
        const toml::array& pair = check.array(*node, "scale", form);
        if (pair.size() != 2) {
            check.fail(*node, "scale must be {}", form);
        }
        field.scale_numerator = check.whole(pair[0], "the first number of scale", {-largest, largest});
        field.scale_denominator = check.whole(pair[1], "the second number of scale", {1, largest});
        if (field.scale_numerator == 0) {
            check.fail(*node, "the first number of scale is 0; it must be another one");
        }
    }
    check.take(table, field_table, "inverse", field.inverse);
    field.lowest = lowest_raw(field);
    field.highest = highest_raw(field);
    if (const toml::node* node = table.get("clamp")) {
        constexpr std::string_view form = "the lowest and the highest value of the register";
        const toml::array& pair = check.array(*node, "clamp", form);
        if (pair.size() != 2) {
            check.fail(*node, "clamp must be {}", form);
        }
        const WholeRange range{field.lowest, field.highest};
        field.lowest = check.whole(pair[0], "the first number of clamp", range);
        field.highest = check.whole(pair[1], "the second number of clamp", range);
        if (field.lowest > field.highest) {
            check.fail(*node, "the second number of clamp must not be below the first");
        }
    }
}

void read_name(const TomlChecker& check, const toml::table& table, const DriveProfile& profile, RegisterField& field) {
    const toml::node* const role = table.get("role");
    const toml::node* const name = table.get("name");
    if ((role == nullptr) == (name == nullptr)) {
        check.fail(table, "[[field]] must have a role, of those in docs/reference/profiles.md, or, where none fits, a "
                          "name");
    }
    const toml::node& node = role != nullptr ? *role : *name;
    if (role != nullptr) {
        const auto index = check.value<std::size_t>(node, field_table.row("role"));
        field.role = static_cast<FieldRole>(index + 1);
        field.name = field_role_names[index];
        field.unit = role_units[index + 1];
    } else {
        field.name = check.text(node, "name");
        if (std::ranges::find(field_role_names, field.name) != field_role_names.end()) {
            check.fail(node, "{} is a role; write role = \"{}\"", in_quotes(field.name), field.name);
        }
    }
    if (profile.index_of(field.name) != no_field) {
        check.fail(node, "there are two fields {}; each needs a name of its own", in_quotes(field.name));
    }
}

// Two fields may share registers only where one is read and the other written: some drives have two images.
void refuse_overlap(const TomlChecker& check, const toml::table& table, const DriveProfile& profile,
                    const RegisterField& field) {
    for (const RegisterField& other : profile.fields) {
        const auto behind = [](const RegisterField& one) {
            return one.place() + static_cast<int>(one.registers());
        };
        const bool apart = behind(field) <= other.place() || behind(other) <= field.place();
        const bool both_read = field.readable() && other.readable();
        const bool both_written = field.writable() && other.writable();
        if (!apart && (both_read || both_written)) {
            check.fail(table,
                       "fields {} and {} share registers; give each its own, or one access = \"read\" "
                       "and the other access = \"write\"",
                       in_quotes(other.name), in_quotes(field.name));
        }
    }
}

// Inputs are read only, and a bit is neither a number nor in an order.
void read_table(const TomlChecker& check, const toml::table& table, const DriveProfile& profile, RegisterField& field) {
    constexpr std::array<std::string_view, 9> of_numbers{"width",   "signed", "word_order", "byte_order", "scale",
                                                         "inverse", "unit",   "clamp",      "flash"};
    check.take(table, field_table, "table", field.table);
    if (field.table == RegisterTable::holding) {
        return;
    }
    const std::string_view kind = table_names[static_cast<std::size_t>(field.table)];
    if (profile.stream != StreamWay::speed) {
        check.fail(*table.get("table"), "a field of {} is for stream = \"speed\" alone; leave table out", kind);
    }
    if (is_bit(field.table)) {
        field.width_bits = 1;
        for (const std::string_view key : of_numbers) {
            if (const toml::node* node = table.get(key)) {
                check.fail(*node, "a field of {} is one bit; leave {} out", kind, key);
            }
        }
    }
    if (field.table != RegisterTable::coils) {
        field.access = FieldAccess::read;
    }
}

RegisterField read_field(const TomlChecker& check, const toml::table& table, const DriveProfile& profile) {
    check.require_known(table, field_table);
    RegisterField field;
    read_name(check, table, profile, field);
    const std::string where = fmt::format("field {}", in_quotes(field.name));
    read_table(check, table, profile, field);
    if (const toml::node* node = table.get("width")) {
        const auto width = TomlChecker::whole_of(*node).value_or(0);
        if (width != 16 && width != 32 && width != 64) {
            check.fail(*node, "width must be 16, 32 or 64");
        }
        field.width_bits = static_cast<std::uint8_t>(width);
    }
    const int base = profile.link.address_base;
    const std::int64_t last = 65536 - static_cast<std::int64_t>(field.registers());
    const toml::node& address = check.required(table, "address", where, "the first register");
    field.address = static_cast<std::uint16_t>(check.whole(address, "address", {base, base + last}) - base);
    check.take(table, field_table, "signed", field.is_signed);
    check.take(table, field_table, "word_order", field.word_order);
    check.take(table, field_table, "byte_order", field.byte_order);
    if (const toml::node* node = table.get("unit")) {
        field.unit = check.value<PhysicalUnit>(*node, field_table.row("unit"));
        const PhysicalUnit expected = role_units[static_cast<std::size_t>(field.role)];
        if (field.role != FieldRole::none && field.unit != expected) {
            check.fail(*node, "unit of role \"{}\" must be \"{}\"; the scale leads from it to the register", field.name,
                       unit_names[static_cast<std::size_t>(expected)]);
        }
    }
    const bool inputs = field.table == RegisterTable::input || field.table == RegisterTable::discrete;
    check.take(table, field_table, "access", field.access);
    if (inputs && field.writable()) {
        check.fail(*table.get("access"), "inputs cannot be written; say access = \"read\", or leave it out");
    }
    read_scale(check, table, field);
    check.take(table, field_table, "flash", field.flash);
    field.value = std::clamp(std::int64_t{0}, field.lowest, field.highest);
    if (const toml::node* node = table.get("value")) {
        field.value = check.whole(*node, "value", {field.lowest, field.highest});
    }
    refuse_overlap(check, table, profile, field);
    return field;
}

} // namespace

void read_link(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    const toml::table& table =
        check.table(check.required(root, "link", "the profile", "a table: [link] and its keys below"), "link");
    check.require_known(table, link_table);
    LinkSettings& link = profile.link;
    read_wires(check, table, link);
    read_functions(check, table, link);
    read_unit(check, table, link);
    check.take(table, link_table, "baud", link.baud);
    if (const toml::node* node = table.get("parity")) {
        link.parity = parity_names[check.value<std::size_t>(*node, link_table.row("parity"))].front();
    }
    check.take(table, link_table, "stop_bits", link.stop_bits);
    check.take_ms(table, link_table, "silence_before_ms", link.silence_before_us);
    check.take_ms(table, link_table, "silence_after_ms", link.silence_after_us);
    check.take_ms(table, link_table, "turnaround_ms", link.turnaround_us);
    check.take_ms(table, link_table, "response_timeout_ms", link.response_timeout_us);
    check.take(table, link_table, "retries", link.retries);
    check.take(table, link_table, "most_read_registers", link.most_read_registers);
    check.take(table, link_table, "most_write_registers", link.most_write_registers);
    check.take(table, link_table, "address_base", link.address_base);
    check.take(table, link_table, "reads_zero_until_written", link.reads_zero_until_written);
    if (const toml::node* node = table.get("exchange_ms")) {
        read_exchanges(check, *node, link);
    }
}

// What cannot travel in a frame of the drive's.
void require_frame(const TomlChecker& check, const toml::table& table, const RegisterField& field,
                   const LinkSettings& link) {
    constexpr std::array reads_by{3, 4, 1, 2}; // by table
    const int read_by = reads_by[static_cast<std::size_t>(field.table)];
    const bool unread = field.readable() && !link.has(read_by);
    if (unread || (field.writable() && field.table == RegisterTable::coils && !link.has(5))) {
        check.fail(table, "field {} is {} by function {}, and `functions` of [link] does not have it",
                   in_quotes(field.name), unread ? "read" : "written", unread ? read_by : 5);
    }
    const auto registers = static_cast<int>(field.registers());
    if (field.writable() && registers > 1 && !link.has(16)) {
        check.fail(table,
                   "field {} has {} registers, which function 16 alone writes at once, and "
                   "`functions` of [link] does not have it; say access = \"read\", or leave it out",
                   in_quotes(field.name), registers);
    }
    const bool reads = field.readable() && registers > link.most_read_registers;
    if (reads || (field.writable() && registers > link.most_write_registers)) {
        check.fail(table, "field {} has {} registers; by [link] the drive {} at most {} in a frame",
                   in_quotes(field.name), registers, reads ? "sends" : "takes",
                   reads ? link.most_read_registers : link.most_write_registers);
    }
}

void read_fields(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "field")) {
        profile.fields.push_back(read_field(check, *table, profile));
        require_frame(check, *table, profile.fields.back(), profile.link);
    }
    if (profile.fields.empty()) {
        check.fail_file("there is no [[field]]; a profile has one for each number that it reads or writes");
    }
}

void read_groups(const TomlChecker& check, const toml::table& root, DriveProfile& profile) {
    for (const toml::table* table : check.tables(root, "group")) {
        check.require_known(*table, group_table);
        FieldGroup group;
        group.use = check.value<GroupUse>(check.required(*table, "use", "[[group]]", R"("target" or "status")"),
                                          group_table.row("use"));
        if (profile.group_for(group.use) != nullptr) {
            check.fail(*table, "there are two groups with use = \"{}\"; write one",
                       use_names[static_cast<std::size_t>(group.use)]);
        }
        const bool written = group.use == GroupUse::target;
        const toml::node& list = check.required(*table, "fields", "[[group]]", "a list of names of fields");
        for (const toml::node& entry : check.array(list, "fields", "a list of names of fields")) {
            const FieldIndex index =
                named_field(check, entry, "fields", profile, written ? FieldUse::write : FieldUse::read);
            const RegisterField& field = profile.fields[index];
            const std::size_t next = group.fields.empty() ? field.address : group.address + group.registers;
            if (field.address != next) {
                check.fail(entry, "field {} begins at {}, but the group goes on at {}; one frame has no gaps",
                           in_quotes(field.name), field.address + profile.link.address_base,
                           next + static_cast<std::size_t>(profile.link.address_base));
            }
            if (written && field.flash) {
                check.fail(entry,
                           "field {} wears its flash with every write, and a target group is written "
                           "again and again; leave it out",
                           in_quotes(field.name));
            }
            group.address = group.fields.empty() ? field.address : group.address;
            group.registers += field.registers();
            group.fields.push_back(index);
        }
        const int most = written ? profile.link.most_write_registers : profile.link.most_read_registers;
        if (written && group.registers > 1 && !profile.link.has(16)) {
            check.fail(list, "a target group is written by function 16, and `functions` of [link] does not have it");
        }
        if (group.fields.empty() || group.registers > static_cast<std::size_t>(most)) {
            check.fail(list, "the group has {} registers; it must have 1 to {}", group.registers, most);
        }
        profile.groups.push_back(std::move(group));
    }
}

FieldIndex named_field(const TomlChecker& check, const toml::node& node, std::string_view key,
                       const DriveProfile& profile, FieldUse use) {
    std::vector<std::string_view> names;
    for (const RegisterField& field : profile.fields) {
        names.emplace_back(field.name);
    }
    const FieldIndex index = check.choice(node, key, names);
    const RegisterField& field = profile.fields[index];
    if (use == FieldUse::read ? !field.readable() : !field.writable()) {
        check.fail(node, "field {} cannot be {}: its access is \"{}\"", in_quotes(field.name),
                   use == FieldUse::read ? "read" : "written", access_names[static_cast<std::size_t>(field.access)]);
    }
    return index;
}

} // namespace splinefeed::host
