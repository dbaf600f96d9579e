#include "viz/defect_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "viz/depth_buffer.h"
#include "viz/label_placer.h"
#include "viz/leader_slots.h"
#include "viz/mark_strokes.h"

namespace clsurf::viz {
namespace {

constexpr double least_mark_width = 0.22;  ///< least width of a mark, in text sizes
constexpr double region_width = 0.08;      ///< width of the lines of a region
constexpr double region_share = 0.5;       ///< share of the colour in a region
constexpr double hidden_width = 0.14;      ///< width of the dots of hidden parts
constexpr double dot_every = 0.4;          ///< distance between dots, in text sizes
constexpr double axes_height = 6.2;        ///< height of the picture's axes next to the key, in text sizes
constexpr double name_width = 15;          ///< width of a name in a column, in text sizes
constexpr double with_lines = 2.5, with_place = 3.45, with_cause = 4.4;  ///< heights of names in columns, in text sizes
constexpr double leader_clearance = 0.5;  ///< distance from a leader to the anchor of another one, in text sizes
constexpr double lightest = 0.45;         ///< share of the colour in the weakest mark; the rest is white

Rgb mixed(const Rgb& rgb, double share) {
    Rgb result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = static_cast<std::uint8_t>(std::lround(share * rgb[k] + (1 - share) * 255));
    return result;
}

class DefectDrawer {
public:
    DefectDrawer(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Rect& room, const Look& look,
                 const MapLayout& layout)
        : sheet_(sheet),
          map_(map),
          panel_(panel),
          room_(room),
          look_(look),
          layout_(layout),
          marks_(map.defects->marks),
          drawn_(marks_.size()),
          ink_(ink_for(look.background)),
          corner_(panel.rect.x, panel.rect.y),
          depth_(panel.geometry, panel.camera) {}

    /// Returns how many numbers have no room.
    int draw() {
        std::vector<std::optional<Vec2>> anchors(marks_.size());
        const std::size_t before = sheet_.lines.size();
        // In increasing order of strength, so that the strongest is on top; regions below all others.
        for (const bool region : {true, false}) {
            for (std::size_t k = marks_.size(); k-- > 0;) {
                if (marks_[k].region == region) anchors[k] = draw_mark(k);
            }
        }
        // A mark is as wide as its strip of the part, and may extend beyond the edge of the picture.
        for (std::size_t k = before; k < sheet_.lines.size(); ++k) sheet_.lines[k].clip = panel_.rect;
        if (!look_.legend) return 0;
        if (layout_.arrangement == Arrangement::tall)
            tabulate(anchors);
        else
            name(anchors);
        return without_room_;
    }

private:
    /// The colour of a kind, readable on the background: lighter on a dark one.
    [[nodiscard]] Rgb ink_of(const DefectMark& mark) const {
        constexpr double share_on_dark = 0.55;
        const Rgb& rgb = kind_of(mark).rgb;
        return ink_ == ink_for({255, 255, 255}) ? rgb : mixed(rgb, share_on_dark);
    }

    [[nodiscard]] const DefectKind& kind_of(const DefectMark& mark) const { return map_.defects->kinds[mark.kind]; }

    void add_band(const Band& band, const Rgb& rgb, Level level) {
        sheet_.lines.push_back({band.left, 0, rgb, level, {}, band.right});
    }

    void add_dashes(const Band& band, double on, double every, const Rgb& rgb) {
        const double length = length_of(band);
        for (double at = 0; at < length; at += every)
            add_band(part_of(band, at, std::min(at + on, length)), rgb, Level::mark);
    }

    /// Dots of constant width, independent of the band's width.
    void add_dots(const Band& band, const Rgb& rgb) {
        const double width = hidden_width * layout_.text;
        const double length = length_of(band);
        for (double at = 0; at < length; at += dot_every * layout_.text) {
            const Band dot = part_of(band, at, std::min(at + width, length));
            sheet_.lines.push_back({dot.centre_line(), width, rgb, Level::mark});
        }
    }

    void add_stroke(const Band& band, const DefectKind& kind, const Rgb& rgb) {
        const double t = layout_.text;
        switch (kind.style) {
            case StrokeStyle::solid: add_band(band, rgb, Level::mark); break;
            case StrokeStyle::dashed: add_dashes(band, 0.8 * t, 1.1 * t, rgb); break;
            case StrokeStyle::dotted: add_dashes(band, 0.2 * t, 0.7 * t, rgb); break;
            case StrokeStyle::double_line:
                add_band(band, rgb, Level::mark);
                add_band(narrowed(band, 0.34), {255, 255, 255}, Level::inlay);
                break;
        }
    }

    /// Returns the start of the leader: on the section that the text describes, if it is in the picture. Nothing: no section
    /// is visible.
    std::optional<Vec2> draw_mark(std::size_t index) {
        DefectMark& mark = marks_[index];
        const Rgb rgb =
            mixed(kind_of(mark).rgb, mark.region ? region_share : lightest + (1 - lightest) * mark.strength);
        std::optional<Vec2> anchor;
        double highest = -1;
        bool anchor_described = false;
        for (const PointRange& section : mark.sections) {
            const bool described = mark.point < 0 || (mark.point >= section.first && mark.point <= section.last);
            const double least = least_mark_width * layout_.text;
            for (const Stroke& stroke :
                 strokes_of(*map_.surface, section, panel_.camera, corner_, look_, depth_, least)) {
                // Of the other sections of a region only visible parts are drawn: dots of its many lines would tangle.
                if (stroke.hidden && mark.region && !described) continue;
                draw_stroke(mark, stroke, rgb);
                if (!mark.region) drawn_[index].push_back({stroke, described});
                // The anchor is on the longest part, preferably a visible one.
                const double length = length_of(stroke.band);
                const double rank = (described ? 2 : 0) + (stroke.hidden ? 0 : 1) + length / (1 + length);
                if (rank <= highest) continue;
                highest = rank;
                anchor_described = described;
                anchor = part_of(stroke.band, 0.5 * length, length).centre(0);
            }
        }
        if (!anchor) return anchor;
        if (!anchor_described) {
            mark.lines = "strongest outside the picture";
            mark.place.clear();
        } else if (mark.region && mark.point >= 0) {
            // A section of a region may be as long as its pass.
            const Vec3 place = map_.surface->positions.absolute(mark.point);
            if (shows(panel_.camera, look_, place)) anchor = corner_ + panel_.camera.pixel(place);
        }
        return anchor;
    }

    /// Whether a stronger mark covers a place of a mark.
    [[nodiscard]] bool is_covered(std::size_t index, const Vec2& at) const {
        const auto covers_it = [&](const DrawnStroke& drawn) {
            return !drawn.stroke.hidden && covers(drawn.stroke.band, at);
        };
        return std::any_of(drawn_.begin(), drawn_.begin() + static_cast<std::ptrdiff_t>(index),
                           [&](const auto& strokes) { return std::any_of(strokes.begin(), strokes.end(), covers_it); });
    }

    /// Moves the anchors of named marks that stronger ones cover to a free place, if possible on the section that the text
    /// describes.
    void uncover(const std::vector<std::size_t>& named, std::vector<std::optional<Vec2>>& anchors) const {
        for (const std::size_t k : named) {
            if (marks_[k].region || !is_covered(k, *anchors[k])) continue;
            int highest = -1;
            for (const DrawnStroke& drawn : drawn_[k]) {
                const int rank = (drawn.described ? 2 : 0) + (drawn.stroke.hidden ? 0 : 1);
                if (rank <= highest) continue;
                const double length = length_of(drawn.stroke.band);
                for (const double share : {0.5, 0.3, 0.7, 0.1, 0.9}) {
                    const Vec2 at = part_of(drawn.stroke.band, share * length, length).centre(0);
                    if (is_covered(k, at)) continue;
                    anchors[k] = at;
                    highest = rank;
                    break;
                }
            }
        }
    }

    void draw_stroke(const DefectMark& mark, const Stroke& stroke, const Rgb& rgb) {
        if (stroke.hidden) {
            any_hidden_ = true;
            add_dots(stroke.band, rgb);
        } else if (mark.region) {
            regions_.insert(mark.kind);
            sheet_.lines.push_back({stroke.band.centre_line(), region_width * layout_.text, rgb, Level::area});
        } else {
            add_stroke(stroke.band, kind_of(mark), rgb);
        }
    }

    void text(double x, double y, const std::string& words, double size, bool bold, const Rgb& rgb,
              double width = std::numeric_limits<double>::infinity()) {
        const double room = std::min(width, look_.width - 0.4 * layout_.text - x);
        sheet_.texts.push_back(fitted({x, y, words, size, Align::left, bold, rgb}, room));
    }

    void name(std::vector<std::optional<Vec2>>& anchors) {
        const double t = layout_.text;
        const double highest = room_.y + room_.height - 0.6 * t;
        const double x = room_.x + 1.4 * t;
        const double bottom = std::max(add_key(x, 0.9 * t), axes_height * t);
        const double slot = 2.0 * t;
        const auto room = static_cast<std::size_t>(std::max(0.0, (highest - bottom - 0.8 * t) / slot));
        const std::vector<std::size_t> named = most_wanted(anchors, std::min(most_named_defects, room));
        uncover(named, anchors);
        std::vector<Vec2> from;
        for (const std::size_t k : named) from.push_back(*anchors[k]);
        const double line_end = x - 1.2 * t;
        const NameColumn column = place_names(from, slot, bottom + 0.8 * t, highest, line_end, leader_clearance * t);
        for (std::size_t k = 0; k < named.size(); ++k)
            add_name(marks_[named[k]], from[k], Vec2(x, column.slots[column.slot_of[k]]), line_end);
        tell_rest(anchors, named.size(), x, column.top - slot * static_cast<double>(named.size()) - 0.5 * t);
    }

    /// Which marks in the picture get a name: all regions, which are most of the drawn area, and the strongest of the others.
    [[nodiscard]] std::vector<std::size_t> most_wanted(const std::vector<std::optional<Vec2>>& anchors,
                                                       std::size_t most) const {
        std::vector<std::size_t> named;
        for (const bool region : {true, false}) {
            for (std::size_t k = 0; k < anchors.size() && named.size() < most; ++k) {
                if (anchors[k] && marks_[k].region == region) named.push_back(k);
            }
        }
        std::sort(named.begin(), named.end());
        return named;
    }

    void tell_rest(const std::vector<std::optional<Vec2>>& anchors, std::size_t named, double x, double y) {
        const auto outside = static_cast<std::size_t>(std::count(anchors.begin(), anchors.end(), std::nullopt));
        const std::size_t more = anchors.size() - outside - named;
        std::string words;
        if (more > 0) words = fmt::format("and {} more", more);
        if (outside > 0) words += fmt::format("{}{} outside the picture", words.empty() ? "" : ", ", outside);
        if (!words.empty()) text(x, y, words, layout_.small_text, false, faint(ink_, look_.background));
    }

    /// Height of a name in a column (`room` and result in text sizes): with its place and its cause, or less if
    /// the rows do not fit otherwise.
    static double row_height(double room, double rows) {
        for (const double height : {with_cause, with_place}) {
            if (rows * height <= room) return height;
        }
        return with_lines;
    }

    /// Names in columns below the part, in decreasing order of strength, row by row.
    void tabulate(std::vector<std::optional<Vec2>>& anchors) {
        constexpr std::size_t most_numbers = 24;  // more numbers would cover the part
        constexpr double rest = 1.6;              // height below the names, in text sizes
        const double t = layout_.text;
        const double top = room_.y + room_.height - 0.8 * t;
        const double lowest = add_key(layout_.margin, room_.y) + rest * t;
        const double width = room_.width - 2 * layout_.margin;
        const double columns = std::max(1.0, std::floor(width / (name_width * t)));
        const auto shown = std::count_if(anchors.begin(), anchors.end(), [](const auto& at) { return at.has_value(); });
        const double wanted = std::min(static_cast<double>(most_named_defects), static_cast<double>(shown));
        const double row = row_height((top - lowest) / t, std::ceil(wanted / columns));
        const double rows = std::max(0.0, std::floor((top - lowest) / (row * t)));
        const std::vector<std::size_t> named =
            most_wanted(anchors, std::min(most_numbers, static_cast<std::size_t>(rows * columns)));
        double below = top;
        for (std::size_t k = 0; k < named.size(); ++k) {
            const auto place = static_cast<double>(k);
            const double x = layout_.margin + std::fmod(place, columns) * width / columns;
            const double y = top - row * t * std::floor(place / columns);
            const DefectMark& mark = marks_[named[k]];
            add_texts_of(mark, Vec2(x, y - 1.0 * t), width / columns - t);
            const Rgb grey = faint(ink_, look_.background);
            if (row >= with_place)
                text(x, y - 2.5 * t, mark.place, layout_.small_text, false, grey, width / columns - t);
            if (row >= with_cause)
                text(x, y - 3.45 * t, mark.cause, layout_.small_text, false, grey, width / columns - t);
            below = y - row * t;
        }
        tell_rest(anchors, named.size(), layout_.margin, below - 0.6 * t);
        uncover(named, anchors);
        number_marks(named, anchors);
    }

    /// The numbers of marks next to their anchors, if there is room; those of a narrow part are above it, so that they hide
    /// nothing.
    void number_marks(const std::vector<std::size_t>& named, const std::vector<std::optional<Vec2>>& anchors) {
        constexpr double narrow = 10, rows_above = 2.6, axis_name = 7;  // in text sizes
        const double t = layout_.text;
        const double top = panel_.rect.y + panel_.rect.height;
        const bool above = panel_.rect.height < narrow * t;
        LabelPlacer placer(panel_.rect);
        LabelPlacer placer_above({panel_.rect.x, top, panel_.rect.width, rows_above * t});
        // Space for the name of the vertical axis.
        placer_above.take({panel_.rect.x, top, std::max(0.0, axis_name * t - panel_.rect.x), 1.8 * t});
        for (const std::size_t k : named)
            placer.take({anchors[k]->x() - 0.3 * t, anchors[k]->y() - 0.3 * t, 0.6 * t, 0.6 * t});
        for (const std::size_t k : named) {
            const DefectMark& mark = marks_[k];
            FlatText flat{0, 0, mark.number, 0.92 * t, Align::centre, true, ink_of(mark)};
            const Vec2 size(text_width(flat) + 0.3 * t, 1.15 * t);
            std::optional<Rect> rect;
            if (above) rect = placer_above.place(Vec2(anchors[k]->x(), top + 0.8 * t), size);
            if (!rect) rect = placer.place(*anchors[k] + Vec2(0, t), size);
            add_anchor(*anchors[k]);
            if (!rect) {
                ++without_room_;
                continue;
            }
            flat.x = rect->x + 0.5 * rect->width;
            flat.y = rect->y + 0.5 * rect->height;
            const Vec2 at(flat.x, flat.y);
            sheet_.lines.push_back({{*anchors[k], at}, 0.06 * t, faint(ink_, look_.background)});
            sheet_.lines.push_back({{at - Vec2(0.5 * size.x(), 0), at + Vec2(0.5 * size.x(), 0)},
                                    size.y(),
                                    look_.background,
                                    Level::halo});
            sheet_.texts.push_back(std::move(flat));
        }
    }

    void add_texts_of(const DefectMark& mark, const Vec2& at, double width) {
        const double t = layout_.text;
        text(at.x(), at.y() + 0.42 * t, mark.number + "   " + mark.label, 0.92 * t, true, ink_of(mark), width);
        text(at.x(), at.y() - 0.5 * t, mark.lines, layout_.small_text, false, faint(ink_, look_.background), width);
    }

    void add_name(const DefectMark& mark, const Vec2& from, const Vec2& at, double line_end) {
        const double t = layout_.text;
        const std::vector<Vec2> leader{from, Vec2(line_end, at.y()), Vec2(at.x() - 0.3 * t, at.y())};
        // The casing separates the leader from lines of the scales. It is below the marks: a leader may run along one.
        sheet_.lines.push_back({leader, 0.2 * t, look_.background, Level::casing});
        sheet_.lines.push_back({leader, 0.06 * t, faint(ink_, look_.background)});
        add_anchor(from);
        // A wide picture has room for a second column.
        const double second = at.x() + (name_width - 0.8) * t;
        const bool more = look_.width - second > 0.8 * name_width * t;
        add_texts_of(mark, at, more ? second - at.x() - 0.4 * t : std::numeric_limits<double>::infinity());
        if (!more) return;
        const Rgb grey = faint(ink_, look_.background);
        text(second, at.y() + 0.42 * t, mark.place, layout_.small_text, false, grey);
        text(second, at.y() - 0.5 * t, mark.cause, layout_.small_text, false, grey);
    }

    /// A white dot with a dark edge.
    void add_anchor(const Vec2& at) {
        const double radius = 0.16 * layout_.text;
        const auto add = [&](double r, const Rgb& rgb, Level level) {
            // A short wide line is a square, so a dot is composed of strips.
            constexpr int strips = 12;
            for (int k = 0; k < strips; ++k) {
                const double y = r * (2 * (k + 0.5) / strips - 1);
                const double half = std::sqrt(std::max(0.0, r * r - y * y));
                sheet_.lines.push_back({{at + Vec2(-half, y), at + Vec2(half, y)}, 2 * r / strips + 0.2, rgb, level});
            }
        };
        add(radius + 0.07 * layout_.text, ink_, Level::dot);
        add(radius, look_.background, Level::dot_fill);
    }

    /// The key of colours and strokes, upwards from `bottom`. Returns its upper end [px].
    double add_key(double x, double bottom) {
        const double t = layout_.text;
        const double row = 1.3 * layout_.small_text;
        double y = bottom + 0.5 * row;
        const Rgb grey = faint(ink_, look_.background);
        const auto band = [&] { return band_of({x, y}, {x + 2.2 * t, y}, 0.4 * t); };
        if (any_hidden_) {
            add_dots(band(), grey);
            text(x + 2.6 * t, y, "hidden", layout_.small_text, false, grey);
            y += row;
        }
        for (const std::size_t k : regions_) {
            const DefectKind& kind = map_.defects->kinds[k];
            for (const double aside : {-0.25 * t, 0.0, 0.25 * t})
                sheet_.lines.push_back({{Vec2(x, y + aside), Vec2(x + 2.2 * t, y + aside)},
                                        region_width * t,
                                        mixed(kind.rgb, region_share)});
            text(x + 2.6 * t, y, kind.name + ", systematic", layout_.small_text, false, grey);
            y += row;
        }
        for (std::size_t k = map_.defects->kinds.size(); k-- > 0; y += row) {
            const DefectKind& kind = map_.defects->kinds[k];
            add_stroke(band(), kind, kind.rgb);
            text(x + 2.6 * t, y, kind.name, layout_.small_text, false, grey);
        }
        return y;
    }

    Sheet& sheet_;
    const MapPanel& map_;
    const MeshPanel& panel_;
    Rect room_;
    const Look& look_;
    const MapLayout& layout_;
    std::vector<DefectMark> marks_;  ///< the text says if the strongest section is outside the picture
    struct DrawnStroke {
        Stroke stroke;
        bool described = false;  ///< the text describes its section
    };
    std::vector<std::vector<DrawnStroke>> drawn_;  ///< strokes of each mark that is not a region
    Rgb ink_;
    Vec2 corner_;
    DepthBuffer depth_;
    bool any_hidden_ = false;        ///< a part of a mark is dotted
    std::set<std::size_t> regions_;  ///< kinds that are drawn with thin lines
    int without_room_ = 0;           ///< numbers without room on the part
};

}  // namespace

int add_defects(Sheet& sheet, const MapPanel& map, const MeshPanel& panel, const Rect& room, const Look& look,
                const MapLayout& layout) {
    return DefectDrawer(sheet, map, panel, room, look, layout).draw();
}

}  // namespace clsurf::viz
