#pragma once
// The verdict on a part: its defects, their places on the part, the formed surface and its roughness.

#include <optional>

#include "core/diagnostic.h"
#include "machined/as_machined_report.h"
#include "pipeline/motion_quality.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "pipeline/stages.h"
#include "predictor/defects.h"

namespace clsurf {

struct Quality {
    QualityReport report;
    double scallop = 0;                           ///< [mm] 0: not known
    std::optional<AsMachinedReport> as_machined;  ///< where the tool is known
    std::optional<MotionQuality> motion;          ///< where it is asked for
    Diagnostics diagnostics;  ///< `quality.…`: why nothing is judged, what is not known of the tool
};

/// The defects at tool tips, each of `report.judgement`'s reasons included that speak against a verdict.
/// O(points), parallel.
[[nodiscard]] QualityReport find_defects(const Part& part, const ClSurface& surface, const PartSignals& read,
                                         const QualityRules& rules = {});
/// The same along other positions of the part's log, whose surface and signals these are.
[[nodiscard]] QualityReport find_defects(const Part& part, const Trajectory& path, const ClSurface& surface,
                                         const PartSignals& read, const QualityRules& rules = {});

/// Adds a warning `quality.not-judged` for each reason that a report gives.
void note_reasons(const QualityReport& report, const Part& part, Diagnostics& diagnostics);

/// The whole of it, at contact points where the tool is known. `surface` is that of the part; `measured`: the positions
/// that heights are measured from (pipeline/roles.h). `with_motion`: asks for Quality::motion. O(points), parallel; the formed
/// surface costs most.
[[nodiscard]] Quality judge(const Part& part, const ClSurface& surface, std::optional<Role> measured = std::nullopt,
                            const QualityRules& rules = {}, const Stages& stages = {}, bool with_motion = false);
/// The same with signals that are there already.
[[nodiscard]] Quality judge(const Part& part, const ClSurface& surface, const PartSignals& read,
                            std::optional<Role> measured, const QualityRules& rules, const Stages& stages = {});

}  // namespace clsurf
