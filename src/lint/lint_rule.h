#pragma once
// LintRule: one rule of lint as a row, and LintContext: the data that a rule can read.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lint/lint_finding.h"
#include "surface/path_location.h"
#include "toolpath/toolpath.h"

namespace clsurf {

/// An unsuitable value at one end of a line.
struct LintMeasure {
    double found = 0, expected = 0;
    PointIndex beside = -1;  ///< a point of an adjacent pass, for comparison; −1: none
};

/// A program as the rules read it. Program and surface must outlive the object.
class LintContext {
public:
    LintContext(const Program& program, const ProgrammedSurface& programmed, const LintThresholds& thresholds);

    [[nodiscard]] const Motions& motions() const { return motions_; }
    [[nodiscard]] const Toolpath& path() const { return path_; }
    [[nodiscard]] const ClSurface& surface() const { return programmed_.surface; }
    [[nodiscard]] const LintThresholds& thresholds() const { return thresholds_; }
    [[nodiscard]] const std::vector<ProgrammedPass>& passes() const { return passes_; }
    [[nodiscard]] double tolerance() const { return tolerance_; }    ///< [mm] tolerance of the controller; 0: not known
    [[nodiscard]] double spacing() const { return usual_spacing_; }  ///< [mm] median length of the cutting lines
    [[nodiscard]] double chord_error() const { return usual_chord_error_; }  ///< [mm] 95th percentile
    /// [mm] length of the line at a point; NaN: not on a cut pass.
    [[nodiscard]] double spacing_at(PointIndex point) const;
    /// [mm] distance between the curve and the line that ends at a point; 0: it does not bend.
    [[nodiscard]] double chord_error_at(PointIndex point) const;
    [[nodiscard]] double feed_at(PointIndex point) const {
        return motions_.feed[programmed_.motion_of(point)];
    }  ///< [mm/s]

    [[nodiscard]] Vec3 at(PointIndex point) const;
    [[nodiscard]] LineNumber line(PointIndex point) const { return motions_.line[programmed_.motion_of(point)]; }
    /// The places on the two adjacent passes at a point; nullopt if one of them is missing.
    [[nodiscard]] std::optional<std::array<PathLocation, 2>> both_sides(const ProgrammedPass& pass,
                                                                        PointIndex point) const;
    /// A value that is above or below those of both adjacent passes by more than `ratio`.
    [[nodiscard]] std::optional<LintMeasure> against_both(const ProgrammedPass& pass, PointIndex point, double ratio,
                                                          const std::function<double(PointIndex)>& read) const;

private:
    void measure_spacing();
    void measure_chords();
    [[nodiscard]] bool is_line(PointIndex point) const {
        return motions_.kind[programmed_.motion_of(point)] == MotionKind::feed;
    }
    [[nodiscard]] bool is_corner(const ProgrammedPass& pass, std::size_t k) const;

    const Motions& motions_;
    Toolpath path_;
    const ProgrammedSurface& programmed_;
    LintThresholds thresholds_;
    std::vector<ProgrammedPass> passes_;
    std::vector<float> spacing_, chord_error_;  ///< [mm] by point
    double tolerance_ = 0, usual_spacing_ = 0, usual_chord_error_ = 0;
};

/// How the found and the expected value of a finding are displayed.
struct LintUnit {
    std::string_view name = "mm";
    double per_inside = 1;
    int digits = 3;
};

struct LintRule {
    std::string_view name;         ///< "point-spacing", the name in reports
    std::string_view description;  ///< a short sentence, for SARIF
    LintUnit unit;
    /// The text of a finding; its values are given with their unit.
    std::string (*message)(const LintFinding& finding, const std::string& found, const std::string& expected) = nullptr;
    /// Adds the findings of the rule.
    void (*check)(const LintContext& context, const LintRule& rule, std::vector<LintFinding>& findings) = nullptr;
};

/// The message of a finding in full.
[[nodiscard]] std::string message_of(const LintFinding& finding);

/// Which runs of unsuitable ends become findings.
struct LintRunRule {
    std::size_t fewest = 1;  ///< ends in a run: one or two points may be intentional
    bool medians = false;    ///< found and expected are medians; if false, the values farthest from 1
};

/// Makes a finding of each run of line ends of a pass for which `measure` has a value. Up to two good ends do not interrupt
/// a run.
void find_runs(const LintContext& context, const LintRule& rule, const LintRunRule& runs,
               const std::function<std::optional<LintMeasure>(const ProgrammedPass&, PointIndex)>& measure,
               std::vector<LintFinding>& findings);

}  // namespace clsurf
