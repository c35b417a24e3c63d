// SPDX-License-Identifier: MIT
#include "host_sim/drive/listen_address.hpp"

#include "host_sim/base/address_text.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/config/baud_rate.hpp"

#include <arpa/inet.h>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::array<std::string_view, 5> keys{"baud", "parity", "stop", "unit", "pace"};

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    throw UsageError("--listen {}: {}", in_quotes(text), why);
}

int number(std::string_view text, std::string_view what, std::string_view digits, int low, int high) {
    const auto value = read_whole(digits, low, high);
    if (!value) {
        refuse(text, fmt::format("{} must be a whole number from {} to {}", what, low, high));
    }
    return *value;
}

void take_key(std::string_view text, std::string_view key, std::string_view value, ListenAddress& out) {
    const auto choice = [&](std::string_view a, std::string_view b) {
        if (value != a && value != b) {
            refuse(text, fmt::format("{} must be {} or {}", key, a, b));
        }
        return value == a;
    };
    if (key == "baud") {
        out.baud = number(text, key, value, baud_rates.front(), baud_rates.back());
        if (!is_baud_rate(out.baud)) {
            refuse(text, fmt::format("baud must be one of {}", fmt::join(baud_rates, ", ")));
        }
    } else if (key == "parity") {
        if (value != "N" && value != "E" && value != "O") {
            refuse(text, "parity must be N, E or O");
        }
        out.parity = value.front();
    } else if (key == "stop") {
        out.stop_bits = choice("1", "2") ? 1 : 2;
    } else if (key == "unit") {
        out.unit = number(text, key, value, 1, 247);
    } else if (key == "pace") {
        out.pace = choice("on", "off");
    } else {
        refuse(text, fmt::format("there is no setting {}{}", in_quotes(key), suggestion(key, keys)));
    }
}

ListenAddress parse_tcp(std::string_view text, const AddressText& parts, bool allow_remote) {
    ListenAddress out;
    const std::string_view rest = parts.place;
    const std::size_t colon = rest.rfind(':');
    if (colon == std::string_view::npos) {
        refuse(text, "a port must follow the host, like tcp://127.0.0.1:1502; 0 is a free one");
    }
    out.port = number(text, "the port", rest.substr(colon + 1), 0, 65535);
    out.host = rest.substr(0, colon) == "localhost" ? "127.0.0.1" : std::string(rest.substr(0, colon));
    in_addr address{};
    if (inet_pton(AF_INET, out.host.c_str(), &address) != 1) {
        refuse(text, "the host must be localhost or four numbers like 127.0.0.1");
    }
    constexpr std::uint32_t loopback = 127;
    if (ntohl(address.s_addr) >> 24U != loopback && !allow_remote) {
        refuse(text,
               "others than this computer could move the drive there; listen on 127.0.0.1, or add --allow-remote");
    }
    for (const AddressText::Setting& setting : parts.settings) {
        if (setting.key != "unit") {
            refuse(text, fmt::format("there is no setting {} on tcp; unit alone", in_quotes(setting.key)));
        }
        take_key(text, setting.key, setting.value, out);
    }
    return out;
}

ListenAddress parse_rtu(std::string_view text, const AddressText& parts) {
    ListenAddress out;
    out.kind = ListenAddress::Kind::rtu;
    out.device = std::string(parts.place);
    if (out.device.size() < 2 || out.device.front() != '/') {
        refuse(text, "the device must be an absolute path, like rtu:///dev/ttyUSB0?baud=115200");
    }
    for (const AddressText::Setting& setting : parts.settings) {
        if (setting.value.empty()) {
            refuse(text, fmt::format("{} needs a value, like baud=115200", in_quotes(setting.text)));
        }
        take_key(text, setting.key, setting.value, out);
    }
    return out;
}

} // namespace

ListenAddress parse_listen_address(std::string_view text, bool allow_remote) {
    const AddressText parts = split_address(text);
    if (parts.scheme == "tcp") {
        return parse_tcp(text, parts, allow_remote);
    }
    if (parts.scheme == "rtu") {
        return parse_rtu(text, parts);
    }
    refuse(text, "it must be like tcp://127.0.0.1:1502 or rtu:///dev/ttyUSB0?baud=115200");
}

std::string ListenAddress::text() const {
    if (kind == Kind::tcp) {
        return fmt::format("tcp://{}:{}{}", host, port, unit == 1 ? "" : fmt::format("?unit={}", unit));
    }
    const std::string stop = stop_bits != 0 ? fmt::format("&stop={}", stop_bits) : "";
    return fmt::format("rtu://{}?baud={}&parity={}{}&unit={}{}", device, baud, parity, stop, unit,
                       pace ? "" : "&pace=off");
}

double ListenAddress::character_us() const noexcept {
    const int bits = 1 + 8 + (parity == 'N' ? 0 : 1) + stops();
    return 1e6 * bits / baud;
}

} // namespace splinefeed::host
