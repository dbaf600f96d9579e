#pragma once
// What changed from one run to the other: the third map of `render --before`.

#include <functional>
#include <optional>
#include <string>

#include "cli/pictures/render_options.h"
#include "cli/pictures/shown_part.h"
#include "viz/image.h"

namespace clsurf::cli {

/// "2 gone, 1 new, 5 remaining", of the defects of both. Domain: they were looked for.
[[nodiscard]] std::string changed_defects_text(const Shown& before, const Shown& after);

/// "roughness Ra 1.80 to 1.85 µm, …", of the surfaces that both leave. Empty: the tool is not known, or is not the same.
[[nodiscard]] std::string changed_roughness_text(const Shown& before, const Shown& after);

/// The field of the later run minus that of the earlier one, place by place, as large as `options` say. `range`: of the maps of
/// both, which tells how large a difference is. Nothing where there is none to draw: classes, machined surfaces, runs
/// that nowhere follow the same path.
[[nodiscard]] std::optional<viz::Image> draw_change(const Shown& before, const Shown& after, double range,
                                                    const RenderOptions& options);

/// The map that `draw` makes, with the map of the differences below it, or at its right in a wide picture. Without the second
/// one if there is nothing to compare. `draw` gets a look with the size that the first map has.
[[nodiscard]] viz::Image draw_with_change(const Shown& before, const Shown& after, double range, RenderOptions options,
                                          const std::function<viz::Image(const viz::Look&)>& draw);

}  // namespace clsurf::cli
