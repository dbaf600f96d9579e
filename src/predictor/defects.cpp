#include "predictor/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/block_portions.h"
#include "core/statistics.h"
#include "predictor/border.h"
#include "predictor/candidates.h"
#include "predictor/cause.h"
#include "predictor/chord_effect.h"
#include "predictor/coverage.h"
#include "predictor/defect_core.h"
#include "predictor/explanations.h"
#include "predictor/opposites.h"
#include "predictor/subprogram_lines.h"
#include "predictor/systematic_lag.h"
#include "toolpath/arc_length.h"

namespace clsurf {
namespace {

constexpr double shown_share = 0.9;  ///< quantile that is the height of a plateau, without peaks of noise
// smallest_area, fewest_sites, of_stops, of_spikes: docs/design/predictor.md#4-join-places-into-defects.
constexpr double smallest_area = 1.0;      ///< squared step-overs
constexpr float least_speed_share = 0.6F;  ///< share of the speed that a defect of the acceleration needs …
constexpr float strong_alone = 1.5F;       ///< … and its score of the acceleration
constexpr std::size_t fewest_sites = 2;
constexpr int of_stops = 3;   ///< severity by speed alone from which on a motion may have any length …
constexpr int of_spikes = 4;  ///< … and that of a height
// Both numbers: docs/design/predictor.md#5-separate-systematic-lag.
constexpr std::size_t most_systematic_sections = 300;  ///< number of listed sections, which are the longest
constexpr double systematic_depth = 0.99;              ///< quantile of the steps of a systematic lag

/// The largest of values; NaN are left out.
double largest_of(const std::vector<double>& values) {
    double largest = 0;
    for (const double v : values) {
        if (std::abs(v) > std::abs(largest)) largest = v;
    }
    return largest;
}

/// The height of a plateau of values, signed: of those with the sign of `sign`. NaN are left out.
double plateau(const std::vector<double>& values, double sign) {
    std::vector<double> same;
    for (const double v : values) {
        if (v * sign > 0) same.push_back(std::abs(v));
    }
    return same.empty() ? 0 : std::copysign(nearest_quantile(same, shown_share), sign);
}

/// Quantities that are grouped together.
using Family = std::span<const Quantity>;
constexpr std::array motion_family{Quantity::speed, Quantity::acceleration};
constexpr std::array lag_family{Quantity::normal_deviation};
constexpr std::array relief_family{Quantity::relief};

float largest(const std::array<float, quantities>& values, Family family) {
    float most = 0;
    for (const Quantity q : family) most = std::max(most, values[index_of(q)]);
    return most;
}

/// The quantity in which a group is strongest: the first of its family with a sufficient share. Accelerations only mark the
/// edges of other differences, so they count if no other quantity does.
Quantity main_quantity(CandidateSpan group, Family family) {
    for (const Quantity q : family) {
        const bool there = std::any_of(group.begin(), group.end(),
                                       [&](const DefectCandidate* s) { return s->share[index_of(q)] >= half_of_peak; });
        if (there) return q;
    }
    return family.back();
}

class Builder {
public:
    Builder(const ClSurface& surface, const Signals& signals, const LineMap& lines, const CauseFinder& causes,
            const ArcLength& arc_length, double joined, const Thresholds& thresholds, const QualityRules& rules,
            const ForgetBlocks& forget)
        : surface_(surface),
          signals_(signals),
          lines_(lines),
          causes_(causes),
          arc_length_(arc_length),
          thresholds_(thresholds),
          rules_(rules),
          joined_(joined),
          forget_(forget) {
        std::int64_t number = 0;
        for (const Pass& pass : surface.passes) numbers_.push_back(pass.kind == PassKind::cut ? ++number : 0);
    }

    /// Splits sites into sets that form one defect each: connected, and different in one direction.
    [[nodiscard]] std::vector<DefectCandidates> parts_of(const DefectCandidates& sites, Quantity quantity) const {
        std::vector<DefectCandidates> parts;
        for (DefectCandidates& core : regroup(sites)) {
            std::vector<DefectCandidates> signs = split_opposites(core, quantity, signals_, arc_length_, joined_);
            if (signs.size() == 1) {
                parts.push_back(std::move(core));
                continue;
            }
            for (const DefectCandidates& sign : signs) {
                for (DefectCandidates& part : regroup(sign)) parts.push_back(std::move(part));
            }
        }
        return parts;
    }
    [[nodiscard]] std::vector<DefectCandidates> regroup(const DefectCandidates& sites) const {
        return group_candidates(sites, surface_, arc_length_, joined_, forget_);
    }
    [[nodiscard]] CoreSites core_of(CandidateSpan group, Quantity quantity) const {
        return clsurf::core_of(group, quantity, arc_length_, joined_);
    }
    /// No other thread may be reading.
    void forget() const {
        if (forget_) forget_();
    }

    [[nodiscard]] std::int64_t cut_passes() const {
        return numbers_.empty() ? 0 : *std::max_element(numbers_.begin(), numbers_.end());
    }

    /// The defect of the sites of a core, in the order of their points.
    [[nodiscard]] Defect build(CandidateSpan core, Quantity quantity, Family family) const {
        Defect defect;
        defect.quantity = quantity;
        const auto weaker = [&](const DefectCandidate* a, const DefectCandidate* b) {
            return a->share[index_of(quantity)] < b->share[index_of(quantity)];
        };
        const DefectCandidate& strongest = **std::max_element(core.begin(), core.end(), weaker);
        defect.point = strongest.point;
        defect.speed = signals_[strongest.point].speed;
        defect.adjacent_speed = defect.speed - strongest.comparison.speed_jump;
        defect.place.tip = surface_.positions.absolute(defect.point);
        const auto score_of = [&](Quantity q) {
            float most = 0;
            for (const DefectCandidate* s : core) most = std::max(most, s->score[index_of(q)]);
            return most;
        };
        defect.score = score_of(quantity);
        for (const Quantity other : family) {
            // If the main quantity alone is too weak, the other one of its family counts.
            if (defect.score >= 1) break;
            if (score_of(other) <= defect.score) continue;
            defect.quantity = other;
            defect.score = score_of(other);
        }
        for (const CandidateSpan run : runs_of(core, arc_length_, joined_))
            defect.sections.push_back(section_of(run.front()->pass, {run.front()->point, run.back()->point}));
        measure(core, defect);
        defect.neighbours = neighbours_of(core, defect.sections);
        defect.cause = causes_.cause_of(defect, core);
        const bool motion = defect.quantity == Quantity::speed || defect.quantity == Quantity::acceleration;
        defect.severity = severity_of({defect.depth, defect.score, motion, false}, rules_.severity);
        return defect;
    }

    /// Whether a defect is large enough to be listed: its core, or the section where it exceeds the threshold, covers `area`
    /// [mm²]. A place where the tool nearly stops, or is far off the surface, is listed at any length. `sites`: those of its
    /// family.
    [[nodiscard]] bool is_large(const Defect& defect, CandidateSpan core, CandidateSpan sites, double area) const {
        if (core.size() < fewest_sites || defect.length <= 0) return false;
        if (defect.area >= area) return true;
        const bool motion = defect.quantity == Quantity::speed;
        const int alone = motion ? severity_of({0, defect.score, true, false}, rules_.severity) : defect.severity;
        if (alone >= (motion ? of_stops : of_spikes)) return true;
        const double enough = area / surface_.step_over;
        return length_above_threshold(core, sites, defect.quantity, arc_length_, joined_, enough) >= enough;
    }

    /// The one defect of a systematic lag.
    [[nodiscard]] Defect build(const SystematicLag& lag) const {
        Defect defect;
        defect.quantity = Quantity::normal_deviation;
        defect.cause = Cause::lag_step;
        defect.systematic = true;
        std::vector<double> steps;
        const AlternatingSite* strongest = &lag.sites.front();
        for (const AlternatingSite& site : lag.sites) {
            steps.push_back(std::abs(site.step));
            defect.bounds.extend(surface_.positions.absolute(site.point));
            if (std::abs(site.step) > std::abs(strongest->step)) strongest = &site;
        }
        defect.point = strongest->point;
        defect.place.tip = surface_.positions.absolute(defect.point);
        defect.speed = defect.adjacent_speed = signals_[defect.point].speed;
        defect.depth = nearest_quantile(steps, systematic_depth);
        defect.score = static_cast<float>(defect.depth) / thresholds_.of[index_of(Quantity::normal_deviation)];
        for (std::size_t k = 0; k < lag.sites.size();) {
            std::size_t end = k + 1;
            while (end < lag.sites.size() && lag.sites[end].pass == lag.sites[k].pass &&
                   !arc_length_.at_least(lag.sites[end - 1].point, lag.sites[end].point, joined_))
                ++end;
            defect.sections.push_back(section_of(lag.sites[k].pass, {lag.sites[k].point, lag.sites[end - 1].point}));
            k = end;
        }
        const double arc_length = add_up_sections(defect);
        defect.share = arc_length / cut_arc_length(surface_, arc_length_);
        keep_longest(most_systematic_sections, defect.sections);
        defect.severity = severity_of({defect.depth, defect.score, false, true}, rules_.severity);
        return defect;
    }

private:
    [[nodiscard]] DefectSection section_of(std::size_t pass, PointRange points) const {
        DefectSection section{numbers_[pass], points, 0, 0};
        std::vector<LineNumber> lines(static_cast<std::size_t>(points.size()));
        lines_.read(points.first, lines);
        for (const LineNumber line : lines) {
            if (line == 0) continue;
            section.first_line = section.first_line == 0 ? line : std::min(section.first_line, line);
            section.last_line = std::max(section.last_line, line);
        }
        return section;
    }

    void measure(CandidateSpan core, Defect& defect) const {
        std::vector<double> heights;
        std::vector<double> speeds;
        std::vector<double> mismatches;
        std::vector<double> accelerations;
        for (const DefectCandidate* s : core) {
            const Comparison& c = s->comparison;
            // Measured and commanded relief differ by the lag. Without measured positions only the relief is known.
            const bool by_relief = defect.quantity == Quantity::relief || !signals_.measured;
            heights.push_back(c.residual[index_of(by_relief ? Quantity::relief : Quantity::normal_deviation)]);
            speeds.push_back(c.speed_jump);
            mismatches.push_back(c.residual[index_of(Quantity::speed)]);
            accelerations.push_back(c.step[index_of(Quantity::acceleration)]);
            defect.bounds.extend(surface_.positions.absolute(s->point));
        }
        const double height = plateau(heights, largest_of(heights));
        defect.depth = std::abs(height);
        defect.pit = height < 0;
        // Both have the sign of the largest relative difference: a loss of 80 % is no gain of 400 %.
        const double side = largest_of(mismatches);
        defect.speed_jump = plateau(speeds, side);
        defect.speed_mismatch = plateau(mismatches, side);
        defect.acceleration_jump = plateau(accelerations, 1);
        (void)add_up_sections(defect);
    }

    /// Keeps the `most` longest sections, in the order of their points.
    void keep_longest(std::size_t most, std::vector<DefectSection>& sections) const {
        if (sections.size() <= most) return;
        const auto length = [&](const DefectSection& section) {
            return arc_length_.to(section.points.last) - arc_length_.to(section.points.first);
        };
        std::nth_element(sections.begin(), sections.begin() + static_cast<std::ptrdiff_t>(most), sections.end(),
                         [&](const DefectSection& a, const DefectSection& b) {
                             const double in_a = length(a), in_b = length(b);
                             return in_a != in_b ? in_a > in_b : a.points.first < b.points.first;
                         });
        sections.resize(most);
        std::sort(sections.begin(), sections.end(),
                  [](const DefectSection& a, const DefectSection& b) { return a.points.first < b.points.first; });
    }

    /// Sets length and area of a defect from its sections. Returns their total length [mm].
    double add_up_sections(Defect& defect) const {
        double arc_length = 0;
        for (const DefectSection& section : defect.sections) {
            const double length = arc_length_.to(section.points.last) - arc_length_.to(section.points.first);
            defect.length = std::max(defect.length, length);
            arc_length += length;
        }
        defect.area = arc_length * surface_.step_over;
        return arc_length;
    }

    /// The sections adjacent to `sections` on clean passes.
    [[nodiscard]] std::vector<DefectSection> neighbours_of(CandidateSpan core,
                                                           const std::vector<DefectSection>& sections) const {
        std::map<std::size_t, PointRange> found;  // by pass
        for (const DefectCandidate* s : core) {
            for (const PathLocation& at : {s->comparison.adjacent_left, s->comparison.adjacent_right}) {
                if (!at.exists()) continue;
                const PointIndex n = at.nearest();
                PointRange& points = found.try_emplace(pass_of(surface_.passes, n), PointRange{n, n}).first->second;
                points.first = std::min(points.first, n);
                points.last = std::max(points.last, n);
            }
        }
        std::vector<DefectSection> clean;
        for (const auto& [pass, points] : found) {
            const bool at_fault =
                std::any_of(sections.begin(), sections.end(),
                            [&, number = numbers_[pass]](const DefectSection& r) { return r.pass == number; });
            if (!at_fault) clean.push_back(section_of(pass, points));
        }
        std::sort(clean.begin(), clean.end(),
                  [](const DefectSection& a, const DefectSection& b) { return a.points.first < b.points.first; });
        return clean;
    }

    const ClSurface& surface_;
    const Signals& signals_;
    const LineMap& lines_;
    const CauseFinder& causes_;
    const ArcLength& arc_length_;
    const Thresholds& thresholds_;
    const QualityRules& rules_;
    double joined_;  ///< [mm] largest arc length between connected sites
    const ForgetBlocks& forget_;
    std::vector<std::int64_t> numbers_;  ///< of the cut passes, by index into surface.passes
};

bool worse(const Defect& a, const Defect& b) {
    if (a.score != b.score) return a.score > b.score;
    if (a.depth != b.depth) return a.depth > b.depth;
    return a.point < b.point;
}

/// Whether a score reaches 1. In the motion, accelerations start a defect only if they are strong and also change the speed:
/// noise of the second derivative leaves no mark.
bool starts_defect(CandidateSpan sites, Family family) {
    const auto any = [&](auto&& test) { return std::any_of(sites.begin(), sites.end(), test); };
    if (family.size() == 1)
        return any([&](const DefectCandidate* s) { return s->score[index_of(family.front())] >= 1; });
    return any([](const DefectCandidate* s) { return s->score[index_of(Quantity::speed)] >= 1; }) ||
           (any([](const DefectCandidate* s) { return s->score[index_of(Quantity::acceleration)] >= strong_alone; }) &&
            any([](const DefectCandidate* s) { return s->share[index_of(Quantity::speed)] >= least_speed_share; }));
}

/// Builds the defects of one family of quantities with an area of at least `smallest` [mm²], either at the border of the part
/// or away from it. Both are separate, so that an expected difference at the border does not absorb a defect next to it.
class FamilyBuilder {
public:
    FamilyBuilder(Family family, bool at_border, double smallest, const Border& border, const Builder& builder)
        : family_(family), at_border_(at_border), smallest_(smallest), border_(border), builder_(builder) {}

    std::vector<BuiltDefect> build(const DefectCandidates& candidates) {
        for (const DefectCandidate* s : candidates) {
            if (s->expected(family_.front()) == at_border_ && largest(s->share, family_) >= half_of_peak)
                mine_.push_back(s);
        }
        std::vector<DefectCandidates> groups = builder_.regroup(mine_);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const DefectCandidates group = std::move(groups[g]);
            if (!starts_defect(group, family_)) continue;
            const Quantity quantity = main_quantity(group, family_);
            // A reduced group may fall apart, because weak candidates had joined several defects.
            const CoreSites sites = builder_.core_of(group, quantity);
            if (sites.rest.size() < group.size()) {
                for (DefectCandidates& left : builder_.regroup(sites.rest)) groups.push_back(std::move(left));
            }
            for (DefectCandidates& core : builder_.parts_of(sites.core, quantity)) add(std::move(core), quantity);
            builder_.forget();
        }
        return std::move(built_);
    }

private:
    void add(DefectCandidates core, Quantity quantity) {
        if (core.empty() || !starts_defect(core, family_)) return;
        if (at_border_) return keep(core, quantity, !border_.stands_out(core, quantity));
        const DefectCandidate* flank = border_.flank_of(core, quantity);
        if (!flank) return keep(core, quantity, false);
        // A flank has an end; sites beyond it form a separate defect.
        const double reach = border_.flank_reach(core, quantity);
        const auto beyond = std::stable_partition(core.begin(), core.end(), [&](const DefectCandidate* s) {
            return border_.on_flank(*s, *flank, reach, quantity);
        });
        if (beyond == core.begin()) return keep(core, quantity, false);
        const DefectCandidates rest(beyond, core.end());
        core.erase(beyond, core.end());
        keep(core, quantity, true);
        for (DefectCandidates& part : builder_.regroup(rest)) add(std::move(part), quantity);
    }

    void keep(const DefectCandidates& core, Quantity quantity, bool expected) {
        if (core.empty()) return;
        Defect defect = builder_.build(core, quantity, family_);
        // An expected motion explains the heights that it causes, however short it is.
        const bool large = builder_.is_large(defect, core, mine_, smallest_);
        if (large || expected) built_.push_back({std::move(defect), core, expected, large});
    }

    Family family_;
    bool at_border_;
    double smallest_;
    const Border& border_;
    const Builder& builder_;
    DefectCandidates mine_;
    std::vector<BuiltDefect> built_;
};

/// Forgets the arc lengths together with the signals, for a log that was judged in shards.
ForgetBlocks forget_with(ArcLength& arc_length, const std::optional<FoundInShards>& found) {
    if (!found || !found->forget) return {};
    return [&arc_length, &signals = found->forget] {
        const bool forgot = signals();
        if (forgot) arc_length.forget();
        return forgot;
    };
}

}  // namespace

int QualityReport::worst_severity() const {
    int worst = 0;
    for (const Defect& defect : defects) worst = std::max(worst, defect.severity);
    return worst;
}

const DefectSection* strongest_section(const Defect& defect) {
    for (const DefectSection& section : defect.sections) {
        if (defect.point >= section.points.first && defect.point <= section.points.last) return &section;
    }
    return defect.sections.empty() ? nullptr : &defect.sections.front();
}

std::vector<DefectSection> strongest_first(const Defect& defect) {
    std::vector<DefectSection> sections = defect.sections;
    const DefectSection* strongest = strongest_section(defect);
    if (strongest == nullptr) return sections;
    const auto at = sections.begin() + (strongest - defect.sections.data());
    std::rotate(sections.begin(), at, at + 1);
    return sections;
}

std::vector<PointRange> QualityReport::sections() const {
    std::vector<PointRange> found;
    for (const Defect& defect : defects) {
        for (const DefectSection& section : defect.sections) found.push_back(section.points);
    }
    return found;
}

QualityReport find_defects(const ClSurface& surface, const Signals& signals, const LineMap& lines,
                           const Program& program, double period, const QualityRules& rules) {
    QualityReport report;
    report.step_over = surface.step_over;
    report.has_lag = signals.measured;
    report.note = signals.speed_note + ", " + signals.acceleration_note + ", " + signals.height_note;
    report.thresholds = rules.fixed ? *rules.fixed : measure_thresholds(surface, signals, rules.thresholds);
    ArcLength arc_length(surface.positions);
    const ForgetBlocks forget = forget_with(arc_length, rules.found);
    const CauseFinder causes(surface, signals, lines, program, arc_length);
    const double joined = joined_along(surface, report.thresholds.usual_speed * period);
    const Builder builder(surface, signals, lines, causes, arc_length, joined, report.thresholds, rules, forget);
    report.passes = builder.cut_passes();
    report.points = cutting_points(surface.passes);
    report.not_finishing = surface.not_finishing;
    const ComparedPoints compared =
        rules.found ? rules.found->points : count_compared(surface, signals, {0, signals.size() - 1});
    report.away_from_ends = compared.away_from_ends;
    report.compared = compared.compared;
    for (const std::string& reason : signals.unfit) report.judgement.refuse(reason);
    judge_coverage(report.thresholds.usual_speed * period, report);

    FoundCandidates found =
        rules.found ? find_candidates(surface, signals, arc_length, report.thresholds, rules.found->starts, forget)
                    : find_candidates(surface, signals, arc_length, report.thresholds);
    const SystematicLag systematic =
        take_systematic_lag(surface, signals, arc_length, report.thresholds, joined, found, forget);
    take_chord_effects(surface.passes, arc_length, joined, found, forget);
    const DefectCandidates& candidates = found.candidates;
    const double smallest = smallest_area * surface.step_over * surface.step_over;
    const std::array<Family, 3> families{motion_family, lag_family, relief_family};
    const Border border(surface, signals, arc_length, candidates, joined, report.thresholds);
    std::array<std::vector<BuiltDefect>, 2 * families.size()> of_family;  // away from the border and at it
    // No other thread may be reading when signals are forgotten.
    for_each_alone_or_at_once(of_family.size(), forget, [&](std::size_t k) {
        of_family[k] = FamilyBuilder(families[k / 2], k % 2 == 1, smallest, border, builder).build(candidates);
    });
    for (BuiltDefect& built : unexplained(of_family, period)) {
        if (!built.listed) continue;
        if (built.expected) built.defect.cause = Cause::pass_end;
        (built.expected ? report.expected : report.defects).push_back(std::move(built.defect));
    }
    if (!systematic.sites.empty()) report.defects.push_back(builder.build(systematic));
    name_subprograms(program, lines, report.defects);
    name_subprograms(program, lines, report.expected);
    std::sort(report.defects.begin(), report.defects.end(), worse);
    std::sort(report.expected.begin(), report.expected.end(), worse);
    return report;
}

}  // namespace clsurf
