#pragma once
// The predictor's report as JSON, CSV, SARIF 2.1.0, JUnit and as a text table.

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "history/recorded_match.h"
#include "io/reports/acceptance.h"
#include "io/reports/reported_measurement.h"
#include "io/reports/simulation_origin.h"
#include "limits/limit_report.h"
#include "machined/as_machined_report.h"
#include "machined/tool.h"
#include "pipeline/motion_quality.h"
#include "predictor/defects.h"
#include "predictor/verdict.h"
#include "program/program.h"

namespace clsurf::io {

/// A report with its inputs.
struct ReportedQuality {
    const QualityReport* report = nullptr;
    const Program* program = nullptr;
    std::string log;  ///< its name
    std::optional<CuttingTool> tool;
    double scallop = 0;                      ///< [mm] height of scallops between clean passes; 0: not known
    std::vector<double> colour_differences;  ///< ΔE00 between each defect and the passes next to it, in the speed map
    const AsMachinedReport* as_machined = nullptr;  ///< nullptr: the tool is not known
    std::optional<MotionQuality> motion;            ///< in JSON only; nothing: not asked for
    const LimitReport* limits = nullptr;            ///< nullptr: no limits are given
    const Acceptance* acceptance = nullptr;         ///< nullptr: no file of accepted defects
    std::vector<BudgetLine> budget;
    std::optional<SimulationOrigin> origin;         ///< nullopt: the log is a recorded run
    const RecordedMatch* baseline = nullptr;        ///< comparison with the defects of an earlier run; nullptr: none
    const ReportedMeasurement* measured = nullptr;  ///< nullptr: nothing was measured; in text and JSON only
    bool passes_asked = true;                       ///< false: the budget has only limits of the machine
    const Diagnostics* diagnostics = nullptr;
    std::size_t columns = 80;  ///< width of the table in the text
};

/// Keys: docs/predictor.md.
[[nodiscard]] std::string quality_json(const ReportedQuality& quality);
/// One row per section of a defect; column names have units. file: a subprogram's, empty for the program itself.
[[nodiscard]] std::string quality_csv(const ReportedQuality& quality);
/// The first line of quality_csv().
[[nodiscard]] std::string quality_csv_titles();
/// One result per defect at the line that moves the tool, so that editors and code review show it. In a subprogram
/// this is a line of the subprogram, with the calling line as a related location.
[[nodiscard]] std::string quality_sarif(const ReportedQuality& quality);
[[nodiscard]] std::string quality_text(const ReportedQuality& quality);
/// JUnit XML: one case per limit, and one for the baseline.
[[nodiscard]] std::string quality_junit(const ReportedQuality& quality);

/// "2 new defects, 1 worse, 3 gone, 10 as before".
[[nodiscard]] std::string baseline_text(const RecordedMatch& match);

}  // namespace clsurf::io
