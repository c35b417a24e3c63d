// SPDX-License-Identifier: MIT
// Random lines of G-code: each word of the interpreter, most of them right somewhere, some wrong everywhere.
#pragma once

#include "support/split.hpp"

#include <cstdio>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed_test {

class RandomGcode {
public:
    explicit RandomGcode(std::uint64_t seed) : generator_(seed) {}

    int integer(int least, int most) { return std::uniform_int_distribution<int>(least, most)(generator_); }

    /// ~ is a number, & a small integer, ^ one of 1 to 3.
    std::string line() {
        static const std::vector<std::string> lines = split(
            "G0 X~ Y~|G0 Z~|G1 X~ Y~ F&00|G1 Z~ A~|X~ Y~|X~|Z~|G2 X~ Y~ R3~ F&00|G3 I~ J~|G2 X~ I~ J~ P^|G3 I& Z~|J&|"
            "R&|G5 X~ Y~ I~ J~ P~ Q~|X~ Y~ P~ Q~|G5.1 X~ Y~ I~ J~|G5.2 X~ Y~ P^ L3|G5.2 X~ Y~|X~ Y~ P^|X~ Y~ P0.5|"
            "G5.3|G81 X~ Y~ Z-& R& L^ F&00|G83 X~ Z-& R& Q0.^|G73 Z-2& R~ Q&|G82 X~ Z-& R& P0.1|G85 X~ Z-5 R5|"
            "G86 X~ Z-& R& P1|G89 X~ Z-& R& P0|G84 X~ Z-& R& P0.1|G74 X~ Z-& R&|G33 Z~ K0.^|G33.1 Z-& K1 I2|G95 F0.^|"
            "G94 F&00|G7|G8|G80|M3|M4 S&00|M5|M5 S&00|S&00|F&00|F~|M7|M8|M9|T^|T^ M6|M61 Q&|G40|G41.1 D^|G42 D^|G43|"
            "G43 H^|G43.1 Z~|G49|G10 L2 P^ X~ Y~ R~|G10 L20 P^ X~ Z~|G10 L2 P0 R&0|G54|G55|G56|G59.3|G92 X~ Y~|G92.1|"
            "G92.2|G92.3|G52 X~|G28.1|G30.1|G28 Z~|G30|G53 G0 X~|G53 G1 Z~|G17|G18|G19|G20|G21|G90|G91|G90.1|G91.1|"
            "G93|G94 F&00|G93 G1 X~ F&|G98|G99|G61|G61.1|G64|G64 P0.^ Q0.^|G38.2 X~ F&0|G38.3 Z~|G38.5 Y~|M62 P^|"
            "M65 P^|M66 P^ L3 Q2|M66 E^|M48|M50 P0|G4 P^|M0|M1|M60|(MSG,hello)|#1=~|#2=[#1+~]|#<_g>=~|#<n>=#1|"
            "#5061=~|#5070=&|#5161=~|#5221=~ #5230=~|#5241=~|#5399=~|G0 X#1 Y#2|X[#1*^]|X#5061 Y#5062|G1 Z#5399|"
            "F[#<_feed>*2]|X#5420 Y#<_y>|G1 X#5070|G0 Z[#5220]|G1 X#<_g>|Y#<n>|X#5161 Y#5221");
        std::string out = filled(lines[static_cast<unsigned>(integer(0, static_cast<int>(lines.size()) - 1))]);
        for (int more = integer(0, 5); more >= 4; --more) { // words of two lines together
            out += " " + filled(lines[static_cast<unsigned>(integer(0, static_cast<int>(lines.size()) - 1))]);
        }
        return out;
    }

private:
    std::string filled(std::string_view with_marks) {
        std::string out;
        for (const char c : with_marks) {
            if (c == '~') {
                char number[20];
                std::snprintf(number, sizeof number, "%.*f", integer(0, 3), 0.001 * integer(-20000, 20000));
                // A sign of the line and one of the number are one.
                out +=
                    !out.empty() && (out.back() == '-' || (out.back() >= '0' && out.back() <= '9')) && number[0] == '-'
                        ? number + 1
                        : number;
            } else if (c == '&') {
                out += std::to_string(integer(1, 9));
            } else if (c == '^') {
                out += std::to_string(integer(1, 3));
            } else {
                out += c;
            }
        }
        return out;
    }

    std::mt19937_64 generator_;
};

} // namespace splinefeed_test
