#pragma once
// What `render` shows of one log.

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
#include "viz/relief.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// What `check` finds, and its outlines on the surface.
struct ShownDefects {
    QualityReport report;
    std::vector<viz::OutlineMark> outlines;  ///< of report.defects
};

/// Where the points come from.
enum class PointOrigin : std::uint8_t { log, simulation, program };

/// A part with its surface and its field.
struct Shown {
    PointOrigin origin = PointOrigin::log;
    Part part;
    ClSurface surface;
    Field field;
    viz::FieldClasses classes;          ///< of the field, where its values are names
    std::optional<viz::Relief> relief;  ///< the formed surface, whose vertices have the field then
    ShownDefects defects;
    std::vector<std::vector<Vec3>> programmed;     ///< path of the program as lines [mm]; empty: not asked for
    std::unique_ptr<const PartContacts> contacts;  ///< of the formed surface; `this` does not move any more

    /// Where a point is marked in the picture [mm].
    [[nodiscard]] Vec3 place_of(PointIndex i) const {
        return contacts ? contacts->place(i).position() : surface.positions.absolute(i);
    }
};

/// Reads a part and computes its field (empty: as RenderOptions::field); with `defects` also what `check` finds. Without a log
/// the points of what a program itself says are on its path, and all others those of a simulation. Throws InputError,
/// UsageError.
[[nodiscard]] Shown load_shown(const PartOptions& options, const std::string& field, bool defects, StageClock& clock);

/// The path of the program, to be drawn as thin lines. Throws UsageError: it cannot be shown; InputError.
void show_programmed(Shown& shown, const PartOptions& options);

/// Leaves what was selected. Throws UsageError: nothing is left.
void show_selection(Shown& shown, const Selection& selection);

/// The formed surface in place of the positions', as fine as the picture shows it.
void show_as_machined(Shown& shown, const RenderOptions& options, StageClock& clock);

/// The range of what lies in the picture.
[[nodiscard]] ShownRange range_in_picture(const Shown& shown, const RenderOptions& options, const viz::Camera& camera);

/// A mark that the picture cannot show is said on stderr, since its lack may not be noticed.
void warn_of_marks_outside(const Shown& shown, const RenderOptions& options, const viz::Camera& camera,
                           const po::variables_map& values);

}  // namespace clsurf::cli
