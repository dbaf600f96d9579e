#include "measured/compared_marks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "core/units.h"
#include "machined/as_machined_report.h"
#include "machined/form.h"

namespace clsurf {
namespace {

constexpr double passes_aside = 6.5;     ///< of a mark's profile, as for its predicted depth
constexpr double crossing = 0.5;         ///< step-overs: a profile crosses a mark if its contact is this near
constexpr double least_across = 0.5;     ///< cosine between a profile and the direction across the feed
constexpr double mark_tolerance = 0.25;  ///< of a mark's depth, as for its predicted depth
// times_noise, present: docs/howto/measured.md#the-comparison.
constexpr double times_noise = 3;     ///< times the noise: least depth of a judged mark
constexpr double least_depth = 1e-4;  ///< [mm] and at least this depth
constexpr double present = 0.5;       ///< least share of the predicted depth

/// A measured point of a mark, and the passes there.
struct Crossing {
    PointIndex point = 0;
    Vec2 place = Vec2::Zero();
    AcrossFeed across;
};

/// Where a measurement crosses a section of a mark: the point whose contact is nearest to its profile, or to the middle of its
/// map.
std::optional<Crossing> crossing_of(const DefectSection& section, const MeasuredData& data,
                                    const AlignedHeights& measured, const AsMachinedSurface& as_machined,
                                    const Signals& signals) {
    const bool profile = data.kind == MeasuredKind::profile;
    const ProfileRow row = profile ? measured.own_row(0) : ProfileRow{};
    const Vec2 aside(-row.along.y(), row.along.x());
    const double step_over = as_machined.surface().step_over;
    std::optional<Crossing> found;
    double least = profile ? crossing * step_over : infinite;
    for (PointIndex i = section.points.first; i <= section.points.last; ++i) {
        const Vec3 contact = as_machined.contact(i);
        if (!contact.allFinite()) continue;
        const Vec2 place = contact.head<2>();
        const double distance = profile ? std::abs(aside.dot(place - row.from)) : (place - measured.middle()).norm();
        const Vec2 on_row = profile ? Vec2(row.from + row.along.dot(place - row.from) * row.along) : place;
        if (!(distance < least) || !std::isfinite(measured.at(on_row))) continue;
        const AcrossFeed across = across_feed(as_machined, signals, i);
        if (!across.known) continue;
        least = distance;
        found = Crossing{i, on_row, across};
    }
    return found;
}

class MarkJudge {
public:
    MarkJudge(const MeasuredData& data, const AlignedHeights& measured, const AsMachinedSurface& as_machined,
              double noise)
        : data_(data), measured_(measured), as_machined_(as_machined), noise_(noise) {}

    [[nodiscard]] ComparedMark judge(const Defect& defect, const Crossing& crossed) const {
        ComparedMark mark;
        mark.pit = defect.pit;
        const Vec3 contact = as_machined_.contact(crossed.point);
        mark.place = Vec3(crossed.place.x(), crossed.place.y(), contact.z());
        const bool profile = data_.kind == MeasuredKind::profile;
        Vec2 along = crossed.across.direction;
        double step_over = crossed.across.step_over;
        if (profile) {
            const ProfileRow own = measured_.own_row(0);
            mark.along = own.along.dot(crossed.place - own.from);
            const double across = std::abs(own.along.dot(along));
            if (across < least_across) {
                mark.reason = "the profile runs along the passes there";
                return mark;
            }
            along = own.along;
            step_over /= across;
        }
        const double step = step_over / steps_per_pass;
        const ProfileRow row{crossed.place - passes_aside * step_over * along, along, step,
                             static_cast<std::int64_t>(2 * passes_aside * steps_per_pass) + 1};
        const Form::Of of = form_about_mark(as_machined_, crossed.point);
        const ComparedProfile both =
            deviations_of_both(measured_, as_machined_, row, of, mark_tolerance * std::abs(defect.depth));
        mark.predicted = mark_depth(both.predicted, step, step_over, defect.pit).depth;
        mark.measured = mark_depth(both.measured, step, step_over, defect.pit).depth;
        state(mark);
        return mark;
    }

private:
    void state(ComparedMark& mark) const {
        const double least = std::max(least_depth, times_noise * noise_);
        if (!std::isfinite(mark.predicted))
            mark.reason = "its predicted depth there is not known";
        else if (mark.predicted < least)
            mark.reason =
                fmt::format("{:.2f} µm {} there, and less than {:.2f} µm cannot be distinguished from the scatter",
                            mark.predicted * um_per_mm, deep_or_high(mark.pit), least * um_per_mm);
        else if (!std::isfinite(mark.measured))
            mark.reason = "too few places next to it were measured";
        else
            mark.state = mark.measured >= present * mark.predicted ? MarkState::found : MarkState::missing;
    }

    const MeasuredData& data_;
    const AlignedHeights& measured_;
    const AsMachinedSurface& as_machined_;
    double noise_;
};

}  // namespace

std::vector<ComparedMark> compare_marks(const MeasuredData& data, const AlignedHeights& measured,
                                        const AsMachinedSurface& as_machined, const Signals& signals,
                                        const QualityReport& report, double noise) {
    std::vector<ComparedMark> marks;
    if (data.kind == MeasuredKind::points) return marks;
    const MarkJudge judge(data, measured, as_machined, noise);
    for (std::size_t k = 0; k < report.defects.size(); ++k) {
        std::optional<ComparedMark> deepest;
        for (const DefectSection& section : report.defects[k].sections) {
            const std::optional<Crossing> crossed = crossing_of(section, data, measured, as_machined, signals);
            if (!crossed) continue;
            ComparedMark mark = judge.judge(report.defects[k], *crossed);
            mark.defect = k;
            const bool judged = mark.state != MarkState::not_judged;
            if (!deepest ||
                (judged && (deepest->state == MarkState::not_judged || mark.predicted > deepest->predicted)))
                deepest = std::move(mark);
        }
        if (deepest) marks.push_back(std::move(*deepest));
    }
    return marks;
}

}  // namespace clsurf
