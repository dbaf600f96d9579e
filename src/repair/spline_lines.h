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

[[nodiscard]] inline std::size_t spans_in(const Nurbs& spline) { return spline.points.size() - 3; }

/// How many motions these blocks are: its spans, and in linuxcnc the G1 behind them, which has no length.
[[nodiscard]] inline std::size_t motions_of_spline(const Nurbs& spline, SplineForm form) {
    return spans_in(spline) + (form == SplineForm::cubic_plane ? 1 : 0);
}

/// How many blocks spline_lines() makes. O(1).
[[nodiscard]] std::size_t blocks_of_spline(const Nurbs& spline, SplineForm form);

/// Blocks of a section before the one that its first span belongs to (docs/formats/programs.md): the points that only shape it.
[[nodiscard]] std::size_t blocks_before_spans(SplineForm form);
/// Blocks of a section behind the one that its last span belongs to: the last knots, and the one that sets the mode of lines
/// again, which is the last; 0: there is none.
[[nodiscard]] std::size_t blocks_behind_spans(SplineForm form);

}  // namespace clsurf
