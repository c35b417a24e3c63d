// SPDX-License-Identifier: MIT
// Any registers at any time to the simulated drives of the shipped profiles: they take or refuse them, what is refused
// changes nothing, and their shafts stay finite and within what the time allows.
#include "fuzz/bytes.hpp"
#include "fuzz/require.hpp"
#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/profile_drive.hpp"

#include <array>
#include <cmath>

using namespace splinefeed::host;
using namespace splinefeed::hal::modbus;
using splinefeed_test::Bytes;
using splinefeed_test::require;

namespace {

const std::vector<DriveProfile>& profiles() {
    static const std::vector<DriveProfile> all = [] {
        std::vector<DriveProfile> out;
        for (const ShippedProfile& shipped : shipped_profiles()) {
            DriveProfile profile = find_profile(std::string(shipped.name));
            if (profile.stream != StreamWay::pvt && profile.stream != StreamWay::speed) {
                out.push_back(std::move(profile));
            }
        }
        return out;
    }();
    return all;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    const DriveProfile& profile = profiles()[bytes.take() % profiles().size()];
    ProfileDrive drive(profile, {});
    std::uint64_t now_us = 0;
    std::array<std::uint16_t, 130> values{};
    while (bytes.left > 0) {
        // Addresses near those that mean something.
        const RegisterField& field = profile.fields[bytes.take() % profile.fields.size()];
        const std::uint8_t what = bytes.take();
        const int address = field.address + (what % 16 == 0 ? bytes.take() % 8 - 4 : 0);
        const std::size_t count = what % 32 == 1 ? bytes.take() % values.size() : field.registers();
        switch (what >> 5U) {
        case 0:
        case 1:
        case 2:
        case 3: {
            for (std::size_t i = 0; i < count; ++i) {
                values[i] = bytes.take16();
            }
            const bool moved = drive.axis().moving();
            const bool refused = drive.write(address, std::span(values).first(count)) != ModbusException::none;
            require(!refused || drive.axis().moving() == moved);
            break;
        }
        case 4: static_cast<void>(drive.read(address, std::span(values).first(count))); break;
        case 5: drive.swap_words(); break;
        case 6:
            if (what % 8 == 0) {
                drive.power_cycle();
            }
            break;
        default: drive.advance(now_us += bytes.take16() % 20000U); break;
        }
        require(std::isfinite(drive.position_counts(0)));
    }
    return 0;
}
