// SPDX-License-Identifier: MIT
// Says a hash for each program of the corpus in each scalar. Every build of it, for whatever processor, is to say the
// same: docs/reference/equal_bits.md.
#include "corpus.hpp"
#include "write_value.hpp"

using namespace splinefeed;

namespace bits {

template <Scalar S>
void report(const char* name, const Hash& hash, bool good) {
    write_text(std::same_as<S, Fixed> ? "Fixed " : std::same_as<S, float> ? "float " : "double ");
    write_text(name);
    write_value(good ? "" : " refused", hash.value());
}
template void report<Fixed>(const char*, const Hash&, bool);
template void report<float>(const char*, const Hash&, bool);
template void report<double>(const char*, const Hash&, bool);

namespace {

template <Scalar S>
void run() {
    run_curves<S>();
    run_splines<S>();
    run_planners<S>();
    run_programs<S>();
}

} // namespace
} // namespace bits

int main() {
    bits::run<Fixed>();
    bits::run_pulses();
    bits::run<float>();
    bits::run<double>();
    return 0;
}
