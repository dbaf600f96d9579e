#pragma once
// --survey and --shards of `render`: the map of a long log, drawn shard by shard into one picture.

#include "cli/pictures/render_options.h"

namespace clsurf::cli {

/// The options of `render`, with --survey and --shards.
void declare_render_with_shards(po::options_description& options);

/// Draws the map with the memory of one shard where --survey is given; false: it is not. Throws UsageError: an option that
/// needs the whole log, a field without a range that is known before.
[[nodiscard]] bool draw_in_shards(const RenderOptions& options, const po::variables_map& values);

}  // namespace clsurf::cli
