// SPDX-License-Identifier: MIT
#include "host_sim/drive/reserved_port.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdint>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace splinefeed::host {

ReservedPort::ReservedPort(const ListenAddress& address)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, IPPROTO_TCP)) {
    sockaddr_in bound{};
    bound.sin_family = AF_INET;
    bound.sin_port = htons(static_cast<std::uint16_t>(address.port));
    inet_pton(AF_INET, address.host.c_str(), &bound.sin_addr);
    socklen_t size = sizeof(bound);
    const int on = 1;
    if (socket_ >= 0 && setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) == 0 &&
        bind(socket_, reinterpret_cast<const sockaddr*>(&bound), size) == 0 &&
        getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size) == 0) {
        port_ = ntohs(bound.sin_port);
        return;
    }
    const int error = errno;
    if (socket_ >= 0) {
        close(socket_);
    }
    socket_ = -1;
    errno = error;
}

ReservedPort::~ReservedPort() {
    if (!none()) {
        close(socket_);
    }
}

} // namespace splinefeed::host
