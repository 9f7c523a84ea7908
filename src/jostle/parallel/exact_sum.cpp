#include "jostle/parallel/exact_sum.hpp"

#include <limits>

#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

constexpr std::size_t lanes = 8;
using Lanes = std::array<double, lanes>;

double sum_of(const Lanes& numbers) {
    double sum = 0.0;
    for (const double one : numbers) sum += one;
    return sum;
}

JOSTLE_VECTORISED double largest_magnitude(const double* numbers) {
    Lanes largest{};
    for (std::size_t k = 0; k < ExactSum::batch; k += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double magnitude = std::fabs(numbers[k + lane]);
            largest[lane] = magnitude <= largest[lane] ? largest[lane] : magnitude;
        }
    double all = 0.0;
    for (const double one : largest) all = one <= all ? all : one;
    return all;
}

/// A batch as multiples of two units, whose sums are exact, and what is left of each number.
struct Parts {
    double coarse = 0.0, fine = 0.0;
    bool something_left = false;
};

/// (x + shift) - shift is x rounded to a multiple of the unit in the last place of `shift`, and what is left is exact.
/// Of the multiples a batch's sum is exact, too, for it stays below 2^53 units. `left` may be `numbers`.
JOSTLE_VECTORISED void split(const double* numbers, double coarse_shift, double fine_shift, double* left,
                             Parts& parts) {
    Lanes coarse{}, fine{}, any_left{};
    for (std::size_t k = 0; k < ExactSum::batch; k += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            double x = numbers[k + lane];
            double multiple = (x + coarse_shift) - coarse_shift;
            coarse[lane] += multiple;
            x -= multiple;
            multiple = (x + fine_shift) - fine_shift;
            fine[lane] += multiple;
            x -= multiple;
            left[k + lane] = x;
            any_left[lane] += std::fabs(x);
        }
    parts = {sum_of(coarse), sum_of(fine), sum_of(any_left) != 0.0};
}

}  // namespace

void ExactSum::add_all(std::span<const double> numbers) {
    constexpr std::size_t many = 32;
    std::array<double, batch> padded;
    const auto one_by_one = [&] {
        for (const double number : numbers) add(number);
    };
    if (numbers.size() < many) return one_by_one();
    const double* all = numbers.data();
    if (numbers.size() < batch) {
        std::copy(numbers.begin(), numbers.end(), padded.begin());
        std::fill(padded.begin() + static_cast<std::ptrdiff_t>(numbers.size()), padded.end(), 0.0);
        all = padded.data();
    }
    const double largest = largest_magnitude(all);
    if (largest == 0.0) return;
    if (!(largest < 1e250 && largest > 1e-200)) return one_by_one();  // shifts would leave the range of doubles
    int exponent = 0;                                                 // largest < 2^exponent
    std::frexp(largest, &exponent);
    constexpr int width = std::bit_width(batch), bits = 52;
    // Multiples of 2^(exponent + width - 52), each at most 2^exponent: a batch stays below 2^52 of them. What is left
    // is at most half a unit, and so on. Two units hold numbers that differ by less than 2^30 in size, four nearly all.
    const auto shift = [&](int level) { return std::ldexp(1.5, exponent + width - level * (bits - width)); };
    std::array<double, batch> left;
    for (int level = 0; level < 4; level += 2) {
        Parts parts;
        split(all, shift(level), shift(level + 1), left.data(), parts);
        add(parts.coarse);
        add(parts.fine);
        if (!parts.something_left) return;
        all = left.data();
    }
    for (const double one : left) add(one);
}

std::array<std::int64_t, ExactSum::words> ExactSum::in_words() const {
    ExactSum sum = *this;
    sum.carry();
    std::array<std::int64_t, words> numbers{};
    std::copy(sum.digit_.begin(), sum.digit_.end(), numbers.begin());
    numbers[digits] = std::isnan(not_finite_) ? 1 : 0;
    numbers[digits + 1] = not_finite_ > 0.0 ? 1 : 0;
    numbers[digits + 2] = not_finite_ < 0.0 ? 1 : 0;
    return numbers;
}

ExactSum ExactSum::of_words(std::span<const std::int64_t, words> numbers) {
    ExactSum sum;
    for (unsigned k = 0; k < digits; ++k) {
        sum.digit_[k] = numbers[k];
        if (numbers[k] == 0) continue;
        sum.begin_ = std::min(sum.begin_, k);
        sum.end_ = k + 1;
    }
    sum.carry();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (numbers[digits] > 0) sum.not_finite_ = std::numeric_limits<double>::quiet_NaN();
    if (numbers[digits + 1] > 0) sum.not_finite_ += infinity;
    if (numbers[digits + 2] > 0) sum.not_finite_ -= infinity;
    return sum;
}

}  // namespace jostle
