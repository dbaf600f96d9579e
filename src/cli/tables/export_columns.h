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

/// A column for each name: point, line, pass, time, x, y, z, confidence, or a field. Throws UsageError: an unknown name, or
/// one that the log lacks data for.
[[nodiscard]] std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                                             const ClSurface& surface);

/// Columns of a log without positions: point, time, or a channel. No names: time and all channels. Throws UsageError: another
/// name.
[[nodiscard]] std::vector<io::ExportColumn> exported_channels(const std::vector<std::string>& names, const Log& log);

/// The same at some points of a part whose surface is read in parts; only fields of positions and channels, since
/// others depend on the whole log. `part`: the points and their surroundings; `points`: of the whole log.
[[nodiscard]] std::vector<io::ExportColumn> exported_columns(const std::vector<std::string>& names, const Part& part,
                                                             const ClSurface& surface,
                                                             const std::vector<PointRange>& ranges,
                                                             std::span<const PointIndex> points);

/// Every name that exported_columns() accepts for this part, with unit and meaning: first its own columns, then the fields
/// that can be computed, then channels of the log.
[[nodiscard]] std::vector<io::ListingRow> exportable_columns(const Part& part, const ClSurface& surface);

/// Runs a writer of VTK or HDF5 for an output. If it fails, the error names the output: these libraries know only its
/// temporary file. Throws SystemError.
template <typename Write>
void write_named(const std::string& output, const Write& write) {
    try {
        write();
    } catch (const SystemError& error) { throw SystemError(output + ": " + error.what()); }
}

}  // namespace clsurf::cli
