#pragma once
// Blocks of splines: G5, G5.1, G5.2, G6.2, ASPLINE, BSPLINE, CSPLINE, POLY.

#include "core/geometry.h"
#include "core/point.h"
#include "numeric/bezier_curve.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Refuses words that a spline cannot have, and modes in which there can be no spline.
void refuse_with_spline(Interpreter& in, const Block& block);
/// A span that begins at the current position, in the work system.
void push_curve(Interpreter& in, BezierCurve curve, LineNumber line, double feed);
/// A block of G5 or G5.1.
void plane_spline(Interpreter& in, const Block& block);
/// A point of G5.2 with its weight. The first one is the current position; its weight is the P of a block without X
/// and Y.
void nurbs_point(Interpreter& in, const Block& block);
/// G5.3: the spline of G5.2 ends.
void nurbs_end(Interpreter& in);
/// A block of G6.2: a point with weight R and knot K; after the last point as many blocks with K alone as the order.
void knotted_point(Interpreter& in, const Block& block);
/// A block of ASPLINE, BSPLINE and CSPLINE.
void spline_point(Interpreter& in, const Block& block);
/// Ends the open spline. `end_tangent`: the direction of the next motion; NaN if there is none.
void close_spline(Interpreter& in, const Vec3& end_tangent);
/// The same before a straight motion to `next`.
void close_spline_before(Interpreter& in, const Vec3& next);
/// Refuses a block in another mode inside a spline that has an end code of its own.
void settle_spline(Interpreter& in, const Block& block);
/// POLY: Σ aᵢ pⁱ over p from 0 to PL, for each axis; a₀ is the current position, a₁ follows from the end. PO[] is a
/// common denominator with b₀ = 1, given in the same form. An axis without PO moves linearly in p.
void polynomial_span(Interpreter& in, const Block& block);

}  // namespace clsurf
