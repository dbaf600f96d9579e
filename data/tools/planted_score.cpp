#include "planted_score.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/cell_grid.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "program/interpreter.h"

namespace clsurf::planted {
namespace {

constexpr double found_within = 0.2;  ///< [mm]
constexpr double true_within = 0.8;   ///< [mm]
constexpr double share_enough = 0.3;
constexpr double planned_enough = 0.05;

/// Points by cell, to test whether a point is within a radius.
class Near {
public:
    Near(const PlantedLog& log, const std::vector<PointIndex>& points, double radius)
        : log_(log), radius_(radius), grid_(radius) {
        for (const PointIndex i : points) cells_[grid_.key(at(i))].push_back(i);
    }
    [[nodiscard]] bool has(const Vec3& p) const {
        bool found = false;
        grid_.for_each_near(p, [&](CellGrid::Key key) {
            const auto cell = cells_.find(key);
            if (found || cell == cells_.end()) return;
            found = std::any_of(cell->second.begin(), cell->second.end(),
                                [&](PointIndex i) { return (at(i) - p).norm() <= radius_; });
        });
        return found;
    }
    [[nodiscard]] double share(const std::vector<PointIndex>& points) const {
        const auto inside = std::count_if(points.begin(), points.end(), [&](PointIndex i) { return has(at(i)); });
        return points.empty() ? 0.0 : static_cast<double>(inside) / static_cast<double>(points.size());
    }
    [[nodiscard]] Vec3 at(PointIndex i) const {
        const auto k = static_cast<std::size_t>(i);
        return {log_.commanded[0][k], log_.commanded[1][k], log_.commanded[2][k]};
    }

private:
    const PlantedLog& log_;
    double radius_;
    CellGrid grid_;
    std::unordered_map<CellGrid::Key, std::vector<PointIndex>> cells_;
};

std::vector<PointIndex> points_of(const clsurf::Defect& defect) {
    std::vector<PointIndex> points;
    for (const DefectSection& section : defect.sections) {
        for (PointIndex i = section.points.first; i <= section.points.last; ++i) points.push_back(i);
    }
    return points;
}

Cause cause_of(Kind kind) {
    switch (kind) {
        case Kind::speed: return Cause::feed_drop;
        case Kind::oscillation: return Cause::oscillation;
        case Kind::lag: return Cause::lag_step;
        case Kind::offset: return Cause::point_spacing;
    }
    return Cause::feed_drop;
}

/// The difference of the planned speeds at a point and at the nearest point of another pass, relative to the higher one; 0 if
/// the plan is not stored.
double planned_difference(const PlantedLog& log, const Near& points, PointIndex here) {
    if (log.speed.empty()) return 0;
    const auto k = static_cast<std::size_t>(here);
    double nearest = 1.6 * log.recipe.step_over, difference = 0;
    for (std::size_t i = 0; i < log.line.size(); ++i) {
        if (log.pass[i] == log.pass[k] || log.pass[i] < 0) continue;
        const double distance = (points.at(static_cast<PointIndex>(i)) - points.at(here)).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        difference = std::abs(log.speed[i] - log.speed[k]) / std::max(log.speed[i], log.speed[k]);
    }
    return difference;
}

/// Whether at least a quarter of the points differ by plan. About twenty of them are tested.
bool differs_by_plan(const PlantedLog& log, const Near& near, const std::vector<PointIndex>& points) {
    const std::size_t every = std::max<std::size_t>(1, points.size() / 20);
    std::size_t looked = 0, differ = 0;
    for (std::size_t k = 0; k < points.size(); k += every) {
        ++looked;
        differ += planned_difference(log, near, points[k]) >= planned_enough ? 1 : 0;
    }
    return 4 * differ >= looked;
}

bool right_sign(const Defect& planted, const clsurf::Defect& found) {
    if (planted.kind == Kind::oscillation) return true;
    if (planted.kind == Kind::speed) return (planted.amplitude > 0) == (found.speed_jump < 0);
    return (planted.amplitude > 0) != found.pit;
}

/// Whether the lines at both ends of each planted section are those of a reported section, ±1.
bool lines_match(const PlantedLog& log, const std::vector<PointIndex>& truth, const clsurf::Defect& defect) {
    for (std::size_t k = 0; k < truth.size();) {
        std::size_t end = k;
        while (end < truth.size() &&
               log.pass[static_cast<std::size_t>(truth[end])] == log.pass[static_cast<std::size_t>(truth[k])])
            ++end;
        const auto first = static_cast<long long>(log.line[static_cast<std::size_t>(truth[k])]);
        const auto last = static_cast<long long>(log.line[static_cast<std::size_t>(truth[end - 1])]);
        const bool matched =
            std::any_of(defect.sections.begin(), defect.sections.end(), [&](const DefectSection& section) {
                return std::abs(static_cast<long long>(section.first_line) - first) <= 1 &&
                       std::abs(static_cast<long long>(section.last_line) - last) <= 1;
            });
        if (matched) return true;
        k = end;
    }
    return false;
}

}  // namespace

Program program_of(const PlantedLog& planted) {
    return parse_program(SourceText("planted.nc", planted.program, nullptr), {});
}

QualityReport judge(const PlantedLog& planted, const QualityRules& rules) {
    const Log log = as_log(planted);
    const Program program = program_of(planted);
    PartRules part_rules;
    part_rules.accept_foreign = true;  // the score shows how much is found
    const Part part = assemble(program, log, part_rules);
    const ClSurface surface = stitch(part);
    const PartSignals read = signals_of(part, surface, Role::feedback);
    return find_defects(surface, read.signals, *part.lines, part.program, part.log.period, rules);
}

Score score(const PlantedLog& planted, const QualityReport& report) {
    Score result;
    result.points = static_cast<PointIndex>(planted.line.size());
    result.planted = static_cast<int>(planted.truth.size());
    result.reported = static_cast<int>(report.defects.size());
    std::vector<PointIndex> all_truth;
    for (const auto& truth : planted.truth) all_truth.insert(all_truth.end(), truth.begin(), truth.end());
    std::vector<PointIndex> flagged;
    const Near near_truth(planted, all_truth, true_within);
    for (const clsurf::Defect& defect : report.defects) {
        const std::vector<PointIndex> points = points_of(defect);
        flagged.insert(flagged.end(), points.begin(), points.end());
        if (near_truth.share(points) >= share_enough)
            ++result.right;
        else if (differs_by_plan(planted, near_truth, points))
            ++result.natural;
    }
    const Near near_flagged(planted, flagged, found_within);
    for (std::size_t d = 0; d < planted.truth.size(); ++d) {
        const std::vector<PointIndex>& truth = planted.truth[d];
        if (near_flagged.share(truth) < share_enough) continue;
        ++result.found;
        // The reported defect that covers most of the planted one.
        const clsurf::Defect* best = nullptr;
        double most = 0;
        for (const clsurf::Defect& defect : report.defects) {
            const double share = Near(planted, points_of(defect), found_within).share(truth);
            if (share > most) {
                most = share;
                best = &defect;
            }
        }
        const Near near_place(planted, truth, planted.recipe.step_over);
        if (near_place.has(best->place.tip)) ++result.placed;
        if (lines_match(planted, truth, *best)) ++result.lined;
        if (best->cause == cause_of(planted.recipe.defects[d].kind)) ++result.named;
        if (right_sign(planted.recipe.defects[d], *best)) ++result.signed_right;
        if (planted.recipe.defects[d].kind == Kind::lag) {
            const double wanted = planted.recipe.defects[d].amplitude;
            const double got = best->pit ? -best->depth : best->depth;
            result.depth_errors.push_back(got / wanted - 1);
        }
    }
    return result;
}

Score& Score::operator+=(const Score& other) {
    planted += other.planted;
    found += other.found;
    reported += other.reported;
    right += other.right;
    natural += other.natural;
    points += other.points;
    placed += other.placed;
    lined += other.lined;
    named += other.named;
    signed_right += other.signed_right;
    depth_errors.insert(depth_errors.end(), other.depth_errors.begin(), other.depth_errors.end());
    return *this;
}

}  // namespace clsurf::planted
