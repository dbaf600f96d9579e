#pragma once
// Lines that can be rewritten, and a program's text with some of them replaced. All other bytes are unchanged.
//
// A line may be rewritten if all of this is true: it contains only a line number, G1 and X, Y, Z, with or without A, B, C, in
// plain numbers; it is run once; it gives the end of its motion in absolute coordinates (on five axes, of the tip); and it is
// run at a feed per minute (G94). Lines with comments, feeds, other codes, tool axes as vectors, variables or subprograms are
// therefore never changed, and end the section.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/bezier_curve.h"
#include "program/program.h"
#include "program/text/text_rules.h"

namespace clsurf {

/// The syntax of a rewritable line. Arrays are for the words X, Y, Z, A, B, C.
struct PlainLine {
    std::string_view number;                 ///< "N120 ", "12 " with the blanks after it; empty: none
    std::string_view code;                   ///< "G1 ", "G01", "L "; empty: modal
    std::array<std::string_view, 6> axis;    ///< "X", "Y ", "Z=" as written before the number; empty: not given
    std::array<std::string_view, 6> digits;  ///< the number as written
    std::array<double, 6> value{};
    std::array<int, 6> decimals{};
    bool blanks = false;  ///< there are blanks between the words
};

/// Reads a line without its end; nullopt: it has other content. `straight_word`: the first word of straight lines in the
/// dialect, for example L in Klartext; empty: G1.
[[nodiscard]] std::optional<PlainLine> read_plain_line(std::string_view text, std::string_view straight_word = {});

/// The angles at the end of a new line.
struct LineAngles {
    Vec3 programmed = Vec3::Zero();  ///< A, B, C [rad]
    std::int64_t motion = -1;        ///< old motion with these angles, so that its words are copied; −1: none
};

class LineEditor {
public:
    /// Examines all lines. Motions of `program`, which must outlive it, are those of the tip (toolpath/tip_motions.h) if rotary
    /// axes move. New coordinates have as many decimals as the finest of those lines, but at least `least_decimals`; new angles
    /// have as many as the finest. O(text).
    explicit LineEditor(const Program& program, int least_decimals = 0);

    /// Whether the line of a motion may be rewritten.
    [[nodiscard]] bool editable(std::int64_t motion) const { return editable_[static_cast<std::size_t>(motion)] != 0; }
    /// mm per unit of the program's words.
    [[nodiscard]] double unit() const { return unit_; }
    /// Largest distance by which rounding may move a written point [mm].
    [[nodiscard]] double rounding() const;
    /// Largest angle by which rounding of its angles may turn the tool axis [rad].
    [[nodiscard]] double turn_rounding() const;

    /// Replaces the ends of the motions first … last, whose lines are consecutive, by `points`. Calls must be in the order of
    /// the program. The last point must be the end of the last motion. Coordinates are rounded, and points that coincide with
    /// the one before are omitted; returns the number of lines written. `angles`: one entry per point if the lines turn rotary
    /// axes, else none.
    std::size_t replace(std::int64_t first, std::int64_t last, const std::vector<Vec3>& points,
                        const std::vector<LineAngles>& angles = {});

    /// The form in which splines are written; none: the dialect has none, or it has G5, which requires G17, and the program
    /// uses G18 or G19.
    [[nodiscard]] SplineForm spline_form() const { return splines_; }
    /// Whether a section that begins with motion `first` may be a spline: the dialect has one, and the section is in a plane of
    /// constant Z if its splines are planar.
    [[nodiscard]] bool may_be_spline(std::int64_t first, const std::vector<Vec3>& points) const;
    /// Replaces the lines of the motions `first` … `last` by a cubic spline [mm] from the begin of the first to the end of the
    /// last, like the other replace(). Returns the number of its motions. Domain: may_be_spline(); weights of 1.
    std::size_t replace(std::int64_t first, std::int64_t last, const Nurbs& spline);

    /// Sets feeds [mm/s], one entry per motion of the program, 0: unchanged. Only lines that may be rewritten get a feed, and
    /// so do the blocks that replace() wrote for the spans of a spline; the program must then have been read back from text().
    /// `spans`: one entry per motion, not 0 if it may be such a span; empty: there is none. After them the programmed feed is
    /// restored: on the next such line, on the G1 after a spline, else on a separate line. G06.2 has only one feed, in its
    /// first block: the lowest of its spans. Use either this or replace(), not both.
    void set_feeds(const std::vector<float>& feeds, const std::vector<std::uint8_t>& spans = {});

    /// The new text, with a comment near its beginning (empty: none).
    [[nodiscard]] std::string text(std::string_view header) const;
    /// Lines of the old program that are replaced by others.
    [[nodiscard]] std::size_t changed_lines() const { return changed_; }

private:
    struct Edit {
        LineNumber first = 0, last = 0;  ///< lines that are replaced
        std::string text;                ///< whole lines with their ends
    };

    struct FedMotion;
    [[nodiscard]] std::vector<FedMotion> fed_motions(const std::vector<float>& feeds,
                                                     const std::vector<std::uint8_t>& spans) const;
    [[nodiscard]] std::string feed_word(double feed) const;
    void append(LineNumber line, const std::string& words, const std::string& line_behind);

    const Program* program_;
    const TextRules* rules_;  ///< of its dialect
    SplineForm splines_ = SplineForm::none;
    std::vector<std::uint8_t> editable_;
    std::vector<std::uint8_t> spans_;  ///< per motion: a span of a spline that has a separate block
    std::vector<Edit> edits_;
    double unit_ = 1;
    bool knows_unit_ = false;               ///< at least one line determines it
    int decimals_ = 0, turn_decimals_ = 0;  ///< of new coordinates and angles
    std::size_t changed_ = 0;
};

}  // namespace clsurf
