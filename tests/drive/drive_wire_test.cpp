// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"
#include "host_sim/drive/drive_wire.hpp"
#include "support/catch.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdint>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace splinefeed::host;

namespace {

/// What bind() or connect() to a port of this computer answers: 0 or errno. The socket is closed again.
template <class Call>
int answer(Call call, int port) {
    const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, IPPROTO_TCP);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    const int status = call(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    const int error = status == 0 ? 0 : errno;
    close(descriptor);
    return error;
}

} // namespace

TEST_CASE("a line that is down refuses connections, and its port goes to nobody else", "[drive]") {
    DriveWire line(ListenAddress{});
    const int port = line.address().port;
    REQUIRE(port > 0);
    CHECK(answer(::connect, port) == 0);
    for (int round = 0; round < 3; ++round) {
        line.disconnect();
        CHECK(answer(::connect, port) == ECONNREFUSED);
        CHECK(answer(::bind, port) == EADDRINUSE);
        line.connect();
        CHECK(line.address().port == port);
        CHECK(answer(::connect, port) == 0);
    }
}

TEST_CASE("a port is free again when its line is gone, and is not taken twice", "[drive]") {
    ListenAddress address;
    {
        const DriveWire line(address);
        address.port = line.address().port;
        CHECK_THROWS_AS(DriveWire(address), UsageError);
    }
    const DriveWire again(address);
    CHECK(answer(::connect, address.port) == 0);
}
