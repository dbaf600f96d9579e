#pragma once
// Lines that can be rewritten, and a program's text with some of them replaced: everything else stays
// byte for byte.
//
// A line may be rewritten where it holds nothing but a line number, G1 and X, Y, Z, with or without A, B, C, in plain
// numbers, is run once, says in absolute coordinates where its motion ends, the tip's on five axes, and is run at a feed
// per minute (G94). Comments, feeds, other codes, tool axes as vectors, variables and subprograms are therefore never
// touched: they end the section.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/bezier_curve.h"
#include "program/program.h"
#include "program/text/text_rules.h"

namespace clsurf {

/// What a rewritable line looks like. Words are those of X, Y, Z, A, B, C.
struct PlainLine {
    std::string_view number;                 ///< "N120 ", "12 " with the blanks behind; empty: none
    std::string_view code;                   ///< "G1 ", "G01", "L "; empty: modal
    std::array<std::string_view, 6> axis;    ///< "X", "Y ", "Z=" as written before the number; empty: not given
    std::array<std::string_view, 6> digits;  ///< the number as written
    std::array<double, 6> value{};
    std::array<int, 6> decimals{};
    bool blanks = false;  ///< between the words
};

/// Reads a line without its end; nullopt: there is more in it.
/// `straight_word`: what straight lines of the dialect begin with, as L in Klartext; empty: G1.
[[nodiscard]] std::optional<PlainLine> read_plain_line(std::string_view text, std::string_view straight_word = {});

/// The angles at the end of a new line.
struct LineAngles {
    Vec3 programmed = Vec3::Zero();  ///< A, B, C [rad]
    std::int64_t motion = -1;        ///< whose line has them: its words are taken as they stand; −1: none
};

class LineEditor {
public:
    /// Looks at all lines. Motions of `program`, which must outlive it, are those of the tip (toolpath/tip_motions.h) where
    /// rotary axes move. New coordinates have as many decimals as the finest of those lines, or `least_decimals` where that
    /// is more, new angles as many as the finest. O(text).
    explicit LineEditor(const Program& program, int least_decimals = 0);

    /// Whether the line of a motion may be rewritten.
    [[nodiscard]] bool editable(std::int64_t motion) const { return editable_[static_cast<std::size_t>(motion)] != 0; }
    /// mm per unit of the program's words.
    [[nodiscard]] double unit() const { return unit_; }
    /// How far a point may be moved by being written [mm].
    [[nodiscard]] double rounding() const;
    /// How far the tool axis may be turned by its angles being written [rad].
    [[nodiscard]] double turn_rounding() const;

    /// Puts `points` in place of the ends of the motions first … last, whose lines follow each other. Calls
    /// must come in the order of the program. The last point must be where the last motion ended. Coordinates
    /// are rounded, and points that fall on the one before are left out; returns how many lines were written.
    /// `angles`: one entry a point where the lines turn rotary axes, else none.
    std::size_t replace(std::int64_t first, std::int64_t last, const std::vector<Vec3>& points,
                        const std::vector<LineAngles>& angles = {});

    /// In which form splines may be written; none: the dialect has none, or G5, which needs G17, in a program with G18 or
    /// G19.
    [[nodiscard]] SplineForm spline_form() const { return splines_; }
    /// Whether a section that begins with motion `first` may be a spline: the dialect has one, in a plane of constant Z
    /// where its own are planar.
    [[nodiscard]] bool may_be_spline(std::int64_t first, const std::vector<Vec3>& points) const;
    /// Puts a cubic spline [mm] from where the motion `first` begins to where `last` ends in place of their lines, as
    /// replace() does. Returns how many motions it is. Domain: may_be_spline(); weights of 1.
    std::size_t replace(std::int64_t first, std::int64_t last, const Nurbs& spline);

    /// Gives motions a feed [mm/s], one entry a motion of the program, 0: as it is. Only lines that may be rewritten get one, and
    /// the blocks that replace() wrote for the spans of a spline; the program is then one that was read back from text().
    /// `spans`: one entry a motion, not 0 where it may be such a span; empty: there is none. Behind them the programmed feed is
    /// set again: on the next such line, on the G1 behind a spline, else on a line of its own. G06.2 has one feed, in its
    /// first block: the lowest of its spans. Instead of replace(), not besides it.
    void set_feeds(const std::vector<float>& feeds, const std::vector<std::uint8_t>& spans = {});

    /// The new text, with a comment near its beginning (empty: none).
    [[nodiscard]] std::string text(std::string_view header) const;
    /// Lines of the old program that are replaced by others.
    [[nodiscard]] std::size_t changed_lines() const { return changed_; }
    [[nodiscard]] bool changes() const { return !edits_.empty(); }

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
    std::vector<std::uint8_t> spans_;  ///< per motion: a span of a spline that has a block of its own
    std::vector<Edit> edits_;
    double unit_ = 1;
    bool knows_unit_ = false;               ///< some line says it
    int decimals_ = 0, turn_decimals_ = 0;  ///< of new coordinates and angles
    std::size_t changed_ = 0;
};

}  // namespace clsurf
