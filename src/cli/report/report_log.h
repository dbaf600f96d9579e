#pragma once
// ReportLog: what a report shows of one log, and the page that holds as much of it as may be.

#include <optional>
#include <span>
#include <vector>

#include "cli/report/report_options.h"
#include "cli/stage_clock.h"
#include "io/page/report_page.h"
#include "io/reports/acceptance.h"
#include "pipeline/judge.h"
#include "pipeline/speed_reasons.h"
#include "surface/path_location.h"
#include "viz/bands.h"

namespace clsurf::cli {

/// One log, read and put together; `kept` and what follows are chosen by fit_page().
struct ReportLog {
    Part part;
    ClSurface surface;
    Quality quality;
    std::optional<io::Acceptance> acceptance;  ///< of the log that is shown, where there is a file
    std::vector<Field> fields;
    std::vector<std::vector<io::PageClass>> classes;  ///< per field
    std::vector<std::vector<PointRange>> ramps;       ///< per field: points in a lighter tone, rising
    Column<float> speed;                              ///< per point [mm/s], where it is none of the fields
    std::vector<Trajectory> other_roles;
    Column<PathLocation> places_before;  ///< per point, on the log before; empty: there is none
    KeptPoints kept;
    SlowWords slow;
    viz::SectionVertices vertices;
    viz::Bands bands;
};

/// The path speed at every point [mm/s].
[[nodiscard]] std::span<const float> speeds_of(const ReportLog& shown);

/// Reads and judges a log, and computes its fields. Throws InputError, UsageError.
[[nodiscard]] ReportLog load_report_log(const PartOptions& part_options, const ReportOptions& options,
                                        StageClock& clock);

/// Finds in the speeds of all logs the ramps that all passes have.
void find_ramps(std::vector<ReportLog>& logs);

/// The page with all points of its logs, or with as many as its `most_bytes` allow. Throws UsageError where the
/// least that a page must hold is more than that.
[[nodiscard]] std::string fit_page(io::ReportPage& page, std::vector<ReportLog>& logs);

/// Every named colour map, as colours.
[[nodiscard]] std::vector<io::PageColourMap> page_colour_maps();

}  // namespace clsurf::cli
