// The report of `check` as JUnit: one case per limit, one for the baseline, and one for whether there is a verdict.
// The failures are those of the exit code: defects without a limit are not failures.

#include <algorithm>

#include <fmt/format.h>

#include "io/reports/junit.h"
#include "io/reports/line_ranges.h"
#include "io/reports/quality_report.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

std::string defect_lines(const ReportedQuality& q, bool worsened_only) {
    constexpr std::size_t shown = 50;
    std::string text;
    std::size_t count = 0;
    for (std::size_t i = 0; i < q.report->defects.size(); ++i) {
        if (worsened_only && q.baseline->states[i] == DefectState::unchanged) continue;
        if (++count > shown) continue;
        const Defect& d = q.report->defects[i];
        text += fmt::format("{} {}: {}, {}\n", i + 1, name_of_severity(d.severity), sentence_of(d),
                            named_line_ranges(d, 3));
    }
    if (count > shown) text += fmt::format("and {} more\n", count - shown);
    return text;
}

JunitCase judged_case(const ReportedQuality& q) {
    JunitCase judged{std::string(verdict_case), "", "", ""};
    if (!q.passes_asked) return judged;
    for (const std::string& reason : q.report->judgement.reasons)
        judged.error += (judged.error.empty() ? "" : " ") + reason;
    return judged;
}

JunitCase budget_case(const ReportedQuality& q, const BudgetLine& line) {
    JunitCase c{fmt::format("{} {:g}", line.name, line.limit), "", "", ""};
    if (line.held) return c;
    c.failure = fmt::format("{} is {:.4g}, the limit is {:g}", line.name, line.measured, line.limit);
    c.details = defect_lines(q, false);
    return c;
}

JunitCase baseline_case(const ReportedQuality& q) {
    JunitCase c{"no new defects", "", "", ""};
    if (q.baseline->worsened() == 0) return c;
    c.failure = baseline_text(*q.baseline);
    c.details = defect_lines(q, true);
    return c;
}

}  // namespace

std::string quality_junit(const ReportedQuality& q) {
    JunitSuite suite = check_suite(q.program->main().name(), q.log);
    suite.cases.push_back(judged_case(q));
    if (q.report->judgement.judged() || !q.passes_asked) {
        for (const BudgetLine& line : q.budget) suite.cases.push_back(budget_case(q, line));
        if (q.baseline != nullptr) suite.cases.push_back(baseline_case(q));
    }
    suite.output = quality_text(q);
    return junit_text({suite});
}

}  // namespace clsurf::io
