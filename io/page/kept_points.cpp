#include "io/page/kept_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/block.h"
#include "core/extremes.h"

namespace clsurf {
namespace {

/// The longest chord between kept points of a cut, in step-overs: with longer ones the triangles between passes are
/// too long to follow the surface. If there is no room for so many points, the chord grows up to the last value.
constexpr std::array<double, 4> longest_chords{3, 6, 12, 24};
constexpr double most_for_chords = 0.75;    ///< share of the limit that chords may take
constexpr PointIndex share_of_defects = 4;  ///< one in this many points may be of defects that are kept whole
constexpr PointIndex windows_at_once = 64;

using Marks = Column<std::uint8_t>;  ///< per point: 1 if it is kept

void mark(Marks& marks, PointIndex i) { marks[static_cast<std::size_t>(i)] = 1; }

bool has_position(const Positions& p, PointIndex i) {
    const auto at = static_cast<std::size_t>(i);
    return p.x[at] == p.x[at] && p.y[at] == p.y[at] && p.z[at] == p.z[at];
}

/// Where a column is lowest and highest in [first, last]; −1: no value in the range.
PointRange extremes(const Column<float>& values, PointIndex first, PointIndex last) {
    const std::span<const float> all(values.data() + first, static_cast<std::size_t>(last - first + 1));
    const auto [low, high] = extremes_of(all);
    if (!(low <= high)) return {-1, -1};
    const auto place = [&](float value) { return first + (std::find(all.begin(), all.end(), value) - all.begin()); };
    return {place(low), place(high)};
}

void mark_extremes(Marks& marks, const Column<float>& values, PointIndex first, PointIndex last) {
    const PointRange at = extremes(values, first, last);
    if (at.first >= 0) mark(marks, at.first);
    if (at.last >= 0) mark(marks, at.last);
}

/// Calls take(range) for the points of a defect and of the adjacent passes.
template <typename Take>
void for_each_section(const Defect& defect, const Take& take) {
    for (const std::vector<DefectSection>* sections : {&defect.sections, &defect.neighbours}) {
        for (const DefectSection& section : *sections) take(section.points);
    }
}

/// Marks all points of the defects that fit into `room`; returns the number of these defects. A defect that is too large does
/// not stop smaller ones.
std::size_t mark_whole_defects(Marks& marks, std::span<const Defect> defects, PointIndex room) {
    std::size_t whole = 0;
    for (const Defect& defect : defects) {
        PointIndex needed = 0;
        for_each_section(defect, [&](PointRange run) {
            const auto first = marks.begin() + run.first;
            needed += std::count(first, first + (run.last - run.first + 1), std::uint8_t{0});
        });
        if (needed > room) continue;
        for_each_section(defect, [&](PointRange run) {
            for (PointIndex i = run.first; i <= run.last; ++i) mark(marks, i);
        });
        room -= needed;
        ++whole;
    }
    return whole;
}

/// The points that are kept for any window, except whole defects and starts of lines.
Marks lasting_marks(const ClSurface& surface, std::span<const Field> fields, std::span<const Defect> defects) {
    const PointIndex count = surface.positions.size();
    Marks marks(static_cast<std::size_t>(count), 0);
    for (const Pass& pass : surface.passes) {
        mark(marks, pass.first);
        mark(marks, pass.last);
    }
    for (const Defect& defect : defects) {
        for_each_section(defect, [&](PointRange run) {
            mark(marks, run.first);
            mark(marks, run.last);
        });
        mark(marks, defect.point);
    }
    const Positions& p = surface.positions;
    for (const Column<float>* axis : {&p.x, &p.y, &p.z}) mark_extremes(marks, *axis, 0, count - 1);
    for (const Field& field : fields) mark_extremes(marks, field.values, 0, count - 1);
    return marks;
}

/// The first point of each run of points with one line.
void mark_line_starts(Marks& marks, const LineMap& lines) {
    for_each_block(static_cast<PointIndex>(marks.size()), [&](PointIndex first, PointIndex last) {
        Column<LineNumber> numbers(static_cast<std::size_t>(last - first));
        lines.read(first, numbers);
        LineNumber before = first > 0 ? lines.line_at(first - 1) : 0;
        for (PointIndex i = first; i < last; ++i) {
            const LineNumber now = numbers[static_cast<std::size_t>(i - first)];
            if (now != before || i == 0) mark(marks, i);
            before = now;
        }
    });
}

/// Marks points by windows of one pass.
class Windows {
public:
    /// `longest_chord` [mm].
    Windows(const ClSurface& surface, std::span<const Field> fields, double longest_chord)
        : surface_(surface), fields_(fields), longest_chord_(static_cast<float>(longest_chord)) {}

    [[nodiscard]] std::size_t fields() const { return fields_.size(); }

    void add(Marks& marks, PointIndex window) const {
        for (const Pass& pass : surface_.passes) {
            const PointIndex windows = (pass.size() + window - 1) / window;
            parallel_for(windows, windows_at_once, [&](std::int64_t begin, std::int64_t end) {
                for (std::int64_t w = begin; w < end; ++w) {
                    const PointIndex first = pass.first + w * window;
                    add_window(marks, pass, {first, std::min(pass.last, first + window - 1)});
                }
            });
        }
    }

private:
    void add_window(Marks& marks, const Pass& pass, PointRange window) const {
        mark(marks, window.first);
        for (const Field& field : fields_) mark_extremes(marks, field.values, window.first, window.last);
        if (pass.kind != PassKind::cut || longest_chord_ <= 0) return;
        const Positions& p = surface_.positions;
        PointIndex from = window.first;
        for (PointIndex i = window.first + 1; i <= window.last; ++i) {
            if ((p[i] - p[from]).norm() > longest_chord_) {
                from = std::max(from + 1, i - 1);
                mark(marks, from);
            }
        }
    }

    const ClSurface& surface_;
    std::span<const Field> fields_;
    float longest_chord_;
};

PointIndex count_of(const Marks& marks) {
    return static_cast<PointIndex>(std::count(marks.begin(), marks.end(), std::uint8_t{1}));
}

PointIndex longest_pass(const Passes& passes) {
    PointIndex longest = 2;
    for (const Pass& pass : passes) longest = std::max(longest, pass.size());
    return longest;
}

/// Marks with the shortest windows that keep at most `most` points. If none are long enough, a window is a
/// whole pass. Returns the window.
PointIndex mark_windows(Marks& marks, const Marks& lasting, const Windows& windows, const Passes& passes,
                        PointIndex most) {
    const PointIndex longest = longest_pass(passes);
    const auto fits = [&](PointIndex window) {
        marks = lasting;
        windows.add(marks, window);
        return count_of(marks) <= most;
    };
    // A window keeps its first point and about half of the extremes of the fields.
    const auto guess = static_cast<PointIndex>(windows.fields() + 1) * static_cast<PointIndex>(marks.size()) /
                       std::max<PointIndex>(most, 1);
    PointIndex high = 2;
    while (high < std::min(guess, longest)) high *= 2;
    if (fits(high)) {
        while (high > 2 && fits(high / 2)) high /= 2;
    } else {
        do high *= 2;
        while (!fits(high) && high < longest);
    }
    PointIndex low = high / 2;
    for (int halved = 0; halved < 5 && high - low > 1; ++halved) {
        const PointIndex middle = low + (high - low) / 2;
        (fits(middle) ? high : low) = middle;
    }
    (void)fits(high);
    return high;
}

}  // namespace

KeptPoints keep_points(const ClSurface& surface, const LineMap& lines, std::span<const Field> fields,
                       std::span<const Defect> defects, PointIndex most) {
    const PointIndex count = surface.positions.size();
    KeptPoints kept;
    for (PointIndex i = 0; i < count; ++i) kept.all += has_position(surface.positions, i) ? 1 : 0;
    kept.defects = kept.whole_defects = defects.size();
    Marks marks(static_cast<std::size_t>(count), 1);
    if (kept.all > most) {
        Marks lasting = lasting_marks(surface, fields, defects);
        kept.whole_defects = mark_whole_defects(lasting, defects, most / share_of_defects);
        Marks with_lines = lasting;
        mark_line_starts(with_lines, lines);
        kept.line_starts = count_of(with_lines) <= most / 2;
        if (kept.line_starts) lasting = std::move(with_lines);
        for (const double chord : longest_chords) {
            const Windows windows(surface, fields, chord * surface.step_over);
            marks = lasting;
            windows.add(marks, longest_pass(surface.passes));
            const bool room_for_windows =
                static_cast<double>(count_of(marks)) <= most_for_chords * static_cast<double>(most);
            if (!room_for_windows && chord != longest_chords.back()) continue;
            kept.window = mark_windows(marks, lasting, windows, surface.passes, most);
            break;
        }
    }
    for (PointIndex i = 0; i < count; ++i) {
        if (marks[static_cast<std::size_t>(i)] != 0 && has_position(surface.positions, i)) kept.points.push_back(i);
    }
    return kept;
}

}  // namespace clsurf
