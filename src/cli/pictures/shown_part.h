#pragma once
// One log as `render` shows it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/pictures/render_options.h"
#include "cli/stage_clock.h"
#include "field/field.h"
#include "field/range.h"
#include "pipeline/contacts.h"
#include "pipeline/part.h"
#include "predictor/defect.h"
#include "viz/height_map.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// The findings of `check`, with outlines on the surface.
struct ShownDefects {
    QualityReport report;
    std::vector<viz::OutlineMark> outlines;  ///< outlines of report.defects
};

/// The source of the points.
enum class PointOrigin : std::uint8_t { log, simulation, program };

/// A part with its surface and its field.
struct Shown {
    PointOrigin origin = PointOrigin::log;
    Part part;
    ClSurface surface;
    Field field;
    viz::FieldClasses classes;                 ///< classes of the field, if its values are names
    std::optional<viz::HeightMap> height_map;  ///< the as-machined surface; the field then has values at its vertices
    ShownDefects defects;
    std::vector<std::vector<Vec3>> programmed;  ///< path of the program as lines [mm]; empty: not requested
    std::unique_ptr<const PartContacts>
        contacts;  ///< contacts of the as-machined surface; once set, `this` does not move

    /// The position of a point's mark in the picture [mm].
    [[nodiscard]] Vec3 place_of(PointIndex i) const {
        return contacts ? contacts->place(i).position() : surface.positions.absolute(i);
    }
};

/// Reads a part and computes its field (empty: as RenderOptions::field); with `defects` also the findings of `check`. Without
/// a log, quantities of the program itself are shown on its path, all others on a simulation. Throws InputError,
/// UsageError.
[[nodiscard]] Shown load_shown(const PartOptions& options, const std::string& field, bool defects, StageClock& clock);

/// Adds the path of the program as thin lines. Throws UsageError: it cannot be shown; InputError.
void show_programmed(Shown& shown, const PartOptions& options);

/// Keeps only the selection. Throws UsageError: it is empty.
void show_selection(Shown& shown, const Selection& selection);

/// Replaces the surface by the as-machined one, in the resolution of the picture.
void show_as_machined(Shown& shown, const RenderOptions& options, StageClock& clock);

/// The range of values in the picture.
[[nodiscard]] ShownRange range_in_picture(const Shown& shown, const RenderOptions& options, const viz::Camera& camera);

/// Warns on stderr of marks outside the picture, whose absence may go unnoticed.
void warn_of_marks_outside(const Shown& shown, const RenderOptions& options, const viz::Camera& camera,
                           const po::variables_map& values);

}  // namespace clsurf::cli
