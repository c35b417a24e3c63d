// SPDX-License-Identifier: MIT
// The log of settings: whatever happens to the flash, what is read is what was kept before, or behind the change.
#include "splinefeed/controller/setting_log.hpp"
#include "support/catch.hpp"
#include "support/ram_flash.hpp"
#include "support/rounds.hpp"

#include <map>

using namespace splinefeed;
using namespace splinefeed::test;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Model = std::map<std::uint16_t, Bytes>;

constexpr std::uint16_t keys = 6; // 1 to this

Model read(const SettingLog& log) {
    Model out;
    for (std::uint16_t key = 0; key <= keys + 1; ++key) {
        const std::span<const std::uint8_t> value = log.find(key);
        if (!value.empty()) {
            out[key] = Bytes(value.begin(), value.end());
        }
    }
    return out;
}

bool keep(RamFlash& flash, const Model& change) {
    SettingLog log(flash);
    std::vector<LogEntry> entries;
    for (const auto& [key, value] : change) {
        entries.push_back({key, value});
    }
    return log.keep(entries);
}

Model changed(Model model, const Model& change) {
    for (const auto& [key, value] : change) {
        model[key] = value;
    }
    std::erase_if(model, [](const auto& row) { return row.second.empty(); });
    return model;
}

// One to three values; some are forgotten.
Model random_change(std::mt19937& random) {
    Model out;
    for (unsigned i = 0; i <= random() % 3; ++i) {
        Bytes& value = out[static_cast<std::uint16_t>(1 + random() % keys)];
        value.resize(random() % 5 == 0 ? 0 : 1 + random() % 20);
        for (std::uint8_t& byte : value) {
            byte = static_cast<std::uint8_t>(random());
        }
    }
    return out;
}

} // namespace

TEST_CASE("a power loss at any byte of any change leaves the values before it or behind it", "[controller]") {
    const unsigned seed = splinefeed_test::random_seed();
    CAPTURE(seed);
    std::mt19937 random(seed);
    const std::size_t sector = GENERATE(320U, 512U, 1024U);
    RamFlash flash(sector);
    flash.random.seed(seed);
    Model model;
    int before = 0;
    int behind = 0;
    const auto changes = static_cast<int>(sector / 10);
    for (int i = 0; i < changes; ++i) {
        const Model change = random_change(random);
        const Model next = changed(model, change);
        RamFlash whole = flash;
        whole.power_on();
        REQUIRE(keep(whole, change));
        CHECK(read(SettingLog(whole)) == next);
        for (std::size_t cut = 0; cut < whole.steps; ++cut) {
            RamFlash torn = flash;
            torn.power_on();
            torn.random.seed(seed + static_cast<unsigned>(cut));
            torn.cut_after = cut;
            const bool said = keep(torn, change);
            torn.power_on();
            const Model found = read(SettingLog(torn));
            REQUIRE((found == model || found == next));
            REQUIRE((!said || found == next));
            ++(found == next ? behind : before);
            // And so it goes on, with another cut in the next change.
            const Model second = random_change(random);
            torn.cut_after = random() % (sector + 100);
            keep(torn, second);
            torn.power_on();
            const Model last = read(SettingLog(torn));
            REQUIRE((last == found || last == changed(found, second)));
            REQUIRE(keep(torn, change));
            CHECK(read(SettingLog(torn)) == changed(last, change));
        }
        flash = whole;
        model = next;
    }
    CHECK(before > changes);
    CHECK(behind > 0);
    CHECK(flash.erases > 2);
}

TEST_CASE("a change costs few erases, and one that changes nothing writes nothing", "[controller]") {
    RamFlash flash(4096);
    SettingLog log(flash);
    Bytes value(8);
    const int changes = 4000;
    for (int i = 0; i < changes; ++i) {
        value[static_cast<std::size_t>(i) % 8] = static_cast<std::uint8_t>(i % 251);
        value[0] = static_cast<std::uint8_t>(i);
        const LogEntry entry{static_cast<std::uint16_t>(i % 40), value};
        REQUIRE(log.keep({&entry, 1}));
        const std::size_t steps = flash.steps;
        REQUIRE(log.keep({&entry, 1}));
        REQUIRE(flash.steps == steps);
    }
    // A record has 16 bytes, and 40 of them stay in a sector of 4096.
    CHECK(flash.erases <= changes * 16 / (4096 - 12 - 41 * 16) + 1);
    CHECK(flash.erases >= changes * 16 / 4096);
}

TEST_CASE("what does not fit into a sector is refused, and all stays", "[controller]") {
    RamFlash flash(256);
    SettingLog log(flash);
    const Bytes value(60, 7);
    for (std::uint16_t key = 1; key <= 3; ++key) {
        const LogEntry entry{key, value};
        REQUIRE(log.keep({&entry, 1}));
    }
    const Model model = read(log);
    REQUIRE(model.size() == 3);
    const Bytes other(60, 8);
    const LogEntry entries[] = {{1, other}, {4, value}};
    CHECK_FALSE(log.keep(entries));
    CHECK(read(log) == model);
    CHECK(read(SettingLog(flash)) == model);
    const LogEntry exchange[] = {{1, {}}, {4, value}};
    CHECK(log.keep(exchange));
    CHECK(read(log) == changed(model, {{1, {}}, {4, value}}));
}

TEST_CASE("what is not of this log is taken as empty, and written over", "[controller]") {
    std::mt19937 random(splinefeed_test::random_seed());
    const Bytes value{1, 2, 3};
    const std::string kind = GENERATE("random", "zero", "other version", "torn heads", "mark and rubbish");
    CAPTURE(kind);
    RamFlash flash(512);
    for (int round = 0; round < 50; ++round) {
        for (const unsigned sector : {0U, 1U}) {
            flash.erase(sector);
            Bytes& bytes = flash.content(sector);
            if (kind == "other version" || kind == "torn heads") {
                RamFlash ours(512);
                REQUIRE(keep(ours, {{5, {9}}}));
                bytes = ours.content(0);
                bytes[kind == "other version" ? 3U : 4U + random() % 8] ^=
                    static_cast<std::uint8_t>(1 + random() % 254);
                continue;
            }
            for (std::uint8_t& byte : bytes) {
                byte = kind == "zero" ? std::uint8_t{0} : static_cast<std::uint8_t>(random());
            }
            if (kind == "mark and rubbish") {
                RamFlash ours(512);
                REQUIRE(keep(ours, {{5, {9}}}));
                std::copy_n(ours.content(0).begin(), 12, bytes.begin());
            }
        }
        CHECK(read(SettingLog(flash)).empty());
        REQUIRE(keep(flash, {{5, value}}));
        CHECK(read(SettingLog(flash)) == Model{{5, value}});
    }
}

TEST_CASE("where a sector takes no more bytes the other one has the values", "[controller]") {
    RamFlash flash(512);
    flash.worn = 100;
    SettingLog log(flash);
    Bytes value(8);
    for (int i = 0; i < 200; ++i) {
        value[0] = static_cast<std::uint8_t>(i);
        const LogEntry entry{static_cast<std::uint16_t>(i % 3), value};
        REQUIRE(log.keep({&entry, 1}));
        REQUIRE(log.find(entry.key)[0] == value[0]);
    }
    flash.worn = 0;
    flash.content(1).assign(512, 0);
    flash.content(0).assign(512, 0xFF);
    SettingLog dead(flash);
    const LogEntry entry{1, value};
    CHECK_FALSE(dead.keep({&entry, 1})); // sector 0 is the first one
    CHECK(dead.find(1).empty());
}

TEST_CASE("records that an erase has left behind those of a renewal do not count", "[controller]") {
    RamFlash flash(512);
    REQUIRE(keep(flash, {{1, {1}}, {2, {2}}, {3, {3}}}));
    const Bytes old = flash.content(0);
    flash.content(0).back() = 0; // it is not written any more
    REQUIRE(keep(flash, {{1, {9}}}));
    const Model model{{1, {9}}, {2, {2}}, {3, {3}}};
    REQUIRE(read(SettingLog(flash)) == model);
    const std::size_t end = 12 + 3 * 12;
    REQUIRE(flash.content(1)[end] == 0xFF);
    std::copy_n(old.begin() + 12, 36, flash.content(1).begin() + end);
    CHECK(read(SettingLog(flash)) == model);
}
