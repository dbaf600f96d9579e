#pragma once
// Spline lines: a cubic B-spline as the blocks that a dialect has for it (docs/formats/programs.md, Splines).

#include <array>
#include <string>
#include <vector>

#include "numeric/bezier_curve.h"
#include "program/text/text_rules.h"

namespace clsurf {

/// How numbers and words are written.
struct SplineWords {
    int decimals = 3;                                 ///< of coordinates
    std::array<std::string, 3> words{"X", "Y", "Z"};  ///< as the lines around write them
    std::string straight = "G1";                      ///< sets the mode of lines again; empty: it need not be set
};

/// The blocks of a spline, whose points are counted as the words of the program are. Its first point is where the tool
/// stands, as the program writes it. Planar forms take no point off the first one's Z. Domain: degree 3, weights 1, a
/// form that is not none.
[[nodiscard]] std::vector<std::string> spline_lines(const Nurbs& spline, SplineForm form, const SplineWords& words);

/// How many motions these blocks are: its spans.
[[nodiscard]] inline std::size_t spans_in(const Nurbs& spline) { return spline.points.size() - 3; }

/// How many blocks spline_lines() makes. O(1).
[[nodiscard]] std::size_t blocks_of_spline(const Nurbs& spline, SplineForm form);

}  // namespace clsurf
