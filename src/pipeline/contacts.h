#pragma once
// PartContacts: the contact points of a run's tool on the part.

#include <memory>
#include <optional>
#include <vector>

#include "compare/run_report.h"
#include "machined/contact_points.h"
#include "machined/place_search.h"
#include "pipeline/part.h"
#include "predictor/defects.h"

namespace clsurf {

/// Not movable.
class PartContacts {
public:
    /// `surface` is that of `path`. For a ball end mill with changing axis the centre is followed, with a separate surface.
    /// If rotary axes move and `path` was made without kinematics, no contact point is known. All arguments except `lines`
    /// must outlive the object. O(1), or O(points) with rotary axes.
    PartContacts(const Log& log, const Trajectory& path, const LineMap& lines, const ClSurface& surface,
                 const CuttingTool& tool);
    /// The same for the path of a part.
    PartContacts(const Part& part, const ClSurface& surface, const CuttingTool& tool)
        : PartContacts(part.log, part.path, *part.lines, surface, tool) {}
    PartContacts(const PartContacts&) = delete;
    PartContacts& operator=(const PartContacts&) = delete;

    /// False if the tool axis relative to the part is unknown.
    [[nodiscard]] bool known() const { return points_.has_value(); }
    [[nodiscard]] CutterPlace place(PointIndex point) const;
    /// As find_places(), by contact points.
    [[nodiscard]] std::vector<FoundPlace> find(const WantedPlace& wanted) const;
    /// Adds the contact points to the places of a report.
    void locate(QualityReport& report) const;
    void locate(RunReport& report) const;

private:
    void locate(Defect& defect) const;
    [[nodiscard]] std::optional<Vec3> contact_of(PointIndex point) const;
    [[nodiscard]] const Trajectory& path() const { return upright_path_ ? *upright_path_ : path_; }
    [[nodiscard]] const ClSurface& surface() const { return upright_surface_ ? *upright_surface_ : surface_; }

    const Trajectory& path_;
    const ClSurface& surface_;
    std::optional<Trajectory> upright_path_;  ///< for a ball end mill with changing axis
    std::optional<ClSurface> upright_surface_;
    std::optional<ContactPoints> points_;
};

}  // namespace clsurf
