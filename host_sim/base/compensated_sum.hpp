// SPDX-License-Identifier: MIT
// CompensatedSum: a sum of any number of small steps, accurate to the last digit.
#pragma once

namespace splinefeed::host {

/// Kahan's and Babuska's summation: the relative error of 10^10 steps of a millisecond is 2e-16, where plain addition
/// may lose 1e-6. Cost: four additions. @pre steps are not negative
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
