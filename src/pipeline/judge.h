#pragma once
// The verdict on a part: its defects, their places on the part, the as-machined surface and its roughness.

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
    std::optional<AsMachinedReport> as_machined;  ///< if the tool is known
    std::optional<MotionQuality> motion;          ///< if it is requested
    Diagnostics diagnostics;  ///< `quality.…`: why nothing is judged, and what is unknown about the tool
};

/// The defects at tool tips, including all reasons against a verdict (`report.judgement`). O(points), parallel.
[[nodiscard]] QualityReport find_defects(const Part& part, const ClSurface& surface, const PartSignals& read,
                                         const QualityRules& rules = {});
/// The same along other positions of the part's log, with their surface and signals.
[[nodiscard]] QualityReport find_defects(const Part& part, const Trajectory& path, const ClSurface& surface,
                                         const PartSignals& read, const QualityRules& rules = {});

/// Adds a warning `quality.not-judged` for each reason in a report.
void note_reasons(const QualityReport& report, const Part& part, Diagnostics& diagnostics);

/// The complete quality, at contact points if the tool is known. `surface` is the part's surface; `measured`: the positions
/// from which heights are measured (pipeline/roles.h). `with_motion`: requests Quality::motion. O(points), parallel; the
/// as-machined surface is the most expensive part.
[[nodiscard]] Quality judge(const Part& part, const ClSurface& surface, std::optional<Role> measured = std::nullopt,
                            const QualityRules& rules = {}, const Stages& stages = {}, bool with_motion = false);
/// The same with signals that were computed before.
[[nodiscard]] Quality judge(const Part& part, const ClSurface& surface, const PartSignals& read,
                            std::optional<Role> measured, const QualityRules& rules, const Stages& stages = {});

}  // namespace clsurf
