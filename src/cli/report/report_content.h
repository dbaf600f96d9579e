#pragma once
// The content of the page of `report`.

#include <optional>
#include <vector>

#include "cli/pictures/as_machined.h"
#include "cli/report/report_log.h"
#include "cli/report/report_options.h"
#include "field/range.h"
#include "io/page/report_page.h"

namespace clsurf::cli {

/// The as-machined surface as a height map of a size for a page.
struct ReportedForm {
    AsMachinedMap map;
    ShownRange range;
};

/// Sweeps the tool of the part. Domain: it is known.
[[nodiscard]] ReportedForm form_for_report(const ReportLog& shown, const ReportOptions& options, StageClock& clock);
[[nodiscard]] io::PageHeightMap page_height_map_of(const ReportedForm& as_machined);

/// The path of the program in the coordinates of the log. Nothing: the program came from standard input, or its machine has
/// rotary axes, whose programmed path is not that of the tool in the workpiece.
[[nodiscard]] std::optional<io::PageProgrammed> programmed_path(const ReportLog& shown, const ReportOptions& options);

/// The page without its pictures and the as-machined surface. Refers to `shown`. Throws UsageError: no field has the name
/// of --color.
[[nodiscard]] io::ReportPage report_page_of(const ReportLog& shown, const std::vector<ReportLog>& logs,
                                            const ReportOptions& options);

/// The measurement of the part with its picture. Throws as compare_measured() does.
[[nodiscard]] io::PageMeasured measured_for_report(const ReportLog& shown, const ReportOptions& options,
                                                   StageClock& clock);

/// Adds the pictures of the part, of its as-machined surface and of the first defects.
void add_report_pictures(io::ReportPage& page, const ReportLog& shown, const ReportOptions& options,
                         const std::optional<ReportedForm>& as_machined);

}  // namespace clsurf::cli
