#include "pipeline/followed_run.h"

#include <algorithm>
#include <utility>

#include "pipeline/contacts.h"
#include "pipeline/settled_defect.h"
#include "pipeline/signals_of.h"
#include "predictor/candidates.h"

namespace clsurf {
namespace {

constexpr std::int64_t most_edge_passes = 6;  ///< passes at the start of a window without their earlier neighbours

PartRules without_refusal(PartRules rules) {
    rules.accept_foreign = true;
    return rules;
}

bool overlap(const PointRange& a, const PointRange& b) { return a.first <= b.last && b.first <= a.last; }

void shift_sections(std::vector<DefectSection>& sections, PointIndex points, std::int64_t passes) {
    for (DefectSection& section : sections) {
        section.points = {section.points.first + points, section.points.last + points};
        section.pass += passes;
    }
}

/// Converts points and passes of a defect from the window to the log.
void shift(Defect& defect, PointIndex points, std::int64_t passes) {
    defect.point += points;
    shift_sections(defect.sections, points, passes);
    shift_sections(defect.neighbours, points, passes);
}

bool is_motion(const Defect& defect) {
    return defect.quantity == Quantity::speed || defect.quantity == Quantity::acceleration;
}

std::int64_t last_pass(const Defect& defect) {
    std::int64_t last = 0;
    for (const DefectSection& section : defect.sections) last = std::max(last, section.pass);
    return last;
}

}  // namespace

std::size_t ResolvedFindings::withdrawn() const {
    return static_cast<std::size_t>(
        std::count_if(defects.begin(), defects.end(), [](const auto& there) { return there.empty(); }));
}

FollowedRun::FollowedRun(Program program, Log first, FollowRules rules)
    : rules_(std::move(rules)), part_(assemble(std::move(program), std::move(first), without_refusal(rules_.part))) {}

std::vector<ProvisionalDefect> FollowedRun::judge(Log window, PointIndex first) {
    exchange_log(part_, std::move(window), rules_.part);
    const ClSurface surface = stitch(part_);
    count_passes_left(surface, first);
    choose_window(surface, first);
    if (!foreign().empty() || surface.step_over <= 0) return {};
    const PartSignals read = signals_of(part_, surface, rules_.measured);
    QualityReport report = find_defects(part_, surface, read, rules_.quality);
    std::sort(report.defects.begin(), report.defects.end(),
              [](const Defect& a, const Defect& b) { return a.point < b.point; });
    const ArcLength arc_length(surface.positions);
    const double settling = settling_distance(surface, report.thresholds.usual_speed * part_.log.period);
    const DefectSurroundings around{surface, read.signals, arc_length, settling,
                                    [&](PointIndex point) { return has_defect(first + point); }};
    const std::int64_t edge = first > 0 ? std::min(most_edge_passes, report.passes / 3) : 0;

    QualityReport fresh;
    std::vector<PointIndex> needed;
    for (Defect& defect : report.defects) {
        if (last_pass(defect) <= edge) continue;
        Defect counted = defect;
        shift(counted, first, passes_before_);
        if (const std::int64_t finding = finding_of(counted); finding > 0) {
            remember(counted, finding);
            continue;
        }
        const std::optional<PointIndex> last = last_point_needed(defect, around);
        if (!last) continue;
        remember(counted, ++findings_);
        fresh.defects.push_back(std::move(defect));
        needed.push_back(*last + first);
    }
    if (fresh.defects.empty()) return {};
    if (part_.tool) PartContacts(part_, surface, *part_.tool).locate(fresh);
    std::vector<ProvisionalDefect> found;
    for (std::size_t k = 0; k < fresh.defects.size(); ++k) {
        shift(fresh.defects[k], first, passes_before_);
        const auto number = findings_ - static_cast<std::int64_t>(fresh.defects.size() - k) + 1;
        found.push_back({number, std::move(fresh.defects[k]), needed[k], first + part_.log.records});
    }
    return found;
}

/// Counts the cut passes that have left the window, and moves their findings to left_.
void FollowedRun::count_passes_left(const ClSurface& surface, PointIndex first) {
    passes_before_ +=
        std::count_if(pass_ends_.begin(), pass_ends_.end(), [&](PointIndex last) { return last < first; });
    pass_ends_.clear();
    for (const Pass& pass : surface.passes) {
        if (pass.kind == PassKind::cut) pass_ends_.push_back(first + pass.last);
    }
    const auto behind = std::partition(sections_.begin(), sections_.end(),
                                       [&](const Section& section) { return section.points.last >= first; });
    left_.insert(left_.end(), behind, sections_.end());
    sections_.erase(behind, sections_.end());
}

void FollowedRun::choose_window(const ClSurface& surface, PointIndex first) {
    const PointIndex count = surface.positions.size();
    PointIndex from = 0;
    std::int64_t passes = 0;
    for (std::size_t k = surface.passes.size(); k-- > 0 && from == 0;) {
        const Pass& pass = surface.passes[k];
        if (pass.kind != PassKind::cut) continue;
        ++passes;
        const PointIndex points = count - pass.first;
        if (passes > rules_.passes || (points > rules_.points && passes >= rules_.least_passes)) from = pass.first;
    }
    kept_from_ = first + std::max(from, count - rules_.most_points);
}

/// The finding to which a defect belongs, or from which it has grown; 0: none.
std::int64_t FollowedRun::finding_of(const Defect& defect) const {
    if (defect.systematic) return systematic_;
    for (const DefectSection& section : defect.sections) {
        const auto known = std::find_if(sections_.begin(), sections_.end(), [&](const Section& before) {
            return before.motion == is_motion(defect) && overlap(before.points, section.points);
        });
        if (known != sections_.end()) return known->finding;
    }
    return 0;
}

bool FollowedRun::has_defect(PointIndex point) const {
    return std::any_of(sections_.begin(), sections_.end(), [&](const Section& section) {
        return section.points.first <= point && point <= section.points.last;
    });
}

/// A systematic lag is everywhere and must not hide other findings.
void FollowedRun::remember(const Defect& defect, std::int64_t finding) {
    if (defect.systematic) {
        systematic_ = finding;
        return;
    }
    for (const DefectSection& section : defect.sections) {
        const auto known = std::find_if(sections_.begin(), sections_.end(), [&](const Section& before) {
            return before.finding == finding && overlap(before.points, section.points);
        });
        if (known == sections_.end()) {
            sections_.push_back({section.points, finding, is_motion(defect)});
        } else {
            known->points = {std::min(known->points.first, section.points.first),
                             std::max(known->points.last, section.points.last)};
        }
    }
}

ResolvedFindings FollowedRun::resolve(const QualityReport& complete) const {
    std::vector<Section> all = left_;
    all.insert(all.end(), sections_.begin(), sections_.end());
    std::sort(all.begin(), all.end(), [](const Section& a, const Section& b) { return a.points.last < b.points.last; });
    PointIndex longest = 0;
    for (const Section& section : all) longest = std::max(longest, section.points.size());
    ResolvedFindings result;
    result.defects.resize(static_cast<std::size_t>(findings_));
    for (std::size_t d = 0; d < complete.defects.size(); ++d) {
        const Defect& defect = complete.defects[d];
        bool known = false;
        const auto lies_at = [&](std::int64_t finding) {
            std::vector<std::size_t>& there = result.defects[static_cast<std::size_t>(finding - 1)];
            if (there.empty() || there.back() != d) there.push_back(d);
            known = true;
        };
        if (defect.systematic && systematic_ > 0) lies_at(systematic_);
        for (const DefectSection& section : defect.sections) {
            auto at = std::lower_bound(all.begin(), all.end(), section.points.first,
                                       [](const Section& s, PointIndex point) { return s.points.last < point; });
            for (; at != all.end() && at->points.last - longest <= section.points.last; ++at) {
                // A systematic lag covers nearly everything, so it matches other lags only.
                if (overlap(at->points, section.points) && !(defect.systematic && at->motion)) lies_at(at->finding);
            }
        }
        if (!known) result.late.push_back(d);
    }
    return result;
}

}  // namespace clsurf
