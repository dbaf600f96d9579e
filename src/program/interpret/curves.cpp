// Blocks of splines: G5, G5.1, G5.2, G6.2, ASPLINE, BSPLINE, CSPLINE, POLY. Each span becomes a motion that owns its
// curve (docs/formats/programs.md lists assumptions where manuals are ambiguous).

#include "program/interpret/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "numeric/point_spline.h"
#include "program/interpret/axis_words.h"
#include "program/interpret/feeds.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/tangential_arc.h"
#include "program/interpret/tool_axis.h"

namespace clsurf {
namespace {

constexpr std::uint32_t turning_axes = Words::bit('A') | Words::bit('B') | Words::bit('C');
constexpr int least_uniform_order = 3;  ///< LinuxCNC reads a smaller L as 3
constexpr int most_order = 20;
constexpr double no_chord = 1e-9;         ///< [mm] nearer points are equal
constexpr double start_play_steps = 1.5;  ///< increments, between the current position and the first point of a spline
constexpr double same_knot = 1e-12;       ///< relative to the range of knots
constexpr int denominator_places = 64;
constexpr int most_polynomial = 5;  ///< degree

double polynomial_value(const std::vector<double>& coefficients, double p) {
    double value = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) value = value * p + coefficients[k];
    return value;
}

/// All coefficients of a polynomial with these values at its beginning and end; `values`: the end, a₂, a₃ … as
/// written.
std::vector<double> coefficients_to(double end, const std::vector<double>& values, double begin, double unit,
                                    double interval) {
    std::vector<double> a{begin, 0.0};
    for (std::size_t k = 1; k < values.size(); ++k) a.push_back(values[k] * unit);
    a[1] = (end - polynomial_value(a, interval)) / interval;
    return a;
}

/// The spline whose points are the blocks of that mode; none: the blocks are not points.
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

void begin_spline(Interpreter& in, SplineKind kind) {
    if (in.curves_.is_open()) close_spline(in, Vec3::Constant(missing<double>));
    in.curves_.open.kind = kind;
    in.curves_.open.begin = in.curves_.begin;
    in.curves_.open.end = in.curves_.end;
    in.curves_.open.points.push_back({in.state_.position, 1, missing<double>, in.place_.line, in.state_.feed});
    // The direction at the end of the previous motion.
    Vec3 tangent = Vec3::Zero();
    for (std::int64_t i = in.program_.motions.size(); i-- > 0 && tangent.isZero(0);)
        tangent = tangent_at_end(in.program_.motions, i);
    if (tangent.isZero(0) && !in.forgotten_tangents_.empty()) tangent = in.forgotten_tangents_.front();
    if (tangent.allFinite() && tangent.norm() > no_chord) in.curves_.open.begin_tangent = tangent.normalized();
}

/// The following words count from this point, although the motion is pushed later.
void add_spline_point(Interpreter& in, const Vec3& at, double weight, double knot) {
    in.curves_.open.points.push_back({at, weight, knot, in.place_.line, in.state_.feed});
    in.state_.position = at;
}

/// Events between the blocks of a spline are moved between its spans. `shaping`: points before the first span ends.
void move_events(Program& program, const OpenSpline& open, std::int64_t first, std::size_t shaping) {
    std::vector<ProgramEvent>& events = program.events;
    const std::size_t before = events.size() - open.events.size();
    const std::int64_t spans = program.motions.size() - first;
    for (std::size_t k = 0; k < open.events.size(); ++k) {
        const std::size_t points = open.events[k];
        const auto passed = static_cast<std::int64_t>(points > shaping ? points - shaping : 0);
        events[before + k].motion = first + std::min(passed, spans);
    }
}

/// Spans of the open spline over its control points.
void finish_nurbs(Interpreter& in, std::vector<double> knots) {
    OpenSpline open = std::exchange(in.curves_.open, {});
    Nurbs nurbs{open.degree, {}, {}, std::move(knots)};
    for (const SplinePoint& point : open.points) {
        nurbs.points.push_back(point.at);
        nurbs.weights.push_back(point.weight);
    }
    const std::int64_t first = in.program_.motions.size();
    const Vec3 end = open.points.back().at;
    for (NurbsSpan& span : spans_of(nurbs)) {
        const SplinePoint& of = open.points[span.last_point];
        push_curve(in, std::move(span.curve), in.rules_->motion.splines_by_last_block ? in.place_.line : of.line,
                   of.feed);
    }
    in.program_.motions.end.back() = Xyz(end);
    in.state_.position = end;
    move_events(in.program_, open, first, static_cast<std::size_t>(open.degree));
}

void finish_knotted(Interpreter& in) {
    const OpenSpline& open = in.curves_.open;
    const auto order = static_cast<std::size_t>(open.degree) + 1;
    if (open.points.size() < order)
        in.fail(fmt::format("a spline of order {} needs {} points, it has {}", order, order, open.points.size()));
    std::vector<double> knots;
    for (const SplinePoint& point : open.points) knots.push_back(point.knot);
    knots.insert(knots.end(), open.last_knots.begin(), open.last_knots.end());
    const double tolerance = same_knot * std::abs(knots.back() - knots.front());
    for (std::size_t i = order; i < open.points.size(); ++i) {
        if (knots[i] - knots[i - order + 1] <= tolerance)
            in.fail(fmt::format("a knot of a spline (K{}) may occur {} times at most", knots[i], order - 1));
    }
    if (knots[order - 1] - knots[0] > tolerance || knots.back() - knots[knots.size() - order] > tolerance)
        in.fail(fmt::format("the first {} knots of a spline (K) must be the same, and the last {}", order, order));
    if (!(knots.back() > knots.front())) in.fail("the knots of a spline (K) are all the same");
    finish_nurbs(in, std::move(knots));
}

/// BSPLINE: PL of the i-th block is the length of the i-th span; if the first block has PL=0, they count from the
/// first one that is positive.
void finish_basis_spline(Interpreter& in) {
    OpenSpline& open = in.curves_.open;
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
                in.fail(fmt::format("BSPLINE: PL is missing in line {}",
                                    open.points[std::min(from + k, blocks - 1) + 1].line));
            intervals[k] = interval;
        }
        if (!(intervals.front() > 0 && intervals.back() > 0))
            in.fail("BSPLINE: the first and the last interval of knots (PL) must be greater than 0");
    }
    finish_nurbs(in, clamped_knots(open.degree, intervals));
}

void finish_point_spline(Interpreter& in, const Vec3& end_tangent) {
    OpenSpline open = std::exchange(in.curves_.open, {});
    std::vector<Vec3> points{open.points.front().at};
    std::vector<const SplinePoint*> blocks;
    // Unknown axes stay unknown, and do not contribute to the chords.
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
    const std::int64_t first = in.program_.motions.size();
    for (std::size_t i = 0; i < spans.size(); ++i) {
        BezierCurve curve = std::move(spans[i]);
        if (unknown.hasNaN()) curve = curve.mapped([&](const Vec3& p) { return Vec3(p + unknown); });
        push_curve(in, std::move(curve), blocks[i]->line, blocks[i]->feed);
    }
    move_events(in.program_, open, first, 1);
}

/// The value of PO[axis] in the block; nullptr: none.
const PolynomialWord* polynomial_of(const Interpreter& in, const Block& block, char axis) {
    const PolynomialWord* found = nullptr;
    for (const PolynomialWord& word : block.polynomials) {
        if (word.axis != axis) continue;
        if (found != nullptr) in.fail("PO of the same axis is given twice", word.column);
        if (word.values.size() > most_polynomial)
            in.fail(fmt::format("a polynomial (PO) has a degree of {} at most", most_polynomial), word.column);
        found = &word;
    }
    return found;
}

}  // namespace

void refuse_with_spline(Interpreter& in, const Block& block) {
    if (in.compensation_.path.on()) in.fail("a spline under cutter compensation is not supported");
    if (take_tool_axis(in, block)) in.fail("a spline with a tool axis as a vector is not supported");
    if ((block.words.has & turning_axes) == 0) return;
    if (rotary_target(in, block) != in.state_.rotary)
        in.fail("a spline moves X, Y and Z: rotary axes that turn along it are not supported");
}

void push_curve(Interpreter& in, BezierCurve curve, LineNumber line, double feed) {
    if (in.curves_.is_open()) close_spline(in, curve.tangent(0));
    const LineNumber here = std::exchange(in.place_.line, line);
    const double feed_here = std::exchange(in.state_.feed, feed);
    const Vec3 end = curve.at(1);
    const float along = feed_for(in.state_, curve.length());
    const std::int64_t motion = in.program_.motions.size();
    in.program_.motions.curves.push_back({motion, std::make_shared<const BezierCurve>(std::move(curve))});
    in.push(MotionKind::spline, end, in.state_.rotary, along);
    in.place_.line = here;
    in.state_.feed = feed_here;
}

void plane_spline(Interpreter& in, const Block& block) {
    if (in.state_.plane_axis != 2) in.fail("G5 and G5.1 need the XY plane (G17)");
    refuse_with_spline(in, block);
    const double unit = in.state_.unit_mm;
    const Vec3 from = in.state_.position;
    const Vec3 to = target_of(in, block, false);
    if (to.z() != from.z() && !std::isnan(from.z())) in.fail("a spline (G5, G5.1) moves only X and Y");
    const auto words = [&](char u, char v) {
        const auto word = [&](char letter) { return block.words.given(letter) ? block.words.of(letter) * unit : 0.0; };
        return Vec3(word(u), word(v), 0);
    };
    if (in.state_.motion == MotionMode::quadratic_spline) {
        if (!block.words.given('I') && !block.words.given('J')) in.fail("G5.1 needs I or J");
        const std::array<Vec3, 3> control{from, from + words('I', 'J'), to};
        push_curve(in, BezierCurve(control), in.place_.line, in.state_.feed);
        return;
    }
    const bool first = block.words.given('I') || block.words.given('J');
    if (!block.words.given('P') || !block.words.given('Q')) in.fail("G5 needs P and Q");
    if (first && !(block.words.given('I') && block.words.given('J'))) in.fail("G5 needs both I and J, or neither");
    if (!first && in.curves_.spline_out.isZero()) in.fail("the first G5 needs I and J");
    const Vec3 out = first ? words('I', 'J') : Vec3(-in.curves_.spline_out.x(), -in.curves_.spline_out.y(), 0);
    const Vec3 inwards = words('P', 'Q');
    in.curves_.spline_out = inwards.head<2>();
    const std::array<Vec3, 4> control{from, from + out, to + inwards, to};
    push_curve(in, BezierCurve(control), in.place_.line, in.state_.feed);
}

void nurbs_point(Interpreter& in, const Block& block) {
    const Words& w = block.words;
    if (in.state_.plane_axis != 2) in.fail("G5.2 needs the XY plane (G17)");
    if (w.given('X') != w.given('Y')) in.fail("a point of G5.2 needs both X and Y");
    if (w.given('Z') || (w.has & turning_axes) != 0) in.fail("a spline (G5.2) moves only X and Y");
    refuse_with_spline(in, block);
    const bool is_point = w.given('X');
    const double weight = w.given('P') ? w.of('P') : 1.0;
    if (!(weight > 0)) in.fail("a weight (P) must be greater than 0");
    if (!in.curves_.is_open()) {
        begin_spline(in, SplineKind::uniform);
        in.curves_.open.degree = least_uniform_order - 1;
        if (!is_point) in.curves_.open.points.front().weight = weight;
    } else if (!is_point && w.given('P')) {
        in.fail("P without X and Y is the weight of the first point only", w.column['P' - 'A']);
    }
    if (w.given('L')) {
        const double order = std::max(w.of('L'), double(least_uniform_order));
        if (order > most_order) in.fail(fmt::format("the order of a spline (L) is at most {}", most_order));
        in.curves_.open.degree = static_cast<int>(order) - 1;
    }
    if (is_point) add_spline_point(in, target_of(in, block, false), weight, missing<double>);
}

void nurbs_end(Interpreter& in) {
    const int order = in.curves_.open.degree + 1;
    const auto count = static_cast<int>(in.curves_.open.points.size());
    if (in.curves_.open.kind != SplineKind::uniform) in.fail("G5.3 without G5.2 before it");
    if (count < order) in.fail(fmt::format("a spline of order {} needs {} points, it has {}", order, order, count));
    const std::vector<double> intervals(static_cast<std::size_t>(count - order + 1), 1.0);
    finish_nurbs(in, clamped_knots(in.curves_.open.degree, intervals));
    in.state_.motion = MotionMode::none;
}

void knotted_point(Interpreter& in, const Block& block) {
    const Words& w = block.words;
    const bool is_point = (w.has & Words::xyz) != 0;
    refuse_with_spline(in, block);
    OpenSpline& open = in.curves_.open;
    const bool first = !in.curves_.is_open();
    if (first) {
        if (!is_point && !w.given('K')) return;
        const Vec3 start = in.state_.position;
        const Vec3 given = target_of(in, block, false);
        const Vec3 off = given - start;
        for (int axis = 0; axis < 3; ++axis) {
            if (!w.given("XYZ"[axis])) continue;
            if (!(std::abs(off[axis]) <= start_play_steps * in.state_.least_increment() * in.state_.unit_mm))
                in.fail("a spline (G6.2) begins where the tool is, but its first point is another one",
                        w.column[static_cast<std::size_t>("XYZ"[axis] - 'A')]);
        }
        begin_spline(in, SplineKind::knotted);
        const double order = w.given('P') ? w.of('P') : 4;
        if (!(order >= 2 && order <= most_order) || order != std::round(order))
            in.fail(fmt::format("the order of a spline (P) is a whole number, 2 … {}", most_order),
                    w.column['P' - 'A']);
        open.degree = static_cast<int>(order) - 1;
        open.points.front().weight = w.given('R') ? w.of('R') : 1.0;
        open.points.front().knot = w.given('K') ? w.of('K') : missing<double>;
    }
    if (!first && !w.given('K')) {
        if (is_point) in.fail("a point of a spline (G6.2) needs its knot (K)");
        return;
    }
    const double weight = w.given('R') ? w.of('R') : 1.0;
    if (!(weight > 0)) in.fail("a weight (R) must be greater than 0");
    if (first) return;
    // If the first block has no K, it takes the knot of the second.
    if (std::isnan(open.points.front().knot)) open.points.front().knot = w.of('K');
    const double before = open.last_knots.empty() ? open.points.back().knot : open.last_knots.back();
    if (!(w.of('K') >= before)) {
        in.fail(fmt::format("knots of a spline (K) may not fall: {} after {}", w.of('K'), before), w.column['K' - 'A']);
    }
    if (is_point) {
        if (!open.last_knots.empty()) in.fail("a point after the last knots of a spline (G6.2)");
        add_spline_point(in, target_of(in, block, false), weight, w.of('K'));
        return;
    }
    open.last_knots.push_back(w.of('K'));
    if (static_cast<int>(open.last_knots.size()) == open.degree + 1) finish_knotted(in);
}

void spline_point(Interpreter& in, const Block& block) {
    refuse_with_spline(in, block);
    const SplineKind kind = kind_of_points(in.state_.motion);
    if (const NamedWord* degree = block.find("SD")) {
        if (degree->value != 2 && degree->value != 3) in.fail("the degree of a spline (SD) is 2 or 3", degree->column);
        if (kind == SplineKind::basis) in.curves_.degree = static_cast<int>(degree->value);
    }
    const bool basis = kind == SplineKind::basis;
    const double weight = block.value_of("PW").value_or(1.0);
    const double interval = block.value_of("PL").value_or(missing<double>);
    if (!(weight >= 0)) in.fail("a weight (PW) must not be negative", block.find("PW")->column);
    if (interval < 0) in.fail("an interval of knots (PL) must not be negative", block.find("PL")->column);
    if (!basis && (block.find("PW") != nullptr || block.find("PL") != nullptr || block.find("SD") != nullptr))
        in.note(Severity::warning, "program.unused-word", "PW, PL and SD have no meaning for ASPLINE and CSPLINE");
    const Vec3 from = in.state_.position;
    const Vec3 to = target_of(in, block, false);
    if (from.array().isNaN().any() && (to - from).array().isNaN().any() &&
        !(to.array().isNaN() == from.array().isNaN()).all())
        in.fail("a spline begins where the tool is, which is not known yet");
    if (in.curves_.open.kind != kind || in.curves_.open.left) begin_spline(in, kind);
    in.curves_.open.degree = basis ? in.curves_.degree : 3;
    add_spline_point(in, to, weight, interval);
}

void close_spline(Interpreter& in, const Vec3& end_tangent) {
    switch (in.curves_.open.kind) {
        case SplineKind::none: return;
        case SplineKind::uniform: in.fail("a spline (G5.2) is not closed by G5.3");
        case SplineKind::knotted:
            in.fail(fmt::format("a spline (G6.2) ends with {} blocks of K alone, here are {}",
                                in.curves_.open.degree + 1, in.curves_.open.last_knots.size()));
        case SplineKind::basis: finish_basis_spline(in); return;
        case SplineKind::akima:
        case SplineKind::cubic:
            finish_point_spline(in, end_tangent.norm() > no_chord ? Vec3(end_tangent.normalized())
                                                                  : Vec3(Vec3::Constant(missing<double>)));
            return;
    }
}

void close_spline_before(Interpreter& in, const Vec3& next) { close_spline(in, next - in.state_.position); }

void settle_spline(Interpreter& in, const Block& block) {
    if (!block.polynomials.empty() && in.state_.motion != MotionMode::polynomial)
        in.fail("PO moves axes, but POLY is not in force", block.polynomials.front().column);
    OpenSpline& open = in.curves_.open;
    if ((open.kind == SplineKind::uniform && in.state_.motion != MotionMode::nurbs) ||
        (open.kind == SplineKind::knotted && in.state_.motion != MotionMode::knotted_nurbs))
        close_spline(in, Vec3::Zero());
    if (!in.curves_.is_open() || open.left) return;
    // The direction of the next motion is still unknown.
    open.left = kind_of_points(in.state_.motion) != open.kind;
    // The words of later blocks do not apply to this spline.
    if (!open.left) open.end = in.curves_.end;
}

void polynomial_span(Interpreter& in, const Block& block) {
    refuse_with_spline(in, block);
    const double interval = block.value_of("PL").value_or(1.0);
    if (!(interval > 0)) in.fail("the interval of a polynomial (PL) must be greater than 0", block.find("PL")->column);
    for (const PolynomialWord& word : block.polynomials) {
        if (word.axis != 0 && (word.axis < 'X' || word.axis > 'Z'))
            in.fail(fmt::format("PO[{}]: polynomials of X, Y and Z are supported", word.axis), word.column);
    }
    std::vector<double> denominator{1.0};
    if (const PolynomialWord* word = polynomial_of(in, block, 0)) {
        denominator = coefficients_to(word->values[0], word->values, 1, 1, interval);
        if (!stays_positive(denominator, interval))
            in.fail("the denominator of a polynomial (PO[]) must be greater than 0", word->column);
    }
    const Vec3 begin = in.state_.programmed();
    Vec3 end = read_axes(in, block, false);
    std::vector<Vec3> numerator(most_polynomial + 2, Vec3::Zero());
    unsigned placed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> a;
        if (const PolynomialWord* word = polynomial_of(in, block, "XYZ"[axis])) {
            if (std::isnan(begin[axis]))
                in.fail("a polynomial begins where the tool is, which is not known yet", word->column);
            const double unit = in.state_.unit_mm * (axis == 0 && in.state_.diameter ? 0.5 : 1.0);
            end[axis] = word->values[0] * unit + (in.state_.incremental ? begin[axis] : 0.0);
            placed |= 1U << static_cast<unsigned>(axis);
            a = coefficients_to(end[axis] * polynomial_value(denominator, interval), word->values, begin[axis], unit,
                                interval);
        } else {
            a = line_over(denominator, begin[axis], (end[axis] - begin[axis]) / interval);
        }
        for (std::size_t k = 0; k < a.size(); ++k) numerator[k][axis] = a[k];
    }
    while (numerator.size() > 2 && numerator.back().isZero(0)) numerator.pop_back();
    in.state_.place(placed, false);
    BezierCurve curve = bezier_of(numerator, denominator, interval);
    if (in.state_.frame.active()) curve = curve.mapped([&](const Vec3& p) { return in.state_.frame.to_work(p); });
    push_curve(in, std::move(curve), in.place_.line, in.state_.feed);
}

}  // namespace clsurf
