#pragma once
// Quality: a part judged by the predictor, with the options that `check` and `render` share.

#include <memory>
#include <optional>

#include "cli/part.h"
#include "quality/defects.h"
#include "quality/formed_report.h"

namespace clsurf::cli {

/// What the predictor reads of a part.
struct PartSignals {
    std::optional<Trajectory> measured;  ///< positions that heights are measured from; nothing: those that are shown
    std::vector<PointRange> pieces;      ///< of smooth way (path/pieces.h)
    Signals signals;

    /// Where the tool cuts.
    [[nodiscard]] const Trajectory& swept(const Trajectory& path) const { return measured ? *measured : path; }
};

/// Heights are measured from `wanted` or, where nothing is wanted, from the most truthful positions
/// that the log has besides the commanded ones (actual, then feedback).
[[nodiscard]] PartSignals signals_of(const Part& part, const ClSurface& surface, std::optional<Role> wanted);

/// What a tool is swept along.
struct ToolRun {
    const Trajectory& path;
    const ClSurface& surface;
    const PartSignals& read;

    /// Refers to what this refers to.
    [[nodiscard]] FormedSurface formed(const CuttingTool& tool) const;
};

/// A part as an upright tool that cuts the same goes over it.
struct UprightPart {
    Trajectory path;
    ClSurface surface;
    PartSignals read;

    [[nodiscard]] ToolRun run() const { return {path, surface, read}; }
};

/// nullptr: the tool stands along z all the time. Else it must be a ball, whose centre is what counts; throws
/// UsageError for other tools.
[[nodiscard]] std::unique_ptr<const UprightPart> upright_part(const Part& part, std::optional<Role> wanted,
                                                              const CuttingTool& tool);

struct Quality {
    QualityReport report;
    double scallop = 0;                  ///< [mm] 0: not known
    std::optional<FormedReport> formed;  ///< where the tool is known
};

/// Options for load_part(): passes are compared where they were commanded, so --surface names what
/// heights are measured from. Returns that role, or the most truthful one where none is named.
[[nodiscard]] std::optional<Role> take_measured_role(PartOptions& options);

/// The defects alone, at tool tips. Adds diagnostics `quality.…` to the part's.
[[nodiscard]] QualityReport find_part_defects(Part& part, const ClSurface& surface, const PartSignals& read,
                                              const QualityRules& rules, StageClock& clock);

/// The whole of it, at contact points where the tool is known. Adds diagnostics `quality.…` to the part's.
[[nodiscard]] Quality judge(Part& part, const ClSurface& surface, std::optional<Role> measured,
                            const QualityRules& rules, StageClock& clock);

}  // namespace clsurf::cli
