#pragma once
// Look: the options of a map that `render` and `diff` share.

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "field/range.h"
#include "viz/scene.h"

namespace clsurf::cli {

struct LookOptions {
    viz::Look look;
    RangeRule range;
    std::string colour_map;  ///< empty: that of the field
    int bins = 0;
};

/// --style, --view, --zoom, --box, --range, --colormap, --bins, --size, --background, --no-legend, --gl.
void declare_look(po::options_description& options);
[[nodiscard]] LookOptions read_look_options(const po::variables_map& values);

/// The map's colours over a range: the requested map, or the default one of the field.
[[nodiscard]] viz::ColourScale scale_of(const FieldInfo& field, const ShownRange& range, const LookOptions& options);
/// Throws UsageError: --range, --colormap or --bins with a field whose values are names.
void refuse_scale_options(const FieldInfo& field, const LookOptions& options);

/// The text of an option, or a default if it is not given.
[[nodiscard]] std::string text_of(const po::variables_map& values, const char* name, const std::string& otherwise);

}  // namespace clsurf::cli
