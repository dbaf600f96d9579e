#pragma once
// Per-point columns as files: CSV and BIIP.

#include <string>
#include <vector>

#include "core/column.h"
#include "core/point.h"

namespace clsurf::io {

/// A column to be written: 32-bit numbers, or 64-bit ones if necessary.
struct ExportColumn {
    std::string name;
    std::string unit;
    Column<float> values;          ///< shown units
    Column<double> exact;          ///< positions and times; empty: `values`
    Column<std::uint32_t> counts;  ///< lines and points; empty: `values`

    [[nodiscard]] PointIndex size() const;
};

/// Headers "name [unit]"; the shortest numbers that read back the same; empty fields for missing values.
/// O(points), parallel. Throws SystemError.
void write_csv(const std::string& path, const std::vector<ExportColumn>& columns);

/// The columns as channels of a BIIP log.
void write_biip_table(const std::string& path, const std::vector<ExportColumn>& columns, double period,
                      const std::string& metadata);

}  // namespace clsurf::io
