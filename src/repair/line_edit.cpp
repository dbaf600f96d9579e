#include "repair/line_edit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "core/units.h"
#include "program/feed_mode_cursor.h"
#include "program/frame_placement.h"
#include "program/interpret/dialect_rules.h"
#include "program/text/lexer.h"
#include "program/text/nc_text.h"
#include "repair/spline_lines.h"

namespace clsurf {
namespace {

// The tolerances are above the rounding of doubles, 10^-10 mm at 1 km and 10^-15 rad, and below half a step of six decimals,
// 5·10^-7 mm and 9·10^-9 rad.
constexpr double same_coordinate = 1e-7;  ///< [mm] tolerance between a word and the end of its motion
constexpr double same_axis_angle = 1e-9;  ///< [rad]
constexpr std::string_view letters = "XYZABC";
constexpr std::size_t linear = 3, axes = 6;  ///< words: X, Y, Z and then A, B, C

std::size_t skip_blanks(std::string_view text, std::size_t at) {
    while (at < text.size() && is_blank(text[at])) ++at;
    return at;
}

/// Number of decimals of a number.
int decimals_of(std::string_view number) {
    const std::size_t point = number.find('.');
    return point == std::string_view::npos ? 0 : static_cast<int>(number.size() - point - 1);
}

bool cuts_in_a_line(const Motions& motions, std::size_t i) { return motions.kind[i] == MotionKind::feed; }

/// A, B, C before a motion [rad].
Vec3 angles_before(const Motions& motions, std::int64_t i) {
    return i > 0 && !motions.rotary.empty() ? motions.rotary[static_cast<std::size_t>(i - 1)].vec() : Vec3::Zero();
}

/// Whether a line's words are the angles at the end of its motion. If these turn, the tip must move as well.
bool states_end_angles(const PlainLine& line, const Motions& motions, std::size_t i) {
    const Vec3 begin = angles_before(motions, static_cast<std::int64_t>(i)),
               end = motions.rotary.empty() ? Vec3::Zero() : motions.rotary[i].vec();
    for (std::size_t a = linear; a < axes; ++a) {
        const auto axis = static_cast<int>(a - linear);
        const double expected = line.axis[a].empty() ? begin[axis] : line.value[a] * rad_per_deg;
        if (!(std::abs(end[axis] - expected) <= same_axis_angle)) return false;
    }
    return begin == end || motions.begin_of(static_cast<std::int64_t>(i)) != motions.end[i];
}

/// A point of the path in the coordinates of a motion's words: in its work system, before rotation, scale and shift by the
/// program.
Vec3 in_words(const Motions& motions, std::int64_t motion, const Vec3& p) {
    const WorkFrame& frame = motions.frame_of(motion);
    return frame.words.to_programmed(apply(frame.placed.inverse(), p));
}

/// The number and the word at the beginning of a straight line in Klartext: "12 L "; false: there are none.
bool read_statement(std::string_view text, std::string_view word, PlainLine& line, std::size_t& at) {
    const std::size_t number = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    at = skip_blanks(text, at);
    line.number = text.substr(number, at - number);
    if (!text.substr(at).starts_with(word)) return false;
    const std::size_t after = at + word.size();
    if (after >= text.size() || !is_blank(text[after])) return false;
    const std::size_t end = skip_blanks(text, after);
    line.code = text.substr(at, end - at);
    line.blanks = true;  // required between words in Klartext
    at = end;
    return true;
}

/// The format of the lines that are replaced.
struct OldLines {
    std::array<std::string, axes> words;      ///< letters as written there
    std::array<bool, axes> everywhere{};      ///< written on every line
    std::vector<std::string_view> numbers{};  ///< of lines: "N10"
    std::string first_code{};
    bool code_everywhere = true, blanks = false;
};

OldLines read_old(const SourceText& main, LineNumber first, LineNumber last, std::string_view straight_word) {
    OldLines old;
    old.everywhere.fill(true);
    for (std::size_t a = 0; a < axes; ++a) old.words[a] = letters[a];
    for (LineNumber n = first; n <= last; ++n) {
        const PlainLine line = *read_plain_line(main.line(n), straight_word);
        for (std::size_t a = 0; a < axes; ++a) {
            if (!line.axis[a].empty()) old.words[a] = line.axis[a];
            old.everywhere[a] = old.everywhere[a] && !line.axis[a].empty();
        }
        if (!line.number.empty()) old.numbers.push_back(line.number);
        if (n == first) old.first_code = line.code;
        old.code_everywhere = old.code_everywhere && !line.code.empty();
        old.blanks = old.blanks || line.blanks;
    }
    const bool all_linear = old.everywhere[0] && old.everywhere[1] && old.everywhere[2];
    std::fill(old.everywhere.begin(), old.everywhere.begin() + linear, all_linear);
    return old;
}

/// The lines that new ones replace.
struct Replaced {
    LineNumber first, last;
    OldLines old;

    Replaced(const Program& program, std::int64_t first_motion, std::int64_t last_motion,
             std::string_view straight_word)
        : first(program.motions.line[static_cast<std::size_t>(first_motion)]),
          last(program.motions.line[static_cast<std::size_t>(last_motion)]),
          old(read_old(program.main(), first, last, straight_word)) {}

    [[nodiscard]] std::size_t count() const { return last - first + 1; }
    /// The line number for new line k: taken from old line k, or from the last one for the last; empty: not all had a number.
    [[nodiscard]] std::string number(std::size_t k, bool is_last) const {
        if (old.numbers.size() != count()) return {};
        if (is_last) return std::string(old.numbers.back());
        return k + 1 < count() ? std::string(old.numbers[k]) : std::string();
    }
};

/// Whether a text has a word G18 or G19, which select another plane than G17, even in a comment.
bool has_other_plane(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (upper(text[at]) != 'G') continue;
        std::size_t digit = skip_blanks(text, at + 1);
        while (digit < text.size() && text[digit] == '0') ++digit;
        const bool plane =
            digit + 1 < text.size() && text[digit] == '1' && (text[digit + 1] == '8' || text[digit + 1] == '9');
        if (plane && (digit + 2 == text.size() || !is_digit(text[digit + 2]))) return true;
    }
    return false;
}

}  // namespace

std::optional<PlainLine> read_plain_line(std::string_view text, std::string_view straight_word) {
    PlainLine line;
    std::size_t at = skip_blanks(text, 0);
    if (!straight_word.empty() && !read_statement(text, straight_word, line, at)) return std::nullopt;
    bool any = false, moves = false;
    while (at < text.size()) {
        const char letter = upper(text[at]);
        const std::size_t word = at;
        at = skip_blanks(text, at + 1);
        if (straight_word.empty() && (letter == 'N' || letter == 'G')) {
            const std::size_t digits = at;
            while (at < text.size() && is_digit(text[at])) ++at;
            if (at == digits) return std::nullopt;
            if (letter == 'G' &&
                std::stoi(std::string(text.substr(digits, std::min<std::size_t>(at - digits, 4)))) != 1)
                return std::nullopt;
            if (at < text.size() && text[at] == '.') return std::nullopt;
            at = skip_blanks(text, at);
            std::string_view& kept = letter == 'N' ? line.number : line.code;
            if (!kept.empty() || any) return std::nullopt;
            kept = text.substr(word, at - word);
            continue;
        }
        const std::size_t axis = letters.find(letter);
        if (axis == std::string_view::npos || !line.axis[axis].empty()) return std::nullopt;
        if (at < text.size() && text[at] == '=') at = skip_blanks(text, at + 1);
        line.axis[axis] = text.substr(word, at - word);
        const std::size_t end = read_decimal(text, at, line.value[axis]);
        if (end == at) return std::nullopt;
        line.digits[axis] = text.substr(at, end - at);
        line.decimals[axis] = decimals_of(line.digits[axis]);
        at = skip_blanks(text, end);
        line.blanks = line.blanks || at > end;
        any = true;
        moves = moves || axis < linear;
    }
    return moves ? std::optional(line) : std::nullopt;
}

namespace {

/// The form of the dialect's splines; none if they are planar and the program uses another plane.
SplineForm usable_splines(const TextRules& rules, const Program& program) {
    const bool other_plane = rules.splines == SplineForm::cubic_plane && has_other_plane(program.main().text());
    return other_plane ? SplineForm::none : rules.splines;
}

}  // namespace

LineEditor::LineEditor(const Program& program, int least_decimals)
    : program_(&program),
      rules_(&program.dialect->rules->text),
      splines_(usable_splines(*rules_, program)),
      decimals_(least_decimals) {
    const Motions& motions = program.motions;
    const auto count = static_cast<std::size_t>(motions.size());
    const SourceText& main = program.main();
    editable_.assign(count, 0);
    spans_.assign(count, 0);
    std::vector<std::uint8_t> motions_of_line(std::size_t{main.line_count()} + 1, 0);
    const auto in_main = [&](std::size_t i) { return motions.file.empty() || motions.file[i] == 0; };
    for (std::size_t i = 0; i < count; ++i) {
        if (in_main(i) && motions.line[i] < motions_of_line.size() && motions_of_line[motions.line[i]] < 2)
            ++motions_of_line[motions.line[i]];
    }
    std::array<std::size_t, 2> fits{0, 0};
    constexpr std::array<double, 2> units{1, mm_per_inch};
    for (int turn = 0; turn < 2; ++turn) {
        // The first round determines the unit of the words, the second one the lines that give their end in it.
        FeedModeCursor feed_mode(program);
        for (std::size_t i = 0; i < count; ++i) {
            if (!feed_mode.per_minute(static_cast<std::int64_t>(i))) continue;
            if (motions.kind[i] == MotionKind::spline && in_main(i) && motions_of_line[motions.line[i]] == 1)
                spans_[i] = 1;
            if (!cuts_in_a_line(motions, i) || !in_main(i) || motions_of_line[motions.line[i]] != 1) continue;
            const std::optional<PlainLine> line = read_plain_line(main.line(motions.line[i]), rules_->straight_word);
            if (!line || !states_end_angles(*line, motions, i)) continue;
            const auto motion = static_cast<std::int64_t>(i);
            const Vec3 end = in_words(motions, motion, motions.end[i].vec()),
                       begin = in_words(motions, motion, motions.begin_of(motion).vec());
            const auto says = [&](double unit) {
                for (int axis = 0; axis < 3; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    const double expected = line->axis[a].empty() ? begin[axis] : line->value[a] * unit;
                    if (!(std::abs(end[axis] - expected) <= same_coordinate)) return false;
                }
                return true;
            };
            if (turn == 0) {
                for (std::size_t u = 0; u < units.size(); ++u) fits[u] += says(units[u]) ? 1 : 0;
            } else {
                editable_[i] = says(unit_) ? 1 : 0;
                if (editable_[i] == 0) continue;
                const auto angles = line->decimals.begin() + linear;
                decimals_ = std::max(decimals_, *std::max_element(line->decimals.begin(), angles));
                turn_decimals_ = std::max(turn_decimals_, *std::max_element(angles, line->decimals.end()));
            }
        }
        if (turn > 0) continue;
        unit_ = fits[1] > fits[0] ? units[1] : units[0];
        knows_unit_ = fits[0] + fits[1] > 0;
    }
}

double LineEditor::rounding() const { return 0.5 * std::sqrt(3.0) * unit_ * std::pow(10.0, -decimals_); }

double LineEditor::turn_rounding() const { return std::sqrt(0.5) * rad_per_deg * std::pow(10.0, -turn_decimals_); }

std::size_t LineEditor::replace(std::int64_t first, std::int64_t last, const std::vector<Vec3>& points,
                                const std::vector<LineAngles>& angles) {
    const Motions& motions = program_->motions;
    const SourceText& main = program_->main();
    const std::string_view end_of_line = line_end_of(main.text());
    const Replaced replaced(*program_, first, last, rules_->straight_word);
    const std::size_t used = angles.empty() ? linear : axes;
    const OldLines& old = replaced.old;
    Edit edit{replaced.first, replaced.last, {}};
    std::array<std::string, axes> modal;
    const auto text_of = [&](std::size_t axis, const Vec3& position, const Vec3& turned) {
        const int k = static_cast<int>(axis % linear);
        const auto number = rules_->straight_word.empty() ? fixed_text : signed_text;
        return axis < linear ? number(position[k] / unit_, decimals_) : number(turned[k] * deg_per_rad, turn_decimals_);
    };
    const Vec3 begin = in_words(motions, first, motions.begin_of(first).vec());
    for (std::size_t a = 0; a < used; ++a) modal[a] = text_of(a, begin, angles_before(motions, first));
    bool code_written = false;
    std::size_t written = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        std::string text;
        const bool is_last = k + 1 == points.size();
        const auto add = [&](const std::string& word) {
            if (old.blanks && !text.empty() && !is_blank(text.back())) text += ' ';
            text += word;
        };
        text += replaced.number(k, is_last);
        if (old.code_everywhere || !code_written) text += old.first_code;
        bool moves = false;
        const Vec3 position = in_words(motions, first, points[k]);
        std::array<std::string, axes> now;
        for (std::size_t a = 0; a < used; ++a) {
            now[a] = text_of(a, position, angles.empty() ? Vec3::Zero() : angles[k].programmed);
            moves = moves || (a < linear && now[a] != modal[a]);
        }
        if (!moves) continue;  // the distance to the previous point is below the last decimal
        const std::int64_t kept = angles.empty() ? -1 : angles[k].motion;
        const PlainLine as_written =
            kept < 0 ? PlainLine{}
                     : *read_plain_line(main.line(motions.line[static_cast<std::size_t>(kept)]), rules_->straight_word);
        for (std::size_t a = 0; a < used; ++a) {
            if (now[a] == modal[a] && !old.everywhere[a]) continue;
            const bool same_words = a >= linear && !as_written.axis[a].empty();
            add(same_words ? std::string(as_written.axis[a]) + std::string(as_written.digits[a])
                           : old.words[a] + now[a]);
            modal[a] = now[a];
        }
        code_written = true;
        ++written;
        edit.text += text;
        edit.text += end_of_line;
    }
    changed_ += replaced.count();
    edits_.push_back(std::move(edit));
    return written;
}

bool LineEditor::may_be_spline(std::int64_t first, const std::vector<Vec3>& points) const {
    if (splines_ != SplineForm::cubic_plane) return splines_ != SplineForm::none;
    const auto words = [&](const Vec3& p) { return in_words(program_->motions, first, p); };
    const Vec3& begin = points.front();
    // The inner points of G5 are not rotated or scaled with the frame.
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
        if (!((words(begin + axis) - words(begin) - axis).norm() <= same_coordinate)) return false;
    }
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return std::abs(words(p).z() - words(begin).z()) <= same_coordinate; });
}

std::size_t LineEditor::replace(std::int64_t first, std::int64_t last, const Nurbs& spline) {
    const Motions& motions = program_->motions;
    const std::string_view end_of_line = line_end_of(program_->main().text());
    const Replaced replaced(*program_, first, last, rules_->straight_word);
    const OldLines& old = replaced.old;
    SplineWords words{decimals_, {old.words[0], old.words[1], old.words[2]}, "G1"};
    if (!rules_->straight_word.empty()) words.straight.clear();
    Nurbs counted = spline;
    for (Vec3& p : counted.points) p = in_words(motions, first, p) / unit_;
    const std::vector<std::string> lines = spline_lines(counted, splines_, words);
    Edit edit{replaced.first, replaced.last, {}};
    for (std::size_t k = 0; k < lines.size(); ++k) {
        edit.text += replaced.number(k, k + 1 == lines.size());
        edit.text += lines[k];
        edit.text += end_of_line;
    }
    changed_ += replaced.count();
    edits_.push_back(std::move(edit));
    return motions_of_spline(spline, splines_);
}

std::string LineEditor::text(std::string_view header) const {
    const SourceText& main = program_->main();
    const std::string_view end_of_line = line_end_of(main.text());
    const bool semicolon = rules_->semicolon_comments;
    const std::string comment = header.empty() ? ""
                                : semicolon    ? fmt::format("; {}{}", header, end_of_line)
                                               : fmt::format("({}){}", header, end_of_line);
    // After the lines that must come first: the tape mark and the program's name.
    LineNumber head = 0;
    while (head < main.line_count()) {
        const std::string_view line = main.line(head + 1);
        const std::size_t at = skip_blanks(line, 0);
        const std::string_view block = line.substr(std::min(line.find_first_not_of("0123456789 \t"), line.size()));
        const bool first_block = !rules_->first_block.empty() && block.starts_with(rules_->first_block);
        const bool name = at == line.size() || line[at] == '%' || first_block ||
                          (upper(line[at]) == 'O' && at + 1 < line.size() && is_digit(line[at + 1]));
        if (!name) break;
        ++head;
    }
    const std::string_view all = main.text();
    std::string result;
    result.reserve(all.size() + all.size() / 4);
    std::size_t at = 0, next = 0;
    for (LineNumber n = 1; at < all.size(); ++n) {
        if (n == head + 1) result += comment;
        const std::size_t end = all.find('\n', at);
        const std::size_t after = end == std::string_view::npos ? all.size() : end + 1;
        while (next < edits_.size() && edits_[next].last < n) ++next;
        const bool replaced = next < edits_.size() && edits_[next].first <= n;
        if (!replaced)
            result += all.substr(at, after - at);
        else if (edits_[next].first == n)
            result += edits_[next].text;
        at = after;
    }
    return result;
}

}  // namespace clsurf
