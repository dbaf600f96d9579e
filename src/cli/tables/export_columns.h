#pragma once
// The columns of `export`.

#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/reports/export_table.h"
#include "io/reports/listing_json.h"
#include "pipeline/part.h"

namespace clsurf::cli {

/// A column for each name: point, line, pass, time, x, y, z, confidence, or a field. Throws UsageError: unknown, or the log
/// lacks what it needs.
[[nodiscard]] std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                                             const ClSurface& surface);

/// Columns of a log without positions: point, time, or a channel. None: time and all channels. Throws UsageError: another name.
[[nodiscard]] std::vector<io::ExportColumn> exported_channels(const std::vector<std::string>& names, const Log& log);

/// The same at some points of a part whose surface is read in parts; fields are those of positions and channels, since
/// others look at the whole log. `part`: the points and what lies about them; `points`: of the whole log.
[[nodiscard]] std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                                             const ClSurface& surface,
                                                             const std::vector<PointRange>& ranges,
                                                             std::span<const PointIndex> points);

/// Every name that exported_columns() takes for this part, with unit and meaning: the columns of its own, then the fields
/// for which nothing is missing, then channels of the log.
[[nodiscard]] std::vector<io::ListingRow> exportable_columns(const Part& part, const ClSurface& surface);

/// Runs what VTK or HDF5 writes for an output, and names the output where that fails: they know its temporary file only.
/// Throws SystemError.
template <typename Write>
void write_named(const std::string& output, const Write& write) {
    try {
        write();
    } catch (const SystemError& error) { throw SystemError(output + ": " + error.what()); }
}

}  // namespace clsurf::cli
