// SPL of Klartext: a cubic in each axis, X(t) = K3X t³ + K2X t² + K1X t + X, with t from 1 to 0. Facts: HEIDENHAIN,
// iTNC 530, User's Manual "Klartext Programming", spline interpolation.

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "program/dialects/klartext/klartext.h"
#include "program/interpret/curves.h"

namespace clsurf::klartext {
namespace {

constexpr double most_start_play =
    1e-3 + 1e-9;  ///< [mm] gap between the end of the previous block and the beginning of the curve

struct SplineWords {
    std::array<std::optional<double>, 3> end;                     ///< X, Y, Z
    std::array<std::array<std::optional<double>, 3>, 3> factors;  ///< by axis: K1, K2, K3
    std::optional<double> feed;
    std::vector<int> m;
};

/// A signed number, with an exponent that may follow a blank: 4.688E-002, 0.413 E+2.
double read_factor(Line& line) {
    const double value = line.value();
    if (upper(line.c.peek()) != 'E') return value;
    ++line.c.at;
    return value * std::pow(10.0, line.value());
}

/// Joins continuation lines: those after '~', and those that begin with a factor.
std::string whole_statement(Line& line) {
    Interpreter& in = line.in;
    std::string text(line.c.text);
    bool continued = in.place_.text.find('~') != std::string_view::npos;
    const SourceText& file = in.program_.files[in.place_.file];
    while (in.place_.next_line <= file.line_count()) {
        const Statement next = clean_line(file.line(in.place_.next_line), in.rules_->text);
        const std::size_t at = next.text.find_first_not_of(' ');
        const bool factor = at != std::string::npos && at + 2 < next.text.size() && upper(next.text[at]) == 'K' &&
                            next.text[at + 1] >= '1' && next.text[at + 1] <= '3';
        if (!continued && !factor) break;
        const LineNumber first = in.place_.line;
        (void)in.next_line();
        in.place_.line = first;  // the line number of the block is that of its first line
        continued = next.text.find('~') != std::string::npos;
        text += ' ' + next.text;
    }
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '~') text[k] = ' ';
        if (text[k] == ',') text[k] = '.';
    }
    return text;
}

SplineWords read_words(Line& line) {
    SplineWords words;
    const auto axis_of = [&](char letter) -> std::size_t {
        if (letter >= 'X' && letter <= 'Z') return static_cast<std::size_t>(letter - 'X');
        throw ReadError{fmt::format("SPL of axis {}: only X, Y and Z are supported", letter), line.c.column(), {}};
    };
    while (line.c.peek() != '\0') {
        const char letter = upper(line.c.peek());
        const std::size_t column = line.c.column();
        ++line.c.at;
        if (letter == 'K' && line.c.peek() >= '1' && line.c.peek() <= '3') {
            const auto power = static_cast<std::size_t>(line.c.peek() - '1');
            ++line.c.at;
            const std::size_t axis = axis_of(upper(line.c.peek()));
            ++line.c.at;
            words.factors[axis][power] = read_factor(line);
        } else if (letter == 'F') {
            words.feed = line.value();
        } else if (letter == 'M') {
            const double code = line.value();
            if (!(code >= 0 && code < 1e4)) throw ReadError{"no such M function", column, {}};
            words.m.push_back(static_cast<int>(code));
        } else if (is_letter(letter)) {
            --line.c.at;
            const std::size_t axis = axis_of(letter);
            ++line.c.at;
            words.end[axis] = line.value();
        } else {
            throw ReadError{fmt::format("'{}' is not a word of SPL", letter), column, {}};
        }
    }
    return words;
}

}  // namespace

void spline(Line& line) {
    Interpreter& in = line.in;
    const std::string text = whole_statement(line);
    const std::size_t at = line.c.at;
    Line whole{in, Cursor{text, at}, line.start};
    const SplineWords words = read_words(whole);
    if (state_of(in).corner.pending) in.fail("a straight line with feed must follow RND and CHF", line.start + 1);
    Block& block = in.block_;
    block.clear();
    refuse_with_spline(in, block);
    const Vec3 begin = in.state_.programmed();
    std::array<Vec3, 4> points{begin, begin, begin, begin};
    unsigned placed = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& k = words.factors[axis];
        const char name = "XYZ"[axis];
        if (!words.end[axis] && !k[0] && !k[1] && !k[2]) continue;
        if (!words.end[axis] || !k[0] || !k[1] || !k[2])
            in.fail(fmt::format("SPL needs {0}, K3{0}, K2{0} and K1{0}, or none of them", name), line.start + 1);
        const auto i = static_cast<Eigen::Index>(axis);
        const double unit = in.state_.unit_mm;
        const double end = *words.end[axis] * unit;
        // Bézier points of t, backwards.
        const std::array<double, 4> b{unit * (*k[0] + *k[1] + *k[2]) + end, unit * (2 * *k[0] + *k[1]) / 3 + end,
                                      unit * *k[0] / 3 + end, end};
        if (!(std::abs(b[0] - begin[i]) <= most_start_play))
            in.fail(fmt::format("SPL begins at {}{:.4f}, the tool is at {:.4f}", name, b[0] / unit, begin[i] / unit),
                    line.start + 1);
        for (std::size_t j = 1; j < 4; ++j) points[j][i] = b[j];
        placed |= 1U << axis;
    }
    if (placed == 0) in.fail("SPL without an end point", line.start + 1);
    if (words.feed) in.state_.feed = *words.feed;
    for (const int m : words.m) (void)add_m(block.words, m);
    in.this_block_.motion_suppressed = true;
    if (!words.m.empty()) {
        in.state_.motion = MotionMode::none;
        in.execute(block);
    }
    in.state_.place(placed, false);
    for (Vec3& p : points) p = in.state_.frame.to_work(p);
    points[0] = in.state_.position;
    push_curve(in, BezierCurve(points), in.place_.line, in.state_.feed);
}

}  // namespace clsurf::klartext
