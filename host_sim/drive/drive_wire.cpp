// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_wire.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr int waiting_connections = 16;
constexpr std::size_t most_connections = 64;
constexpr std::size_t mbap_head = 6;               // up to its length
constexpr std::chrono::milliseconds patience{500}; // for the rest of a frame

[[noreturn]] void fail(const ListenAddress& address, const char* remedy) {
    throw UsageError("--listen {}: {}; {}", in_quotes(address.text()), modbus_strerror(errno), remedy);
}

[[noreturn]] void fail_to_listen(const ListenAddress& address) {
    fail(address, errno == EADDRNOTAVAIL ? "listen on 127.0.0.1 or on an address that this computer has"
                  : errno == EACCES ? "ports below 1024 are not open to every user; choose another, 0 for a free one"
                                    : "another program may listen there; choose another port, 0 for a free one");
}

} // namespace

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

DriveWire::DriveWire(const ListenAddress& address)
    : address_(address), context_(make_modbus_context(address)),
      reserved_(address.kind == ListenAddress::Kind::tcp ? ReservedPort(address) : ReservedPort()) {
    if (address_.kind == ListenAddress::Kind::tcp) {
        if (reserved_.none()) {
            fail_to_listen(address_);
        }
        address_.port = reserved_.port();
    }
    connect();
}

DriveWire::~DriveWire() {
    disconnect();
}

void DriveWire::connect() {
    if (address_.kind == ListenAddress::Kind::tcp) {
        listen();
        return;
    }
    if (modbus_connect(context_.get()) != 0) {
        fail(address_, "name a serial device that this user may open");
    }
    // The rest of a frame comes with the next characters, or it is broken; but a computer may be busy in between.
    modbus_set_byte_timeout(context_.get(), 0, 200000);
    listener_ = modbus_get_socket(context_.get());
}

void DriveWire::listen() {
    const ModbusContext context = make_modbus_context(address_);
    listener_ = modbus_tcp_listen(context.get(), waiting_connections);
    if (listener_ < 0) {
        fail_to_listen(address_);
    }
}

void DriveWire::close_connections() {
    for (const Connection& connection : connections_) {
        close(connection.descriptor);
    }
    connections_.clear();
}

void DriveWire::disconnect() {
    close_connections();
    readable_ = false;
    if (listener_ < 0) {
        return;
    }
    if (address_.kind == ListenAddress::Kind::tcp) {
        close(listener_);
    } else {
        modbus_close(context_.get());
    }
    listener_ = -1;
}

void DriveWire::wait(std::chrono::microseconds longest, bool deaf) {
    readable_ = false;
    std::vector<pollfd> polled;
    if (!deaf) {
        polled.push_back({listener_, POLLIN, 0});
        for (const Connection& connection : connections_) {
            polled.push_back({connection.partial ? -1 : connection.descriptor, POLLIN, 0});
        }
    }
    const timespec time{longest.count() / 1000000, longest.count() % 1000000 * 1000};
    static_cast<void>(ppoll(polled.data(), polled.size(), &time, nullptr));
    readable_ = !polled.empty() && polled.front().revents != 0;
}

std::vector<DriveWire::Request> DriveWire::receive() {
    std::vector<Request> requests;
    if (address_.kind == ListenAddress::Kind::rtu) {
        if (readable_) {
            receive_serial(requests);
        }
        return requests;
    }
    if (readable_) {
        accept_connections();
    }
    for (Connection& connection : connections_) {
        receive_from(connection, requests);
    }
    std::erase_if(connections_, [](const Connection& connection) {
        if (connection.closed) {
            close(connection.descriptor);
        }
        return connection.closed;
    });
    return requests;
}

void DriveWire::accept_connections() {
    const int descriptor = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor < 0) {
        return;
    }
    if (connections_.size() >= most_connections) {
        close(descriptor);
        return;
    }
    const int on = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    connections_.push_back({++channels_, descriptor, false, false, {}});
}

DriveWire::Frame DriveWire::peek(const Connection& connection) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> bytes{};
    const ssize_t size = recv(connection.descriptor, bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT);
    if (size < 0) {
        return errno == EAGAIN || errno == EINTR ? Frame::none : Frame::closed;
    }
    if (size == 0) {
        return Frame::closed;
    }
    const auto arrived = static_cast<std::size_t>(size);
    const std::size_t expected = mbap_head + static_cast<std::size_t>(bytes[4] << 8 | bytes[5]);
    // Where the length is nonsense libmodbus says so.
    return arrived >= mbap_head && arrived >= std::min(expected, bytes.size()) ? Frame::whole : Frame::partial;
}

void DriveWire::receive_from(Connection& connection, std::vector<Request>& requests) {
    const Clock::time_point now = Clock::now();
    const Frame frame = peek(connection);
    if (frame == Frame::partial) {
        connection.began = connection.partial ? connection.began : now;
        connection.partial = true;
        connection.closed = now - connection.began > patience;
        return;
    }
    connection.partial = false;
    connection.closed = frame == Frame::closed;
    if (frame != Frame::whole) {
        return;
    }
    Request request{connection.channel, std::vector<std::uint8_t>(MODBUS_MAX_ADU_LENGTH)};
    modbus_set_socket(context_.get(), connection.descriptor);
    modbus_set_byte_timeout(context_.get(), 0, 1000); // what it still wants will not come
    const int size = modbus_receive(context_.get(), request.bytes.data());
    modbus_set_socket(context_.get(), -1);
    if (size <= 0) {
        connection.closed = true; // there is no telling where the next frame begins
        return;
    }
    request.bytes.resize(static_cast<std::size_t>(size));
    if (is_ours(request.bytes[mbap_head])) {
        requests.push_back(std::move(request));
    }
}

// On a serial line libmodbus looks at that itself.
bool DriveWire::is_ours(int unit) const noexcept {
    constexpr int any = 0; // "the device at the address", as MODBUS_TCP_SLAVE
    return unit == address_.unit || unit == MODBUS_TCP_SLAVE || unit == any;
}

void DriveWire::receive_serial(std::vector<Request>& requests) {
    Request request{0, std::vector<std::uint8_t>(MODBUS_MAX_ADU_LENGTH)};
    const int size = modbus_receive(context_.get(), request.bytes.data());
    if (size > 0) {
        request.bytes.resize(static_cast<std::size_t>(size));
        requests.push_back(std::move(request));
    } else if (size < 0) {
        modbus_flush(context_.get());
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // a line whose other end is gone is always readable
    }
}

void DriveWire::send(int channel, const std::vector<std::uint8_t>& bytes) {
    int descriptor = address_.kind == ListenAddress::Kind::rtu ? listener_ : -1;
    for (const Connection& connection : connections_) {
        descriptor = connection.channel == channel ? connection.descriptor : descriptor;
    }
    if (descriptor < 0 || bytes.empty()) {
        return;
    }
    if (address_.kind == ListenAddress::Kind::rtu) {
        static_cast<void>(write(descriptor, bytes.data(), bytes.size()) + 1);
    } else {
        // Who does not read loses replies, and does not stop the drive.
        static_cast<void>(::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
    }
}

void DriveWire::send_all(const std::vector<std::uint8_t>& bytes) {
    if (address_.kind == ListenAddress::Kind::rtu) {
        send(0, bytes);
    }
    for (const Connection& connection : connections_) {
        send(connection.channel, bytes);
    }
}

} // namespace splinefeed::host
