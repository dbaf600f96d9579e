#pragma once
// The comparison of runs with a reference run, as JSON and as a text table.

#include <optional>
#include <string>
#include <vector>

#include "compare/drifted_run.h"
#include "compare/run_budget.h"
#include "core/diagnostic.h"
#include "pipeline/roughness_gauge.h"

namespace clsurf::io {

struct ReportedRun {
    std::string name;
    RunReport report;
    std::vector<BudgetLine> budget;
    std::optional<RoughnessChange> roughness;  ///< change from the reference to the run; nothing: the tool is not known
};

struct ReportedRuns {
    std::string reference;  ///< all runs are compared with it
    std::vector<ReportedRun> runs;
    std::vector<RunDeparture> departures;  ///< departures of the reference, then of the runs; empty: too few runs
    std::optional<std::size_t> drifted;    ///< among `departures`
    const Diagnostics* diagnostics = nullptr;

    [[nodiscard]] bool within_budget() const;
    /// The name of a run in `departures`.
    [[nodiscard]] const std::string& name_of(std::size_t departure) const {
        return departure == 0 ? reference : runs[departure - 1].name;
    }
};

/// Keys: docs/diff.md.
[[nodiscard]] std::string runs_json(const ReportedRuns& runs);
[[nodiscard]] std::string runs_text(const ReportedRuns& runs);

}  // namespace clsurf::io
