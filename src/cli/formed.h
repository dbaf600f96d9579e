#pragma once
// Formed: a part's formed surface for `render`, `check` and `plot`.

#include "cli/quality.h"
#include "quality/formed_report.h"
#include "viz/relief.h"
#include "viz/view.h"

namespace clsurf::cli {

/// A part with what its formed surface refers to; does not move once it is made.
class FormedPart {
public:
    /// Sweeps `tool` along the role's positions (none: the most truthful ones of the log) of the part,
    /// whose path is the commanded one where the log has it. Both must outlive it.
    FormedPart(const Part& part, const ClSurface& surface, std::optional<Role> role, const CuttingTool& tool,
               StageClock& clock);
    FormedPart(const FormedPart&) = delete;
    FormedPart& operator=(const FormedPart&) = delete;

    [[nodiscard]] const FormedSurface& surface() const { return *formed_; }
    [[nodiscard]] const Signals& signals() const { return upright_ ? upright_->read.signals : read_.signals; }

private:
    std::unique_ptr<const UprightPart>
        upright_;  ///< of a tool that is tilted; then nothing was read of the part itself
    PartSignals read_;
    std::optional<FormedSurface> formed_;
};

/// What a map of the formed surface is drawn from.
struct FormedMap {
    viz::Relief relief;
    Field field;  ///< deviations over the relief's vertices
};

/// As fine as a picture's pixels, each vertex the mean of its cells. `box` empty: all that `camera` shows.
[[nodiscard]] FormedMap make_formed_map(const FormedPart& formed, const Box3& box, const viz::Camera& camera);

}  // namespace clsurf::cli
