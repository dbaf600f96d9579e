#pragma once
// The content of `render` for loaded parts: marks, titles and footnotes.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/pictures/render_options.h"
#include "cli/pictures/shown_part.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// The name of a run in a map: "run.biip", "simulated on mill", "as programmed".
[[nodiscard]] std::string run_name(const Shown& shown, const RenderOptions& options);
/// Whether a field is a speed. Its ramps at the ends of passes are drawn paler, because all passes have them.
[[nodiscard]] bool is_speed(const FieldInfo& field);
/// One part with its marks. Refers to `shown`. Throws UsageError: a mark at a point or line that the log does not have.
[[nodiscard]] viz::MapPanel panel_of(const Shown& shown, const RenderOptions& options, std::string caption);

/// Title, subtitle and footnotes of a map coloured by a field.
[[nodiscard]] viz::MapTexts texts_of(const Shown& shown, const std::optional<Shown>& before,
                                     const RenderOptions& options, const std::vector<std::string>& range_notes);

/// The defect map: the surface in grey with the defective sections, and their names next to it.
[[nodiscard]] viz::Image draw_defect_map(const Shown& shown, const RenderOptions& options);

}  // namespace clsurf::cli
