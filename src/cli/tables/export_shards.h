#pragma once
// --shard and --merge of `export`: the surface of a long log in pieces.

#include <string>
#include <vector>

#include "cli/options/survey_options.h"
#include "io/reports/export_table.h"
#include "viz/export_vtk.h"

namespace clsurf::cli {

/// Columns for VTK files. Not copied: they must outlive the result.
[[nodiscard]] std::vector<viz::PointData> point_data_of(const std::vector<io::ExportColumn>& columns);

/// --survey, --shard, --merge.
void declare_export_shards(po::options_description& options);

/// --merge: writes a .pvtp file that lists the pieces, or a .vtkhdf file with the pieces as partitions.
ExitCode merge_pieces(const po::variables_map& values);

/// --shard: writes a piece with these columns.
ExitCode write_shard(const PartOptions& options, const ShardNumber& shard, const std::vector<std::string>& names,
                     const po::variables_map& values);

}  // namespace clsurf::cli
