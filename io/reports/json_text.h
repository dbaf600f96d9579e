#pragma once
// Reports as JSON text, with the keys that scripts rely on. Invalid UTF-8 in
// names and program lines becomes U+FFFD.

#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "io/formats/foreign_content.h"
#include "log/log.h"
#include "pipeline/log_verdict.h"
#include "pipeline/point_query.h"
#include "program/program.h"
#include "toolpath/toolpath_summary.h"

namespace clsurf::io {

[[nodiscard]] std::string program_json(const Program& program, const ToolpathSummary& summary,
                                       const Diagnostics& diagnostics);
[[nodiscard]] std::string log_json(const Log& log, const LogVerdict& verdict, const Diagnostics& diagnostics);
[[nodiscard]] std::string query_json(const std::vector<QueryMatch>& matches, const Diagnostics& diagnostics);

struct ComparisonReport {
    bool equal = false;
    double max_error = 0, mean_error = 0, psnr = 0, delta_e = 0, threshold = 0;
    std::int64_t pixels_over = 0;
};
[[nodiscard]] std::string comparison_json(const ComparisonReport& report);

/// A table that is not recognised as a log.
[[nodiscard]] std::string table_json(const std::string& file, const ForeignTable& table);

/// The same shape for one report and for several: {"<list>": […]}; a single report also has its keys at the top
/// level.
[[nodiscard]] std::string list_json(const std::string& list, const std::vector<std::string>& reports);

}  // namespace clsurf::io
