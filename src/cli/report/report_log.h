#pragma once
// ReportLog: the content of a report for one log, and the page with as much of it as fits.

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

/// One log, read and assembled; fit_page() sets `kept` and the members after it.
struct ReportLog {
    Part part;
    ClSurface surface;
    Quality quality;
    std::optional<io::Acceptance> acceptance;  ///< acceptance for the shown log, if there is a file
    std::vector<Field> fields;
    std::vector<std::vector<io::PageClass>> classes;  ///< per field
    std::vector<std::vector<PointRange>> ramps;       ///< per field: points in a lighter tone, increasing
    Column<float> speed;                              ///< per point [mm/s], if no field has it
    std::vector<Trajectory> other_roles;
    Column<PathLocation> places_before;  ///< per point, on the earlier log; empty: there is none
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

/// Finds the ramps that all passes have, in the speeds of all logs.
void find_ramps(std::vector<ReportLog>& logs);

/// The page with all points of its logs, or with as many as its `most_bytes` allow. Throws UsageError if even the
/// smallest page is larger.
[[nodiscard]] std::string fit_page(io::ReportPage& page, std::vector<ReportLog>& logs);

/// The colours of every named colour map.
[[nodiscard]] std::vector<io::PageColourMap> page_colour_maps();

}  // namespace clsurf::cli
