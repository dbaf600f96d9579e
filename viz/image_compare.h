#pragma once
// Comparison of two pictures for snapshots: how many values differ, and by how much.

#include <cstdint>

#include "viz/image.h"

namespace clsurf::viz {

/// A picture fails if more than `failing_share` of its values differ by more than `threshold`, or
/// one by more than three times that. Values are 0 … 1.
struct CompareRule {
    double threshold = 1.0 / 255.0;
    double failing_share = 0.0002;
};

struct Comparison {
    bool equal = false;            ///< equal within the rule
    double max_error = 0;          ///< 0 … 1
    double mean_error = 0;         ///< 0 … 1
    double psnr = 0;               ///< [dB]; infinite: identical
    double delta_e = 0;            ///< largest visible colour difference, CIE76 over 3 × 3 means
    std::int64_t pixels_over = 0;  ///< pixels with a value over the threshold
};

/// Domain: pictures of the same size.
[[nodiscard]] Comparison compare(const Image& a, const Image& b, const CompareRule& rule);

/// Gives both pictures the same pixels in all areas with words or numbers. Domain: pictures of the same size.
void blank_texts(Image& a, Image& b);

/// The first picture in pale grey, with differences from yellow (small) to red, and a strip below that explains the
/// colours. Throws SystemError.
[[nodiscard]] Image difference_picture(const Image& a, const Image& b);

}  // namespace clsurf::viz
