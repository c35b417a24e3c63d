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
#include "support/catch.hpp"
#include "support/places.hpp"

#include <cmath>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <toml++/toml.h>
#include <vector>

using namespace splinefeed::host;

namespace {

std::string text_of(const std::string& name) {
    return read_text_file(splinefeed::test::source_folder() + "/tests/schemas/" + name, largest_machine_file);
}

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

/// Everything that is wrong with a value of the row, as TOML.
std::vector<std::string> wrong_values(const FileKey& row) {
    std::vector<std::string> wrong{"1979-05-27"}; // a day is never right
    const auto beyond = [&](double limit, double sign) {
        constexpr double any = 1e15;
        if ((row.kind == KeyKind::whole || row.kind == KeyKind::number) && std::fabs(limit) < any) {
            const double step = row.kind == KeyKind::whole ? 1.0 : std::fmax(1.0, std::fabs(limit)) * 1e-9;
            wrong.push_back(fmt::format("{:.16g}", limit + sign * step));
        }
    };
    beyond(row.low, -1.0);
    beyond(row.high, 1.0);
    if (row.kind == KeyKind::whole) {
        wrong.emplace_back("0.5");
    }
    if (row.kind == KeyKind::choice) {
        wrong.emplace_back("'neither'");
    }
    if (row.kind == KeyKind::choices || row.kind == KeyKind::texts) {
        wrong.emplace_back("[1]");
    }
    return wrong;
}

struct Walk {
    toml::table& document;
    Reader read;
    std::set<const FileTable*> seen{};
    std::set<std::pair<const FileTable*, std::string_view>> keys{};

    void table(toml::table& here, const FileTable& rows) {
        seen.insert(&rows);
        const toml::table before = here;
        here.insert("surplus", 1);
        CHECK(refusal(document, read).find("unknown key 'surplus'") != std::string::npos);
        here = before;
        for (const FileKey& row : rows.keys) {
            CAPTURE(rows.where, row.key);
            if (here.contains(row.key)) {
                keys.emplace(&rows, row.key);
            }
            for (const std::string& wrong : wrong_values(row)) {
                CAPTURE(wrong);
                toml::table value = toml::parse("v = " + wrong);
                value.get("v")->visit([&](auto& node) { here.insert_or_assign(row.key, std::move(node)); });
                const std::string said = refusal(document, read);
                CHECK_FALSE(said.empty());
                CHECK((!before.contains(row.key) || said.find(row.key) != std::string::npos));
                here = before;
            }
            if (row.required) {
                here.erase(row.key);
                CHECK_FALSE(refusal(document, read).empty());
                here = before;
            }
            if (row.inside != nullptr && here.contains(row.key)) {
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

void check(std::initializer_list<const char*> files, const FileTable& rows, Reader read) {
    toml::table document;
    Walk walk{document, read};
    for (const char* const file : files) {
        CAPTURE(file);
        document = toml::parse(text_of(file));
        REQUIRE(refusal(document, read) == "");
        walk.table(document, rows);
    }
    require_all(walk, rows);
}

} // namespace

TEST_CASE("The reader of machine files takes each key of its schema, and refuses what the schema refuses") {
    check({"machine.toml", "machine_vfd.toml"}, machine_table, read_machine);
}

TEST_CASE("The reader of drive profiles takes each key of its schema, and refuses what the schema refuses") {
    check({"profile.toml"}, profile_table, read_profile);
}

TEST_CASE("The reader of map files takes each key of its schema, and refuses what the schema refuses") {
    check({"map.toml"}, map_table, read_map);
}
