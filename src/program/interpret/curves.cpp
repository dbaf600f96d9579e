// Blocks of splines: G5, G5.1, G5.2, G6.2, ASPLINE, BSPLINE, CSPLINE, POLY. Each span becomes a motion that owns its
// curve (docs/formats/programs.md says what is assumed where manuals leave it open).

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "numeric/point_spline.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr std::uint32_t turning_axes = Words::bit('A') | Words::bit('B') | Words::bit('C');
constexpr int least_uniform_order = 3;  ///< LinuxCNC reads a smaller L as 3
constexpr int most_order = 20;
constexpr double no_chord = 1e-9;         ///< [mm] nearer points are one
constexpr double start_play_steps = 1.5;  ///< increments, between the tool and the first point of a spline
constexpr double same_knot = 1e-12;       ///< of the range of knots
constexpr int denominator_places = 64;
constexpr int most_polynomial = 5;  ///< degree

double polynomial_value(const std::vector<double>& coefficients, double p) {
    double value = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) value = value * p + coefficients[k];
    return value;
}

/// All coefficients of a polynomial that begins and ends with these values; `values`: the end, a₂, a₃ … as written.
std::vector<double> coefficients_to(double end, const std::vector<double>& values, double begin, double unit,
                                    double interval) {
    std::vector<double> a{begin, 0.0};
    for (std::size_t k = 1; k < values.size(); ++k) a.push_back(values[k] * unit);
    a[1] = (end - polynomial_value(a, interval)) / interval;
    return a;
}

/// The spline whose points are the blocks of that mode; none: they are no points.
SplineKind kind_of_points(MotionMode mode) {
    switch (mode) {
        case MotionMode::akima_spline: return SplineKind::akima;
        case MotionMode::basis_spline: return SplineKind::basis;
        case MotionMode::point_spline: return SplineKind::cubic;
        default: return SplineKind::none;
    }
}

/// A line times a denominator, so that the quotient is the line.
std::vector<double> line_over(const std::vector<double>& denominator, double begin, double slope) {
    std::vector<double> a(denominator.size() + 1, 0.0);
    for (std::size_t k = 0; k < denominator.size(); ++k) {
        a[k] += begin * denominator[k];
        a[k + 1] += slope * denominator[k];
    }
    if (slope == 0) a.pop_back();
    return a;
}

bool stays_positive(const std::vector<double>& denominator, double interval) {
    for (int k = 0; k <= denominator_places; ++k) {
        if (!(polynomial_value(denominator, interval * k / denominator_places) > 0)) return false;
    }
    return true;
}

}  // namespace

/// What no spline here moves, and where none may stand.
void Interpreter::refuse_beside_spline(const Block& block) {
    if (compensation_.path.on()) fail("a spline under cutter compensation is not supported");
    if (take_tool_axis(block)) fail("a spline with a tool axis as a vector is not supported");
    if ((block.words.has & turning_axes) == 0) return;
    if (rotary_target(block) != state_.rotary)
        fail("a spline moves X, Y and Z: rotary axes that turn along it are not supported");
}

/// A span that begins where the tool stands, in the work system.
void Interpreter::push_curve(BezierCurve curve, LineNumber line, double feed) {
    if (curves_.is_open()) close_spline(curve.tangent(0));
    const LineNumber here = std::exchange(place_.line, line);
    const double feed_here = std::exchange(state_.feed, feed);
    const Vec3 end = curve.at(1);
    const float along = feed_for(curve.length());
    const std::int64_t motion = program_.motions.size();
    program_.motions.curves.push_back({motion, std::make_shared<const BezierCurve>(std::move(curve))});
    push(MotionKind::spline, end, state_.rotary, along);
    place_.line = here;
    state_.feed = feed_here;
}

void Interpreter::spline(const Block& block) {
    if (state_.plane_axis != 2) fail("G5 and G5.1 need the XY plane (G17)");
    refuse_beside_spline(block);
    const double unit = state_.unit_mm;
    const Vec3 from = state_.position;
    const Vec3 to = target(block, false);
    if (to.z() != from.z() && !std::isnan(from.z())) fail("a spline (G5, G5.1) moves only X and Y");
    const auto words = [&](char u, char v) {
        const auto word = [&](char letter) { return block.words.given(letter) ? block.words.of(letter) * unit : 0.0; };
        return Vec3(word(u), word(v), 0);
    };
    if (state_.motion == MotionMode::quadratic_spline) {
        if (!block.words.given('I') && !block.words.given('J')) fail("G5.1 needs I or J");
        const std::array<Vec3, 3> control{from, from + words('I', 'J'), to};
        push_curve(BezierCurve(control), place_.line, state_.feed);
        return;
    }
    const bool first = block.words.given('I') || block.words.given('J');
    if (!block.words.given('P') || !block.words.given('Q')) fail("G5 needs P and Q");
    if (first && !(block.words.given('I') && block.words.given('J'))) fail("G5 needs both I and J, or neither");
    if (!first && curves_.spline_out.isZero()) fail("the first G5 needs I and J");
    const Vec3 out = first ? words('I', 'J') : Vec3(-curves_.spline_out.x(), -curves_.spline_out.y(), 0);
    const Vec3 in = words('P', 'Q');
    curves_.spline_out = in.head<2>();
    const std::array<Vec3, 4> control{from, from + out, to + in, to};
    push_curve(BezierCurve(control), place_.line, state_.feed);
}

void Interpreter::begin_spline(SplineKind kind) {
    if (curves_.is_open()) close_spline(Vec3::Constant(missing<double>));
    curves_.open.kind = kind;
    curves_.open.begin = curves_.begin;
    curves_.open.end = curves_.end;
    curves_.open.points.push_back({state_.position, 1, missing<double>, place_.line, state_.feed});
    // The direction in which the motion before ends.
    Vec3 tangent = Vec3::Zero();
    for (std::int64_t i = program_.motions.size(); i-- > 0 && tangent.isZero(0);) tangent = tangent_at_end(i);
    if (tangent.isZero(0) && !forgotten_tangents_.empty()) tangent = forgotten_tangents_.front();
    if (tangent.allFinite() && tangent.norm() > no_chord) curves_.open.begin_tangent = tangent.normalized();
}

/// The tool stands there for what is read next, although the motion is pushed later.
void Interpreter::add_spline_point(const Vec3& at, double weight, double knot) {
    curves_.open.points.push_back({at, weight, knot, place_.line, state_.feed});
    state_.position = at;
}

/// A point of G5.2 with its weight. The first one is where the tool stands; its weight is the P of a block
/// without X and Y.
void Interpreter::nurbs_point(const Block& block) {
    const Words& w = block.words;
    if (state_.plane_axis != 2) fail("G5.2 needs the XY plane (G17)");
    if (w.given('X') != w.given('Y')) fail("a point of G5.2 needs both X and Y");
    if (w.given('Z') || (w.has & turning_axes) != 0) fail("a spline (G5.2) moves only X and Y");
    refuse_beside_spline(block);
    const bool is_point = w.given('X');
    const double weight = w.given('P') ? w.of('P') : 1.0;
    if (!(weight > 0)) fail("a weight (P) must be greater than 0");
    if (!curves_.is_open()) {
        begin_spline(SplineKind::uniform);
        curves_.open.degree = least_uniform_order - 1;
        if (!is_point) curves_.open.points.front().weight = weight;
    } else if (!is_point && w.given('P')) {
        fail("P without X and Y is the weight of the first point only", w.column['P' - 'A']);
    }
    if (w.given('L')) {
        const double order = std::max(w.of('L'), double(least_uniform_order));
        if (order > most_order) fail(fmt::format("the order of a spline (L) is at most {}", most_order));
        curves_.open.degree = static_cast<int>(order) - 1;
    }
    if (is_point) add_spline_point(target(block, false), weight, missing<double>);
}

void Interpreter::nurbs_end() {
    const int order = curves_.open.degree + 1;
    const auto count = static_cast<int>(curves_.open.points.size());
    if (curves_.open.kind != SplineKind::uniform) fail("G5.3 without G5.2 before it");
    if (count < order) fail(fmt::format("a spline of order {} needs {} points, it has {}", order, order, count));
    const std::vector<double> intervals(static_cast<std::size_t>(count - order + 1), 1.0);
    finish_nurbs(clamped_knots(curves_.open.degree, intervals));
    state_.motion = MotionMode::none;
}

/// A block of G6.2: a point with weight R and knot K; behind the last point as many blocks with K alone as the order.
void Interpreter::knotted_point(const Block& block) {
    const Words& w = block.words;
    const bool is_point = (w.has & Words::xyz) != 0;
    refuse_beside_spline(block);
    OpenSpline& open = curves_.open;
    const bool first = !curves_.is_open();
    if (first) {
        if (!is_point && !w.given('K')) return;
        const Vec3 start = state_.position;
        const Vec3 given = target(block, false);
        const Vec3 off = given - start;
        for (int axis = 0; axis < 3; ++axis) {
            if (!w.given("XYZ"[axis])) continue;
            if (!(std::abs(off[axis]) <= start_play_steps * state_.least_increment() * state_.unit_mm))
                fail("a spline (G6.2) begins where the tool is, but its first point is another one",
                     w.column[static_cast<std::size_t>("XYZ"[axis] - 'A')]);
        }
        begin_spline(SplineKind::knotted);
        const double order = w.given('P') ? w.of('P') : 4;
        if (!(order >= 2 && order <= most_order) || order != std::round(order))
            fail(fmt::format("the order of a spline (P) is a whole number, 2 … {}", most_order), w.column['P' - 'A']);
        open.degree = static_cast<int>(order) - 1;
        open.points.front().weight = w.given('R') ? w.of('R') : 1.0;
        open.points.front().knot = w.given('K') ? w.of('K') : missing<double>;
    }
    if (!first && !w.given('K')) {
        if (is_point) fail("a point of a spline (G6.2) needs its knot (K)");
        return;
    }
    const double weight = w.given('R') ? w.of('R') : 1.0;
    if (!(weight > 0)) fail("a weight (R) must be greater than 0");
    if (first) return;
    // A first block without K has the knot of the second.
    if (std::isnan(open.points.front().knot)) open.points.front().knot = w.of('K');
    const double before = open.last_knots.empty() ? open.points.back().knot : open.last_knots.back();
    if (!(w.of('K') >= before)) {
        fail(fmt::format("knots of a spline (K) may not fall: {} after {}", w.of('K'), before), w.column['K' - 'A']);
    }
    if (is_point) {
        if (!open.last_knots.empty()) fail("a point after the last knots of a spline (G6.2)");
        add_spline_point(target(block, false), weight, w.of('K'));
        return;
    }
    open.last_knots.push_back(w.of('K'));
    if (static_cast<int>(open.last_knots.size()) == open.degree + 1) finish_knotted();
}

void Interpreter::finish_knotted() {
    const OpenSpline& open = curves_.open;
    const auto order = static_cast<std::size_t>(open.degree) + 1;
    if (open.points.size() < order)
        fail(fmt::format("a spline of order {} needs {} points, it has {}", order, order, open.points.size()));
    std::vector<double> knots;
    for (const SplinePoint& point : open.points) knots.push_back(point.knot);
    knots.insert(knots.end(), open.last_knots.begin(), open.last_knots.end());
    const double tolerance = same_knot * std::abs(knots.back() - knots.front());
    for (std::size_t i = order; i < open.points.size(); ++i) {
        if (knots[i] - knots[i - order + 1] <= tolerance)
            fail(fmt::format("a knot of a spline (K{}) may occur {} times at most", knots[i], order - 1));
    }
    if (knots[order - 1] - knots[0] > tolerance || knots.back() - knots[knots.size() - order] > tolerance)
        fail(fmt::format("the first {} knots of a spline (K) must be the same, and the last {}", order, order));
    if (!(knots.back() > knots.front())) fail("the knots of a spline (K) are all the same");
    finish_nurbs(std::move(knots));
}

/// Spans of the open spline over its control points.
void Interpreter::finish_nurbs(std::vector<double> knots) {
    OpenSpline open = std::exchange(curves_.open, {});
    Nurbs nurbs{open.degree, {}, {}, std::move(knots)};
    for (const SplinePoint& point : open.points) {
        nurbs.points.push_back(point.at);
        nurbs.weights.push_back(point.weight);
    }
    const std::int64_t first = program_.motions.size();
    const Vec3 end = open.points.back().at;
    for (NurbsSpan& span : spans_of(nurbs)) {
        const SplinePoint& of = open.points[span.last_point];
        push_curve(std::move(span.curve), rules_->motion.splines_by_last_block ? place_.line : of.line, of.feed);
    }
    program_.motions.end.back() = Xyz(end);
    state_.position = end;
    move_events(open, first, static_cast<std::size_t>(open.degree));
}

/// What stood between the blocks of a spline stands between its spans. `shaping`: points before the first span ends.
void Interpreter::move_events(const OpenSpline& open, std::int64_t first, std::size_t shaping) {
    std::vector<ProgramEvent>& events = program_.events;
    const std::size_t before = events.size() - open.events.size();
    const std::int64_t spans = program_.motions.size() - first;
    for (std::size_t k = 0; k < open.events.size(); ++k) {
        const std::size_t points = open.events[k];
        const auto passed = static_cast<std::int64_t>(points > shaping ? points - shaping : 0);
        events[before + k].motion = first + std::min(passed, spans);
    }
}

/// A block of ASPLINE, BSPLINE and CSPLINE.
void Interpreter::spline_point(const Block& block) {
    refuse_beside_spline(block);
    const SplineKind kind = kind_of_points(state_.motion);
    if (const NamedWord* degree = block.find("SD")) {
        if (degree->value != 2 && degree->value != 3) fail("the degree of a spline (SD) is 2 or 3", degree->column);
        if (kind == SplineKind::basis) curves_.degree = static_cast<int>(degree->value);
    }
    const bool basis = kind == SplineKind::basis;
    const double weight = block.value_of("PW").value_or(1.0);
    const double interval = block.value_of("PL").value_or(missing<double>);
    if (!(weight >= 0)) fail("a weight (PW) must not be negative", block.find("PW")->column);
    if (interval < 0) fail("an interval of knots (PL) must not be negative", block.find("PL")->column);
    if (!basis && (block.find("PW") != nullptr || block.find("PL") != nullptr || block.find("SD") != nullptr))
        note(Severity::warning, "program.unused-word", "PW, PL and SD have no meaning for ASPLINE and CSPLINE");
    const Vec3 from = state_.position;
    const Vec3 to = target(block, false);
    if (from.array().isNaN().any() && (to - from).array().isNaN().any() &&
        !(to.array().isNaN() == from.array().isNaN()).all())
        fail("a spline begins where the tool is, which is not known yet");
    if (curves_.open.kind != kind || curves_.open.left) begin_spline(kind);
    curves_.open.degree = basis ? curves_.degree : 3;
    add_spline_point(to, weight, interval);
}

/// BSPLINE: PL of the i-th block is the length of the i-th span; a first block with PL=0 makes those count from the
/// first one that is greater.
void Interpreter::finish_basis_spline() {
    OpenSpline& open = curves_.open;
    const std::size_t blocks = open.points.size() - 1;
    const std::size_t degree = std::min(static_cast<std::size_t>(open.degree), blocks);
    open.degree = static_cast<int>(degree);
    const std::size_t spans = blocks - degree + 1;
    std::vector<double> intervals(spans, 1.0);
    const auto given = [&](std::size_t block) { return open.points[block + 1].knot; };
    bool any = false;
    for (std::size_t k = 0; k < blocks; ++k) any = any || given(k) > 0;
    if (any) {
        std::size_t from = 0;
        while (!(given(from) > 0) && !std::isnan(given(from))) ++from;
        for (std::size_t k = 0; k < spans; ++k) {
            const double interval = from + k < blocks ? given(from + k) : missing<double>;
            if (std::isnan(interval))
                fail(fmt::format("BSPLINE: PL is missing in line {}",
                                 open.points[std::min(from + k, blocks - 1) + 1].line));
            intervals[k] = interval;
        }
        if (!(intervals.front() > 0 && intervals.back() > 0))
            fail("BSPLINE: the first and the last interval of knots (PL) must be greater than 0");
    }
    finish_nurbs(clamped_knots(open.degree, intervals));
}

void Interpreter::finish_point_spline(const Vec3& end_tangent) {
    OpenSpline open = std::exchange(curves_.open, {});
    std::vector<Vec3> points{open.points.front().at};
    std::vector<const SplinePoint*> blocks;
    // Axes that are not known yet stay so, and have no part in the chords.
    const Vec3 unknown = points[0].array().isNaN().select(points[0], 0.0);
    for (const SplinePoint& point : std::span(open.points).subspan(1)) {
        const Vec3 at = point.at.array().isNaN().select(0.0, point.at);
        const Vec3 before = points.back().array().isNaN().select(0.0, points.back());
        if ((at - before).norm() <= no_chord) continue;
        points.push_back(at);
        blocks.push_back(&point);
    }
    points[0] = points[0].array().isNaN().select(0.0, points[0]);
    if (points.size() < 2) return;
    const auto end_of = [](SplineEnd kind, const Vec3& tangent) {
        PointSplineEnd end;
        if (kind == SplineEnd::natural) end.kind = PointSplineEnd::Kind::natural;
        if (kind == SplineEnd::tangent && tangent.allFinite()) end = {PointSplineEnd::Kind::tangent, tangent};
        return end;
    };
    const PointSplineEnd begin = end_of(open.begin, open.begin_tangent);
    const PointSplineEnd end = end_of(open.end, end_tangent);
    std::vector<BezierCurve> spans =
        open.kind == SplineKind::akima ? akima_spline(points, begin, end) : cubic_spline(points, begin, end);
    const std::int64_t first = program_.motions.size();
    for (std::size_t i = 0; i < spans.size(); ++i) {
        BezierCurve curve = std::move(spans[i]);
        if (unknown.hasNaN()) curve = curve.mapped([&](const Vec3& p) { return Vec3(p + unknown); });
        push_curve(std::move(curve), blocks[i]->line, blocks[i]->feed);
    }
    move_events(open, first, 1);
}

/// The spline that is open ends here. `end_tangent`: where the motion behind it goes; NaN: there is none.
void Interpreter::close_spline(const Vec3& end_tangent) {
    switch (curves_.open.kind) {
        case SplineKind::none: return;
        case SplineKind::uniform: fail("a spline (G5.2) is not closed by G5.3");
        case SplineKind::knotted:
            fail(fmt::format("a spline (G6.2) ends with {} blocks of K alone, here are {}", curves_.open.degree + 1,
                             curves_.open.last_knots.size()));
        case SplineKind::basis: finish_basis_spline(); return;
        case SplineKind::akima:
        case SplineKind::cubic:
            finish_point_spline(end_tangent.norm() > no_chord ? Vec3(end_tangent.normalized())
                                                              : Vec3(Vec3::Constant(missing<double>)));
            return;
    }
}

void Interpreter::close_spline_before(const Vec3& next) { close_spline(next - state_.position); }

/// A block in another mode may not stand inside a spline that has an end of its own.
void Interpreter::settle_spline(const Block& block) {
    if (!block.polynomials.empty() && state_.motion != MotionMode::polynomial)
        fail("PO moves axes, but POLY is not in force", block.polynomials.front().column);
    OpenSpline& open = curves_.open;
    if ((open.kind == SplineKind::uniform && state_.motion != MotionMode::nurbs) ||
        (open.kind == SplineKind::knotted && state_.motion != MotionMode::knotted_nurbs))
        close_spline(Vec3::Zero());
    if (!curves_.is_open() || open.left) return;
    // The direction of the motion behind the others is not known yet.
    open.left = kind_of_points(state_.motion) != open.kind;
    // The words of the blocks behind it say nothing of this one.
    if (!open.left) open.end = curves_.end;
}

/// The value of PO[axis] in the block; nullptr: none.
const PolynomialWord* Interpreter::polynomial_of(const Block& block, char axis) const {
    const PolynomialWord* found = nullptr;
    for (const PolynomialWord& word : block.polynomials) {
        if (word.axis != axis) continue;
        if (found != nullptr) fail("PO of the same axis is given twice", word.column);
        if (word.values.size() > most_polynomial)
            fail(fmt::format("a polynomial (PO) has a degree of {} at most", most_polynomial), word.column);
        found = &word;
    }
    return found;
}

/// POLY: Σ aᵢ pⁱ over p from 0 to PL, an axis each; a₀ is where it stands, a₁ follows from the end. PO[] is a common
/// denominator with b₀ = 1, given in the same way. An axis without PO moves evenly over p.
void Interpreter::polynomial(const Block& block) {
    refuse_beside_spline(block);
    const double interval = block.value_of("PL").value_or(1.0);
    if (!(interval > 0)) fail("the interval of a polynomial (PL) must be greater than 0", block.find("PL")->column);
    for (const PolynomialWord& word : block.polynomials) {
        if (word.axis != 0 && (word.axis < 'X' || word.axis > 'Z'))
            fail(fmt::format("PO[{}]: polynomials of X, Y and Z are supported", word.axis), word.column);
    }
    std::vector<double> denominator{1.0};
    if (const PolynomialWord* word = polynomial_of(block, 0)) {
        denominator = coefficients_to(word->values[0], word->values, 1, 1, interval);
        if (!stays_positive(denominator, interval))
            fail("the denominator of a polynomial (PO[]) must be greater than 0", word->column);
    }
    const Vec3 begin = state_.programmed();
    Vec3 end = read_axes(block, false);
    std::vector<Vec3> numerator(most_polynomial + 2, Vec3::Zero());
    unsigned placed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> a;
        if (const PolynomialWord* word = polynomial_of(block, "XYZ"[axis])) {
            if (std::isnan(begin[axis]))
                fail("a polynomial begins where the tool is, which is not known yet", word->column);
            const double unit = state_.unit_mm * (axis == 0 && state_.diameter ? 0.5 : 1.0);
            end[axis] = word->values[0] * unit + (state_.incremental ? begin[axis] : 0.0);
            placed |= 1U << static_cast<unsigned>(axis);
            a = coefficients_to(end[axis] * polynomial_value(denominator, interval), word->values, begin[axis], unit,
                                interval);
        } else {
            a = line_over(denominator, begin[axis], (end[axis] - begin[axis]) / interval);
        }
        for (std::size_t k = 0; k < a.size(); ++k) numerator[k][axis] = a[k];
    }
    while (numerator.size() > 2 && numerator.back().isZero(0)) numerator.pop_back();
    state_.place(placed, false);
    BezierCurve curve = bezier_of(numerator, denominator, interval);
    if (state_.frame.active()) curve = curve.mapped([&](const Vec3& p) { return state_.frame.to_work(p); });
    push_curve(std::move(curve), place_.line, state_.feed);
}

}  // namespace clsurf
