#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace jostle {

/// The sum of numbers, exact and rounded once: the same bits in whatever order they are added, by whatever threads.
///
/// The sum is held as an integer in units of 2^-1074, the smallest double, in digits of 32 bits; a number touches three
/// of them (R. Neal, arXiv:1505.05571, "small superaccumulator"). Batches are first summed in floating point, in parts
/// whose sums are exact (J. Demmel, H. D. Nguyen, IEEE Trans. Comput. 64, 2060 (2015)). A sum of infinities and nan is
/// one of these, too.
class ExactSum {
public:
    void add(double number) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7FF);
        std::uint64_t mantissa = bits & 0xF'FFFF'FFFF'FFFF;
        if (exponent == 0x7FF) {
            not_finite_ += number;
            return;
        }
        if (exponent > 0) mantissa |= std::uint64_t{1} << 52;
        if (mantissa == 0) return;
        const unsigned shift = exponent > 0 ? exponent - 1 : 0;
        const unsigned first = shift / 32, within = shift % 32;
        // A negative mantissa as the complement: (m ^ -1) + 1, done to each part.
        const auto sign = static_cast<std::int64_t>(bits) >> 63;
        const auto part = [sign](std::uint64_t value) { return (static_cast<std::int64_t>(value) ^ sign) - sign; };
        digit_[first] += part((mantissa << within) & 0xFFFF'FFFF);
        digit_[first + 1] += part((mantissa >> (32 - within)) & 0xFFFF'FFFF);
        digit_[first + 2] += part(mantissa >> 32 >> (32 - within));
        begin_ = std::min(begin_, first);
        end_ = std::max(end_, first + 3);
        if (++terms_ == max_terms) carry();
    }

    static constexpr std::size_t batch = 128;
    /// Adds up to `batch` numbers: the same as one by one, and several times as fast if they are many.
    void add_all(std::span<const double> numbers);

    ExactSum& operator+=(const ExactSum& other) {
        if (terms_ + other.terms_ >= max_terms) carry();
        for (unsigned k = other.begin_; k < other.end_; ++k) digit_[k] += other.digit_[k];
        begin_ = std::min(begin_, other.begin_);
        end_ = std::max(end_, other.end_);
        terms_ += other.terms_;
        not_finite_ += other.not_finite_;
        return *this;
    }

    static constexpr unsigned digits = 68;  // 2046 positions and a mantissa, and room above

    /// As whole numbers: those of several sums, up to 2^30 of them, added one by one are those of all together.
    static constexpr std::size_t words = digits + 3;
    std::array<std::int64_t, words> in_words() const;
    static ExactSum of_words(std::span<const std::int64_t, words> numbers);

    /// Rounded to the nearest double.
    double value() const {
        if (not_finite_ != 0.0) return not_finite_;  // nan is not 0 either
        ExactSum sum = *this;
        sum.carry();
        const bool negative = sum.end_ > 0 && sum.digit_[sum.end_ - 1] < 0;
        if (negative) {
            for (unsigned k = sum.begin_; k < sum.end_; ++k) sum.digit_[k] = -sum.digit_[k];
            sum.carry();
        }
        unsigned top = sum.end_;
        while (top > sum.begin_ && sum.digit_[top - 1] == 0) --top;
        if (top <= sum.begin_) return 0.0;
        // 64 bits from the first that is set, and whether any lower one is: enough to round to 53.
        const auto digit = [&](unsigned below) {
            return top > below && top - 1 - below >= sum.begin_
                       ? static_cast<std::uint64_t>(sum.digit_[top - 1 - below])
                       : 0;
        };
        const int zeros = std::countl_zero(static_cast<std::uint32_t>(digit(0)));
        std::uint64_t leading = digit(0) << 32 | digit(1);
        std::uint64_t rest = digit(2);
        if (zeros > 0) {
            leading = leading << zeros | rest >> (32 - zeros);
            rest = rest << zeros & 0xFFFF'FFFF;
        }
        for (unsigned below = 3; rest == 0 && below < top; ++below) rest = digit(below);
        if (rest != 0) leading |= 1;
        const double magnitude =
            std::ldexp(static_cast<double>(leading), 32 * (static_cast<int>(top) - 2) - zeros - 1074);
        return negative ? -magnitude : magnitude;
    }

private:
    static constexpr std::uint64_t max_terms = std::uint64_t{1} << 30;  // of less than 2^32 each, in 63 bits

    /// Leaves digits of 0 to 2^32 - 1, but for the last, which has the sign.
    void carry() {
        terms_ = 1;
        if (begin_ >= end_) return;
        const auto take_over = [this](unsigned k) {
            const std::int64_t over = digit_[k] >> 32;
            digit_[k] -= over * (std::int64_t{1} << 32);
            return over;
        };
        for (unsigned k = begin_; k + 1 < end_; ++k) digit_[k + 1] += take_over(k);
        const std::int64_t beyond = digit_[end_ - 1] >> 32;
        if (beyond == 0 || beyond == -1) return;
        digit_[end_] = take_over(end_ - 1);
        ++end_;
    }

    std::array<std::int64_t, digits> digit_{};
    unsigned begin_ = digits, end_ = 0;  ///< digits that may not be 0
    std::uint64_t terms_ = 0;
    double not_finite_ = 0.0;
};

}  // namespace jostle
