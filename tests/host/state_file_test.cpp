// SPDX-License-Identifier: MIT
#include "host_sim/config/state_file.hpp"

#include "host_sim/base/durable_file.hpp"
#include "host_sim/live/state_keeper.hpp"
#include "refusal.hpp"
#include "support/child.hpp"
#include "temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <sys/stat.h>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

const std::vector<std::string> xyz{"x", "y", "z"};

MachineState random_state(std::mt19937_64& random) {
    std::uniform_int_distribution<std::int64_t> any(-1'000'000'000'000'000, 1'000'000'000'000'000);
    MachineState state;
    for (unsigned k = 0; k < 3; ++k) {
        for (WorkSystem& system : state.offsets.systems) {
            system.origin[k] = {any(random)};
        }
        state.offsets.g92[k] = {any(random)};
        state.offsets.tool[k] = {any(random)};
        state.offsets.g28[k] = {any(random)};
        state.offsets.g30[k] = {any(random)};
        state.position_mm[k] = static_cast<double>(any(random)) * 1e-9 / 3.0;
        if (random() % 4 == 0) {
            state.position_mm[k].reset();
            state.unknown_why = "a reason";
        }
    }
    state.offsets.systems[8].rotation_deg = {any(random) % 360'000'000'000};
    state.offsets.active = static_cast<int>(random() % work_systems);
    state.offsets.g92_applies = random() % 2 == 0;
    state.offsets.tool_number = static_cast<std::int32_t>(random() % 100);
    return state;
}

} // namespace

TEST_CASE("A state is read as it was written, to the last digit") {
    const TemporaryFolder folder;
    const std::string file = folder.file("state.json");
    CHECK_FALSE(read_state_file(file, xyz).has_value());
    std::mt19937_64 random(5); // NOLINT: the same states each time
    for (int i = 0; i < 50; ++i) {
        const MachineState state = random_state(random);
        write_state_file(file, {xyz}, state);
        const auto read = read_state_file(file, xyz);
        REQUIRE(read.has_value());
        CHECK(*read == state);
    }
}

TEST_CASE("What is no state of this machine is refused, not taken for offsets of 0") {
    const TemporaryFolder folder;
    const std::string file = folder.file("state.json");
    write_state_file(file, {xyz}, {});
    const auto refusal = [&](const std::vector<std::string>& axes) {
        return refusal_of([&] { static_cast<void>(read_state_file(file, axes)); });
    };
    CHECK(refusal(xyz) == "accepted");
    CHECK(refusal({"x", "y", "a"}).find("the state of a machine with other axes") != std::string::npos);
    for (const char* const text : {"", "{}", "[]", "{\"axes\": [\"x\",\"y\",\"z\"]}", "\0\0\0"}) {
        replace_durably(file, text);
        CHECK(refusal(xyz) != "accepted");
    }
}

TEST_CASE("A state belongs to one machine and to what moves it: a place of a simulation is none of the machine") {
    const TemporaryFolder folder;
    const std::string file = folder.file("state.json");
    const auto refusal = [&](const StateOwner& owner) {
        return refusal_of([&] { StateFile(file, owner).write({}); });
    };
    CHECK(refusal({xyz, "mill", "modbus"}) == "accepted");
    CHECK(refusal({xyz, "mill", "modbus"}) == "accepted");
    CHECK(refusal({xyz, "mill", "sim"}) ==
          file +
              ": it is the state of 'mill' on --target modbus, not of 'mill' on --target sim; give each its own file");
    CHECK(refusal({xyz, "lathe", "modbus"}).find("not of 'lathe' on --target modbus") != std::string::npos);
    CHECK(read_state_file(file, xyz).has_value()); // what only reads it may do so
    replace_durably(file, R"({"version": 1, "axes": ["x", "y", "z"]})");
    CHECK(refusal({xyz, "mill", "modbus"}).find("\"version\" is missing or wrong") != std::string::npos);
}

TEST_CASE("A state is kept by one process at a time, whatever it calls the file") {
    const TemporaryFolder folder;
    const std::string file = folder.file("state.json");
    std::filesystem::create_symlink("state.json", folder.file("link"));
    const StateFile held(folder.file("link"), {xyz});
    const int found = exit_of([&] {
        const std::string said = refusal_of([&] { StateFile(file, {xyz}).write({}); });
        _exit(said.find(" keeps its state there; end that first") != std::string::npos ? 0 : 1);
    });
    CHECK(found == 0);
    CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("A symbolic link to a state that is not there yet stays one, and so does one to a link") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("kept"));
    std::filesystem::create_symlink("kept/state.json", folder.file("near"));
    std::filesystem::create_symlink(folder.file("near"), folder.file("far"));
    for (const char* const name : {"far", "near", "far"}) {
        write_state_file(folder.file(name), {xyz}, {});
        CHECK(std::filesystem::is_symlink(folder.file("near")));
        CHECK(std::filesystem::is_symlink(folder.file("far")));
        CHECK(std::filesystem::is_regular_file(folder.file("kept/state.json")));
        std::filesystem::remove(folder.file("kept/state.json"));
    }
    std::filesystem::create_symlink("loop", folder.file("loop"));
    CHECK_THROWS(write_state_file(folder.file("loop"), {xyz}, {}));
}

TEST_CASE("A state that may be there and cannot be read is an error, and no state of 0") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& file) {
        return refusal_of([&] { static_cast<void>(read_state_file(file, xyz)); });
    };
    const std::string file = folder.file("state.json");
    write_state_file(file, {xyz}, {});
    CHECK(refusal(file + "/state.json") ==
          file + "/state.json: there is no such folder; name a file in a folder that exists");
    CHECK(refusal(folder.file("none") + "/state.json").find("/none/state.json: there is no such folder") !=
          std::string::npos);
    const std::string long_name = folder.file(std::string(300, 's'));
    CHECK(refusal(long_name).rfind(long_name + ": cannot be read: ", 0) == 0);
    CHECK(refusal(folder.file("")) ==
          folder.file("") + ": is a directory, which cannot be replaced; name a file, or one that is not there yet");
    CHECK(refusal("state_of_nobody.json") == "accepted");
}

TEST_CASE("A state is written beside nothing that is there, whoever put it there") {
    const TemporaryFolder folder;
    const std::string file = folder.file("s.json");
    const auto content = [&](const char* name) {
        std::ifstream in(folder.file(name));
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    write_state_file(file, {xyz}, {});
    std::ofstream(folder.file("victim")) << "kept";
    std::ofstream(folder.file("s.json.tmp")) << "kept, too";
    std::filesystem::create_symlink("victim", folder.file("s.json.new"));
    for (int i = 0; i < 3; ++i) {
        write_state_file(file, {xyz}, {});
    }
    CHECK(content("victim") == "kept");
    CHECK(content("s.json.tmp") == "kept, too");
    CHECK(std::filesystem::is_symlink(folder.file("s.json.new")));
    const std::filesystem::directory_iterator all(folder.file(""));
    CHECK(std::distance(begin(all), end(all)) == 4); // and nothing is left
}

TEST_CASE("A file that cannot be replaced stays as it is") {
    CHECK(refusal_of<std::runtime_error>([] {
              replace_durably("/no/such/folder/state.json", "{}");
          }).find("/no/such/folder/state.json: cannot be written: ") == 0);
}

TEST_CASE("What is no regular file is never replaced by a state, and is refused before anything moves") {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::filesystem::create_symlink("pipe", folder.file("link"));
    const std::string words = ": is a pipe, which cannot be replaced; name a file, or one that is not there yet";
    const std::string why = pipe + words;
    CHECK(refusal_of([&] { static_cast<void>(read_state_file(pipe, xyz)); }) == why);
    for (const char* const name : {"pipe", "link"}) {
        CHECK(refusal_of<std::runtime_error>([&] { write_state_file(folder.file(name), {xyz}, {}); }) == why);
        CHECK(refusal_of([&] { StateFile(folder.file(name), {xyz}).write({}); }) == folder.file(name) + words);
    }
    CHECK(std::filesystem::is_fifo(pipe));
    CHECK(std::filesystem::is_symlink(folder.file("link")));
    CHECK(folder.entries().size() == 2);
}

TEST_CASE("A run that moves nothing leaves the name of its state as it was, also a link to no file") {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("kept.json", folder.file("link"));
    for (const char* const name : {"link", "none"}) {
        const StateFile file(folder.file(name), {xyz});
        StateKeeper state(file, {});
        state.moves();
        CHECK(read_state_file(folder.file(name), xyz).has_value());
        state.ends({});
        CHECK(folder.entries() == std::vector<std::string>{"link"});
    }
    CHECK(std::filesystem::is_symlink(folder.file("link")));
}
