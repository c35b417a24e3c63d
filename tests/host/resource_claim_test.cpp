// SPDX-License-Identifier: MIT
#include "host_sim/base/resource_claim.hpp"
#include "host_sim/ports/modbus/wire_claims.hpp"
#include "host_sim/ports/run_target.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace splinefeed::host;

namespace {

/// What another process says, which has no more than these file descriptors from then on.
std::string said_elsewhere(const std::function<std::string()>& say, rlim_t descriptors = 64) {
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{descriptors, descriptors};
        ::setrlimit(RLIMIT_NOFILE, &limit);
        const std::string text = say();
        ::_exit(::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0 : 1);
    }
    ::close(ends[1]);
    std::string out(4096, '\0');
    const ssize_t size = ::read(ends[0], out.data(), out.size());
    ::close(ends[0]);
    int status = 1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(status == 0);
    out.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return out;
}

std::string holder_elsewhere(const std::string& resource, rlim_t descriptors = 64) {
    return said_elsewhere([&] { return ResourceClaim(resource).holder(); }, descriptors);
}

std::string resource(const char* name) {
    return fmt::format("test {} of {}", name, ::getpid());
}

std::string refusal(const DriveAddress& address) {
    try {
        const WireClaims claims(address);
        return "taken";
    } catch (const TargetError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("what a process has claimed another one is refused, and told who has it, as long as that lives") {
    {
        const ResourceClaim first(resource("a"));
        const ResourceClaim again(resource("a")); // the same process
        CHECK(first.holder().empty());
        CHECK(again.holder().empty());
        const std::string holder = holder_elsewhere(resource("a"));
        CHECK(holder.find("host_tests") == 0);
        CHECK(holder.find(fmt::format("(process {})", ::getpid())) != std::string::npos);
        CHECK(holder_elsewhere(resource("b")).empty());
    }
    CHECK(holder_elsewhere(resource("a")).empty());
}

TEST_CASE("a claim that the system does not let us make is nobody else's") {
    const ResourceClaim first(resource("c"));
    CHECK(holder_elsewhere(resource("c"), 0).empty());
}

TEST_CASE("of long names the end counts") {
    const std::string path(200, 'x');
    const ResourceClaim first(path + "1");
    CHECK_FALSE(holder_elsewhere(path + "1").empty());
    CHECK(holder_elsewhere(path + "2").empty());
}

TEST_CASE("drives are claimed by their devices, whatever they are called, and on TCP by their units") {
    const DriveAddress local = parse_drive_address("modbus-tcp://localhost:5020?unit=1");
    const WireClaims claims(local);
    const auto elsewhere = [](const char* address) {
        return said_elsewhere([address] { return refusal(parse_drive_address(address)); });
    };
    const std::string refused = elsewhere("modbus-tcp://127.0.0.1:5020?unit=1");
    CHECK(refused.find("modbus-tcp://127.0.0.1:5020?unit=1: host_tests") == 0);
    CHECK(refused.find("uses it; end that first") != std::string::npos);
    CHECK(elsewhere("modbus-tcp://127.0.0.1:5020?unit=2") == "taken");
    CHECK(elsewhere("modbus-tcp://127.0.0.1:5021?unit=1") == "taken");
    const WireClaims line(parse_drive_address("modbus-rtu:///dev/null?unit=1")); // a serial line has one program
    CHECK(elsewhere("modbus-rtu:///dev/null?unit=2") != "taken");
}
