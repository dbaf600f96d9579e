#pragma once
// What `render` draws of the parts that it has loaded: marks, titles and footnotes.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/pictures/render_options.h"
#include "cli/pictures/shown_part.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// The run that a map shows: "run.biip", "simulated on mill", "as programmed".
[[nodiscard]] std::string run_name(const Shown& shown, const RenderOptions& options);
/// The ramps at the ends of passes are drawn paler, because all passes have them.
[[nodiscard]] bool is_speed(const FieldInfo& field);
/// One part with its marks. Refers to `shown`. Throws UsageError: a mark that the log does not have.
[[nodiscard]] viz::MapPanel panel_of(const Shown& shown, const RenderOptions& options, std::string caption);

/// Title, subtitle and footnotes of a map that a field colours.
[[nodiscard]] viz::MapTexts texts_of(const Shown& shown, const std::optional<Shown>& before,
                                     const RenderOptions& options, const std::vector<std::string>& range_notes);

/// The defect map: a grey relief, the sections at fault on it, and their names beside it.
[[nodiscard]] viz::Image draw_defect_map(const Shown& shown, const RenderOptions& options);

}  // namespace clsurf::cli
