#pragma once
// --survey and --shards of `render`: the map of a long log, drawn shard by shard into one picture.

#include "cli/pictures/render_options.h"

namespace clsurf::cli {

/// The options of `render`, with --survey and --shards.
void declare_render_with_shards(po::options_description& options);

/// With --survey, draws the map in the memory of one shard and returns true. Throws UsageError: an option that
/// needs the whole log, a field whose range is not known in advance.
[[nodiscard]] bool draw_in_shards(const RenderOptions& options, const po::variables_map& values);

}  // namespace clsurf::cli
