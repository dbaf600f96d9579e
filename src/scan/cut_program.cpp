#include "scan/cut_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/decimal_text.h"
#include "program/text/nc_text.h"

namespace clsurf {
namespace {

constexpr double same_place = 1e-6;  ///< [mm] between connected spans

std::string number(double value, bool plus) {
    return without_end_zeros(plus ? signed_text(value, cut_decimals) : fixed_text(value, cut_decimals));
}

/// Letters, digits and a few marks, which are safe in comments of every dialect.
std::string comment_text(std::string_view text) {
    std::string kept;
    for (const char c : text) {
        const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
                           c == '_' || c == '-' || c == ' ';
        kept += plain ? c : '_';
    }
    return kept;
}

/// Writes blocks in the form of a dialect.
class BlockWriter {
public:
    explicit BlockWriter(const CutProgramRules& rules)
        : rules_(rules), klartext_(rules.dialect == "klartext"), iso_(rules.dialect == "heidenhain-iso") {}

    void begin(const Vec2& first) {
        const std::string comment =
            fmt::format("profile of {}: add tool, spindle and work offset", comment_text(rules_.name));
        if (klartext_) {
            block("BEGIN PGM PROFILE MM");
            block("; " + comment);
        } else if (iso_) {
            text_ += "%PROFILE G71 *\n";
            block("; " + comment);
            block("G90");
        } else {
            const bool siemens = rules_.dialect == "siemens";
            if (rules_.dialect == "fanuc") text_ += "%\nO0001\n";
            block(siemens ? "; " + comment : "(" + comment + ")");
            block(siemens ? "G710 G90 G94 G17" : "G21 G90 G94 G17");
        }
        rapid(axis('Z', rules_.clearance_z));
        rapid(axis('X', first.x()) + " " + axis('Y', rules_.y));
        at_ = {first.x(), rules_.clearance_z};
        line(first, true);
    }
    void line(const Vec2& to, bool with_feed = false) {
        std::string words;
        if (axis('X', to.x()) != axis('X', at_.x())) words += axis('X', to.x()) + " ";
        if (axis('Z', to.y()) != axis('Z', at_.y())) words += axis('Z', to.y()) + " ";
        at_ = to;
        if (words.empty()) return;
        words.pop_back();
        const std::string feed = with_feed ? fmt::format(" F{:g}", rules_.feed) : "";
        block((klartext_ ? "L " : iso_ ? "G01 " : "G1 ") + words + feed);
    }
    void span(const CutSpan& span) {
        const Vec2 second = 3 * (span.end - span.begin) - 2 * span.begin_slope - span.end_slope;
        const Vec2 third = span.begin_slope + span.end_slope - 2 * (span.end - span.begin);
        if (klartext_) {
            // From the end: t runs from 1 to 0.
            const Vec2 k3 = -third, k2 = second + 3 * third, k1 = -(span.begin_slope + 2 * second + 3 * third);
            const auto factors = [&](char name, int i) {
                return fmt::format("K3{0}{1:+.9f} K2{0}{2:+.9f} K1{0}{3:+.9f}", name, k3[i], k2[i], k1[i]);
            };
            block(fmt::format("SPL {} {} {} {}", axis('X', span.end.x()), axis('Z', span.end.y()), factors('X', 0),
                              factors('Z', 1)));
        } else {
            const auto factors = [&](char name, int i) {
                return fmt::format("PO[{}]=({},{:.9f},{:.9f})", name, number(span.end[i], false), second[i], third[i]);
            };
            block(fmt::format("POLY {} {}", factors('X', 0), factors('Z', 1)));
        }
        at_ = span.end;
    }
    /// Consecutive Bézier curves: each knot between two of them three times, so that each is shaped by its own points.
    void nurbs(std::span<const CutSpan> spans) {
        std::vector<std::string> points, knots{"0"};
        const auto add = [&](const Vec2& at) { points.push_back(axis('X', at.x()) + " " + axis('Z', at.y())); };
        add(spans.front().begin);
        for (const CutSpan& span : spans) {
            knots.insert(knots.end(), 3, fmt::format("{}", &span - spans.data()));
            add(span.begin + span.begin_slope / 3);
            add(span.end - span.end_slope / 3);
            add(span.end);
        }
        knots.insert(knots.end(), 4, fmt::format("{}", spans.size()));
        for (const std::string& line : fanuc_nurbs_lines(points, knots)) block(line);
        block("G1");
        at_ = spans.back().end;
    }
    [[nodiscard]] std::string end() {
        rapid(axis('Z', rules_.clearance_z));
        if (klartext_) {
            block("M30");
            block("END PGM PROFILE MM");
        } else if (iso_) {
            block("M30");
            text_ += "N99999999 %PROFILE G71 *\n";
        } else {
            block("M30");
            if (rules_.dialect == "fanuc") text_ += "%\n";
        }
        return std::move(text_);
    }
    /// Whether a place has the same text as the present position.
    [[nodiscard]] bool stands_at(const Vec2& place) const {
        return axis('X', place.x()) == axis('X', at_.x()) && axis('Z', place.y()) == axis('Z', at_.y());
    }

private:
    [[nodiscard]] std::string axis(char name, double value) const { return name + number(value, klartext_ || iso_); }
    void rapid(const std::string& words) {
        block(klartext_ ? "L " + words + " R0 FMAX" : (iso_ ? "G00 " : "G0 ") + words);
    }
    void block(const std::string& words) {
        if (klartext_)
            text_ += fmt::format("{} {}\n", number_++, words);
        else if (iso_)
            text_ += words.front() == ';' ? words + "\n" : fmt::format("N{} {} *\n", 10 * ++number_, words);
        else
            text_ += words + "\n";
    }

    const CutProgramRules& rules_;
    bool klartext_, iso_;
    int number_ = 0;
    Vec2 at_ = Vec2::Zero();
    std::string text_;
};

}  // namespace

bool writes_spans(std::string_view dialect) {
    return dialect == "siemens" || dialect == "klartext" || dialect == "fanuc";
}

std::string line_program(const std::vector<Vec2>& points, const CutProgramRules& rules) {
    BlockWriter writer(rules);
    writer.begin(points.front());
    for (const Vec2& point : points) writer.line(point);
    return writer.end();
}

std::string span_program(const std::vector<CutSpan>& spans, const CutProgramRules& rules) {
    BlockWriter writer(rules);
    writer.begin(spans.front().begin);
    const bool knotted = rules.dialect == "fanuc";
    for (std::size_t first = 0; first < spans.size();) {
        if (!writer.stands_at(spans[first].begin)) writer.line(spans[first].begin);
        std::size_t end = first + 1;
        // Connected spans become one NURBS.
        while (knotted && end < spans.size() && (spans[end].begin - spans[end - 1].end).norm() < same_place) ++end;
        if (knotted)
            writer.nurbs(std::span(spans).subspan(first, end - first));
        else
            writer.span(spans[first]);
        first = end;
    }
    return writer.end();
}

}  // namespace clsurf
