#pragma once
// Spline lines: a cubic B-spline as the blocks that a dialect has for it (docs/formats/programs.md, Splines).

#include <array>
#include <string>
#include <vector>

#include "numeric/bezier_curve.h"
#include "program/text/text_rules.h"

namespace clsurf {

/// Format of numbers and words.
struct SplineWords {
    int decimals = 3;                                 ///< of coordinates
    std::array<std::string, 3> words{"X", "Y", "Z"};  ///< as the surrounding lines write them
    std::string straight = "G1";                      ///< restores the mode of lines; empty: this is not needed
};

/// The blocks of a spline, whose points are in the units of the program's words. Its first point is the tool position as the
/// program writes it. Planar forms assume that all points have the Z of the first one. Domain: degree 3, weights 1, a form
/// other than none.
[[nodiscard]] std::vector<std::string> spline_lines(const Nurbs& spline, SplineForm form, const SplineWords& words);

[[nodiscard]] inline std::size_t spans_in(const Nurbs& spline) { return spline.points.size() - 3; }

/// Number of motions of these blocks: the spans, and in linuxcnc the G1 after them, which has no length.
[[nodiscard]] inline std::size_t motions_of_spline(const Nurbs& spline, SplineForm form) {
    return spans_in(spline) + (form == SplineForm::cubic_plane ? 1 : 0);
}

/// Number of blocks of spline_lines(). O(1).
[[nodiscard]] std::size_t blocks_of_spline(const Nurbs& spline, SplineForm form);

/// Number of blocks of a section before the block of its first span (docs/formats/programs.md): the points that only define
/// its shape.
[[nodiscard]] std::size_t blocks_before_spans(SplineForm form);
/// Number of blocks of a section after the block of its last span: the last knots, and finally the block that restores the
/// mode of lines; 0: there is none.
[[nodiscard]] std::size_t blocks_behind_spans(SplineForm form);

}  // namespace clsurf
