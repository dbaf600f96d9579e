#pragma once
// The changes between two runs: the third map of `render --before`.

#include <functional>
#include <optional>
#include <string>

#include "cli/pictures/render_options.h"
#include "cli/pictures/shown_part.h"
#include "viz/image.h"

namespace clsurf::cli {

/// "2 gone, 1 new, 5 remaining", from the defects of both. Domain: the defects of both are known.
[[nodiscard]] std::string changed_defects_text(const Shown& before, const Shown& after);

/// "roughness Ra 1.80 to 1.85 µm, …", of both surfaces. Empty: the tool is not known, or not the same.
[[nodiscard]] std::string changed_roughness_text(const Shown& before, const Shown& after);

/// The field of the later run minus that of the earlier one at the same path locations, in the size of `options`. `range`:
/// the range of both maps, for the scale of the differences. Nothing if there is no difference to draw: classes, as-machined
/// surfaces, runs without a common path.
[[nodiscard]] std::optional<viz::Image> draw_change(const Shown& before, const Shown& after, double range,
                                                    const RenderOptions& options);

/// The map that `draw` makes, with the map of the differences below it, or to its right in a wide picture. Without the
/// latter if there is nothing to compare. `draw` gets a look with the size of the first map.
[[nodiscard]] viz::Image draw_with_change(const Shown& before, const Shown& after, double range, RenderOptions options,
                                          const std::function<viz::Image(const viz::Look&)>& draw);

}  // namespace clsurf::cli
