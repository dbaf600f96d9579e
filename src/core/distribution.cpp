#include "core/distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/not_finite.h"

namespace clsurf {
namespace {

constexpr int digit_bits = 32;
constexpr std::uint64_t digit_mask = 0xffffffffU;
constexpr int smallest_square = -298;                  ///< power of two
constexpr std::uint32_t most_not_carried = 1U << 30U;  ///< additions that keep a digit and its carry below 2^64

// A bin has the upper eleven bits of the mantissa.
constexpr int mantissa_bits = 23, bin_bits = 11, bits_inside = mantissa_bits - bin_bits;
constexpr std::uint32_t bins_per_octave = 1U << bin_bits;

}  // namespace

SumOfSquares::SumOfSquares(const Digits& digits) { std::copy(digits.begin(), digits.end(), sums_.begin()); }

void SumOfSquares::add(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t exponent = bits >> mantissa_bits & 0xffU;
    const std::uint64_t mantissa = (bits & ((1U << mantissa_bits) - 1)) | (exponent > 0 ? 1U << mantissa_bits : 0U);
    const std::uint64_t square = mantissa * mantissa;
    const std::uint32_t power = 2 * (std::max(exponent, 1U) - 1);
    const std::size_t digit = power / digit_bits;
    const std::uint32_t shift = power % digit_bits;
    const std::uint64_t low = (square & digit_mask) << shift, high = square >> digit_bits << shift;
    sums_[digit] += low & digit_mask;
    sums_[digit + 1] += (low >> digit_bits) + (high & digit_mask);
    sums_[digit + 2] += high >> digit_bits;
    if (++not_carried_ == most_not_carried) carry();
}

void SumOfSquares::add(const SumOfSquares& other) {
    const Digits digits = other.digits();
    carry();
    for (std::size_t k = 0; k < digit_count; ++k) sums_[k] += digits[k];
    carry();
}

void SumOfSquares::carry() {
    for (std::size_t k = 0; k + 1 < digit_count; ++k) {
        sums_[k + 1] += sums_[k] >> digit_bits;
        sums_[k] &= digit_mask;
    }
    not_carried_ = 0;
}

SumOfSquares::Digits SumOfSquares::digits() const {
    SumOfSquares carried = *this;
    carried.carry();
    Digits digits{};
    std::transform(carried.sums_.begin(), carried.sums_.end(), digits.begin(),
                   [](std::uint64_t sum) { return static_cast<std::uint32_t>(sum); });
    return digits;
}

double SumOfSquares::value() const {
    const Digits all = digits();
    double sum = 0;
    for (std::size_t k = digit_count; k-- > 0;) sum = std::ldexp(sum, digit_bits) + all[k];
    return std::ldexp(sum, smallest_square);
}

Distribution::Distribution(const std::vector<Bin>& bins, const SumOfSquares& squares) : squares_(squares) {
    for (const Bin& bin : bins) {
        count_of(bin.number) += bin.count;
        count_ += bin.count;
    }
}

std::uint64_t& Distribution::count_of(std::uint32_t bin) {
    std::vector<std::uint64_t>& octave = counts_[bin >> bin_bits];
    if (octave.empty()) octave.resize(bins_per_octave);
    return octave[bin & (bins_per_octave - 1)];
}

void Distribution::add(float size) {
    ++count_of(std::bit_cast<std::uint32_t>(std::abs(size)) >> bits_inside);
    ++count_;
    squares_.add(size);
}

void Distribution::add(const Distribution& other) {
    for (const Bin& bin : other.bins()) count_of(bin.number) += bin.count;
    count_ += other.count_;
    squares_.add(other.squares_);
}

std::vector<Distribution::Bin> Distribution::bins() const {
    std::vector<Bin> bins;
    for (std::size_t octave = 0; octave < counts_.size(); ++octave) {
        for (std::size_t k = 0; k < counts_[octave].size(); ++k) {
            if (counts_[octave][k] > 0)
                bins.push_back({static_cast<std::uint32_t>((octave << bin_bits) + k), counts_[octave][k]});
        }
    }
    return bins;
}

double Distribution::quantile_below(double share) const {
    if (count_ == 0) return missing<double>;
    const auto place = static_cast<std::uint64_t>(share * static_cast<double>(count_ - 1));
    std::uint64_t below = 0;
    for (const Bin& bin : bins()) {
        below += bin.count;
        if (below > place) return std::bit_cast<float>((bin.number << bits_inside) + (1U << (bits_inside - 1)));
    }
    return missing<double>;
}

double Distribution::rms() const {
    return count_ == 0 ? missing<double> : std::sqrt(squares_.value() / static_cast<double>(count_));
}

}  // namespace clsurf
