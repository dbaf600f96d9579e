#pragma once
// Distribution: counts of magnitudes in narrow bins, and the exact sum of their squares. Distributions of parts of the data
// can be added in any order with the same result.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace clsurf {

/// The exact sum of squares of floats: the order of the additions does not matter.
class SumOfSquares {
public:
    static constexpr std::size_t digit_count = 20;
    /// The sum divided by 2^−298 (the square of the smallest float), as digits of 32 bits, lowest first.
    using Digits = std::array<std::uint32_t, digit_count>;

    SumOfSquares() = default;
    explicit SumOfSquares(const Digits& digits);
    /// Domain: finite.
    void add(float value);
    void add(const SumOfSquares& other);
    [[nodiscard]] Digits digits() const;
    /// Rounded; the relative error is below 10⁻¹⁵.
    [[nodiscard]] double value() const;

private:
    void carry();

    std::array<std::uint64_t, digit_count> sums_{};  ///< sums of digits; the bits above 32 are not carried yet
    std::uint32_t not_carried_ = 0;                  ///< values added since the last carry
};

class Distribution {
public:
    /// Larger magnitudes have larger bin numbers. Each power of two has 2048 bins.
    struct Bin {
        std::uint32_t number = 0;
        std::uint64_t count = 0;
        friend bool operator==(const Bin&, const Bin&) = default;
    };
    /// Greatest relative error of a quantile.
    static constexpr double quantile_error = 1.0 / 4096;
    static constexpr std::uint32_t bin_count = 0x7f800000U >> 12;

    Distribution() = default;
    /// Domain: numbers below bin_count.
    Distribution(const std::vector<Bin>& bins, const SumOfSquares& squares);
    /// Domain: finite, no less than 0.
    void add(float size);
    void add(const Distribution& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// Bins that are not empty, in order.
    [[nodiscard]] std::vector<Bin> bins() const;
    [[nodiscard]] const SumOfSquares& squares() const { return squares_; }
    /// quantile_below() of the sizes (core/statistics.h), within quantile_error; NaN if there are none.
    [[nodiscard]] double quantile_below(double share) const;
    /// NaN if there are none.
    [[nodiscard]] double rms() const;

private:
    [[nodiscard]] std::uint64_t& count_of(std::uint32_t bin);

    /// By power of two; empty if there are no sizes.
    std::array<std::vector<std::uint64_t>, 256> counts_;
    std::uint64_t count_ = 0;
    SumOfSquares squares_;
};

}  // namespace clsurf
