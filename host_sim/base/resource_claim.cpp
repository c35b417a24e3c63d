// SPDX-License-Identifier: MIT
#include "host_sim/base/resource_claim.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fmt/format.h>
#include <fstream>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

struct SocketName {
    sockaddr_un address{};
    socklen_t size = 0;
};

// In Linux's abstract name space. Of a long name the end counts: it is what differs.
SocketName name_of(const std::string& resource) {
    SocketName out;
    const std::string whole = "splinefeed/" + resource;
    const std::string name = whole.substr(whole.size() - std::min(whole.size(), sizeof out.address.sun_path - 1));
    out.address.sun_family = AF_UNIX;
    std::ranges::copy(name, out.address.sun_path + 1);
    out.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    return out;
}

// "splinefeed serve", of what the process was started with.
std::string command_of(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/cmdline", process), std::ios::binary);
    std::string program;
    std::string command;
    std::getline(file, program, '\0');
    std::getline(file, command, '\0');
    program = program.substr(program.rfind('/') + 1);
    return program.empty() ? "another program" : command.empty() ? program : program + " " + command;
}

std::string holder_of(const SocketName& name) {
    const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    ucred peer{};
    socklen_t size = sizeof peer;
    const bool found = ::connect(client, reinterpret_cast<const sockaddr*>(&name.address), name.size) == 0 &&
                       ::getsockopt(client, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
    ::close(client);
    if (!found) {
        return "another program";
    }
    return peer.pid == ::getpid() ? std::string() : fmt::format("{} (process {})", command_of(peer.pid), peer.pid);
}

} // namespace

ResourceClaim::ResourceClaim(const std::string& resource)
    : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    const SocketName name = name_of(resource);
    const bool bound = ::bind(socket_, reinterpret_cast<const sockaddr*>(&name.address), name.size) == 0;
    if (bound) {
        static_cast<void>(::listen(socket_, SOMAXCONN)); // so that others learn who has it; nobody answers them
    } else if (errno == EADDRINUSE) {
        holder_ = holder_of(name);
    }
}

ResourceClaim::~ResourceClaim() {
    ::close(socket_);
}

} // namespace splinefeed::host
