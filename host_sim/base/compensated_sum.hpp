// SPDX-License-Identifier: MIT
// CompensatedSum: a sum of any number of small steps that is as good as its last digit.
#pragma once

namespace splinefeed::host {

/// Kahan's and Babuska's summation: 10^10 steps of a millisecond are off by 2e-16 of their sum, where plain addition
/// may lose 1e-6 of it. Cost: four additions. @pre steps are not negative
class CompensatedSum {
public:
    explicit CompensatedSum(double start = 0.0) noexcept : sum_(start) {}

    CompensatedSum& operator+=(double step) noexcept {
        const double sum = sum_ + step;
        lost_ += sum_ >= step ? (sum_ - sum) + step : (step - sum) + sum_;
        sum_ = sum;
        return *this;
    }
    [[nodiscard]] double value() const noexcept { return sum_ + lost_; }

private:
    double sum_;
    double lost_ = 0.0;
};

} // namespace splinefeed::host
