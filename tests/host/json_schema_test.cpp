// SPDX-License-Identifier: MIT
// The readers of machine, profile and map files against their rows, by files with every table and key (tests/schemas):
// what a schema permits is read, and what it forbids is refused. tests/schemas/schemas.py has the schemas themselves.
#include "host_sim/base/json_schema.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/gpio_map.hpp"
#include "host_sim/config/gpio_map_keys.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/config/machine_keys.hpp"
#include "host_sim/config/profile_file.hpp"
#include "host_sim/config/profile_keys.hpp"
#include "schema_check.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <sstream>
#include <toml++/toml.h>
#include <vector>

using namespace splinefeed::host;

namespace {

std::string text_of(const std::string& name) {
    return read_text_file(splinefeed::test::source_folder() + "/tests/schemas/" + name, largest_machine_file);
}

using splinefeed_test::Json;
using Reader = void (*)(const std::string&);

void read_machine(const std::string& text) {
    static_cast<void>(parse_machine(text, "f"));
}
void read_profile(const std::string& text) {
    static_cast<void>(parse_profile(text, "f"));
}
void read_map(const std::string& text) {
    static const MachineDescription machine = parse_machine(text_of("machine.toml"), "m");
    static_cast<void>(parse_gpio_map(text, "f", machine, "/dev/gpiochip0"));
}

/// What the reader says of a document; empty: it takes it.
std::string refusal(const toml::table& document, Reader read) {
    std::ostringstream text;
    text << document;
    try {
        read(text.str());
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

/// As editors see a file: what JSON does not have is null.
Json json_of(const toml::node& node) {
    if (const auto* const table = node.as_table()) {
        Json out = Json::object();
        for (const auto& [key, value] : *table) {
            out[std::string(key.str())] = json_of(value);
        }
        return out;
    }
    if (const auto* const list = node.as_array()) {
        Json out = Json::array();
        for (const toml::node& value : *list) {
            out.push_back(json_of(value));
        }
        return out;
    }
    const auto number = node.value_exact<double>();
    return node.is_string()                   ? Json(*node.value_exact<std::string>())
           : node.is_integer()                ? Json(*node.value_exact<std::int64_t>())
           : node.is_boolean()                ? Json(*node.value_exact<bool>())
           : number && std::isfinite(*number) ? Json(*number)
                                              : Json(nullptr);
}

/// Values of a key, right and wrong, as TOML: those of any key, lists where it may be one, and the ends of its range.
std::vector<std::string> values_of(const FileKey& row) {
    std::vector<std::string> values{"1979-05-27", "inf", "true", "-1", "2.0", "0.3", "1e300", "''", "'x'", "{}", "[]"};
    if (row.kind > KeyKind::choice) {
        values.insert(values.end(),
                      {"0", "255", "'/'", "nan", "['x']", "['']", "[0]", "[2, 1]", "[true]", "[0, 1]", "[true, false]",
                       "[1, 2, 3]", "[3, 23]", "[3, 6.0]", "[6, 16]", "[[1, 1]]", "[[9600.0, 1]]", "[[9600, 1, 1]]"});
    }
    const bool whole = row.kind == KeyKind::whole;
    const bool number = row.kind == KeyKind::number;
    for (const double end : {row.low, row.high}) {
        const double step = whole ? 1.0 : std::fmax(1.0, std::fabs(end)) * 1e-9;
        for (const double value : {end - step, end, end + step}) {
            constexpr double any = 1e15;
            if ((whole || number) && std::fabs(value) < any) {
                values.push_back(fmt::format("{:.16g}", value));
            } else if (row.kind == KeyKind::text && end >= 1.0 && end < any) {
                values.push_back("'" + std::string(static_cast<std::size_t>(end + std::round(value - end)), 'x') + "'");
            }
        }
    }
    for (const std::string_view name : row.names) {
        values.push_back(fmt::format("'{}'", name));
        values.push_back(fmt::format("['{}']", name));
    }
    return values;
}

/// The bounds of numbers anywhere in a schema.
void add_bounds(const Json& schema, std::set<std::int64_t>& bounds) {
    for (const auto& [word, says] : schema.items()) {
        if ((word == "minimum" || word == "maximum") && says.is_number_integer()) {
            bounds.insert(says.get<std::int64_t>());
        } else if (says.is_structured()) {
            add_bounds(says, bounds);
        }
    }
}

/// A right value, as TOML, with each of its numbers at each bound of the schema, and one beside it.
std::vector<std::string> values_at_bounds(const std::string& right, const Json& schema) {
    std::set<std::int64_t> bounds;
    add_bounds(schema, bounds);
    static const std::regex number(R"(-?[0-9][0-9.]*)");
    std::vector<std::string> values;
    for (std::sregex_iterator at(right.begin(), right.end(), number), end; at != end; ++at) {
        for (const std::int64_t bound : bounds) {
            for (const std::int64_t value : {bound - 1, bound, bound + 1}) {
                std::string text = right;
                values.push_back(text.replace(static_cast<std::size_t>(at->position()),
                                              static_cast<std::size_t>(at->length()), std::to_string(value)));
            }
        }
    }
    return values;
}

struct Walk {
    toml::table& document;
    Reader read;
    const Json& schema;
    std::span<const std::string_view> only_reader; // parts of sentences: what no schema can say
    std::set<const FileTable*> seen{};
    std::map<std::pair<const FileTable*, std::string_view>, std::string> keys{}; // with a value that is right
    std::set<std::string_view> used{};                                           // of only_reader

    /// Reader and schema say the same of the document; or the reader knows more. @param named  in what it says
    void compare(std::string_view named = {}) {
        const std::string said = refusal(document, read);
        CAPTURE(said);
        if (!splinefeed_test::validates(json_of(document), schema)) {
            CHECK_FALSE(said.empty());
            CHECK(said.find(named) != std::string::npos);
        } else if (!said.empty()) {
            const auto known = std::find_if(only_reader.begin(), only_reader.end(), [&](std::string_view part) {
                return said.find(part) != std::string::npos;
            });
            CHECK(known != only_reader.end());
            used.insert(known != only_reader.end() ? *known : std::string_view());
        }
    }

    void table(toml::table& here, const FileTable& rows) {
        const bool first = seen.insert(&rows).second;
        const toml::table before = here;
        here.insert("surplus", 1);
        compare("unknown key 'surplus'");
        here = before;
        for (const FileKey& row : rows.keys) {
            CAPTURE(rows.where, row.key);
            const Json own_schema = schema_of(row);
            const toml::node* const given = before.get(row.key);
            std::vector<std::string> values;
            if (given != nullptr) {
                std::ostringstream text;
                text << toml::table{{"v", *given}};
                if (keys.emplace(std::pair(&rows, row.key), text.str()).second && row.kind == KeyKind::form) {
                    values = values_at_bounds(text.str(), own_schema);
                }
                here.erase(row.key);
                compare();
                here = before;
            } else if (const auto known = keys.find({&rows, row.key}); known != keys.end()) {
                values.push_back(known->second);
            }
            if (first || given == nullptr) {
                for (const std::string& value : values_of(row)) {
                    values.push_back("v = " + value);
                }
            }
            for (const std::string& text : values) {
                CAPTURE(text);
                toml::table value = toml::parse(text);
                const bool names_key = row.kind <= KeyKind::choice && given != nullptr &&
                                       !splinefeed_test::validates(json_of(*value.get("v")), own_schema);
                value.get("v")->visit([&](auto& node) { here.insert_or_assign(row.key, std::move(node)); });
                compare(names_key ? row.key : std::string_view());
                here = before;
            }
            if (row.inside != nullptr && given != nullptr) {
                inside(*here.get(row.key), row);
            }
        }
    }

    void inside(toml::node& node, const FileKey& row) {
        if (toml::array* const list = node.as_array()) {
            for (toml::node& each : *list) {
                table(*each.as_table(), *row.inside);
            }
        } else if (row.kind == KeyKind::by_axis) {
            for (auto&& [name, each] : *node.as_table()) {
                table(*each.as_table(), *row.inside);
            }
        } else if (toml::table* const one = node.as_table()) {
            table(*one, *row.inside);
        }
    }
};

void require_all(const Walk& walk, const FileTable& rows) {
    CAPTURE(rows.where);
    CHECK(walk.seen.count(&rows) == 1);
    for (const FileKey& row : rows.keys) {
        CAPTURE(row.key);
        CHECK(walk.keys.count({&rows, row.key}) == 1); // one of the files has it
        if (row.inside != nullptr) {
            require_all(walk, *row.inside);
        }
    }
}

void check(std::initializer_list<const char*> files, const FileTable& rows, Reader read,
           std::initializer_list<std::string_view> only_reader) {
    const Json schema = schema_of(rows);
    toml::table document;
    Walk walk{document, read, schema, {only_reader.begin(), only_reader.size()}};
    for (const char* const file : files) {
        CAPTURE(file);
        document = toml::parse(text_of(file));
        REQUIRE(refusal(document, read) == "");
        REQUIRE(splinefeed_test::validates(json_of(document), schema));
        walk.table(document, rows);
    }
    require_all(walk, rows);
    CHECK(walk.used == std::set(only_reader));
}

} // namespace

// What the schema permits, but for values that depend on other tables or files, on names, and on the form of addresses.
TEST_CASE("The reader of machine files takes each key of its schema, and refuses what the schema refuses") {
    check({"machine.toml", "machine_vfd.toml"}, machine_table, read_machine,
          {"min_rpm must be a number from 0 to", "names no chip", "there is no [[module]] with",
           "is no address of a drive", "this is the second", "the second number must be the larger one"});
}

TEST_CASE("The reader of drive profiles takes each key of its schema, and refuses what the schema refuses") {
    check({"profile.toml"}, profile_table, read_profile,
          {"needs a field that is",
           "there is no command",
           "there is no state",
           "address must be a whole number from",
           "its access is",
           "wears its flash",
           "the group goes on at",
           "function 16 alone writes at once",
           "in a frame",
           "; known are ",
           "share registers",
           "homing_mode must be",
           "stream_mode must be",
           "mask must be a whole number from 1 to 65535",
           "of clamp must",
           "the group has",
           "there are two",
           "the scale leads from it",
           "has bits outside the mask",
           ": value must be a whole number from"});
}

TEST_CASE("The reader of map files takes each key of its schema, and refuses what the schema refuses") {
    check({"map.toml"}, map_table, read_map,
          {"there is no [axis.", "is of a second motor", "as the machine file says motors = 2",
           "each needs a line of its own", "has no switch", "latch_mm_s must be a number from",
           "seek_mm_s must be a number from"});
}
