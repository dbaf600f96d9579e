#pragma once
// PartContacts: where the tool of a part touches it.

#include <memory>
#include <optional>
#include <vector>

#include "cli/part.h"
#include "quality/contact_points.h"
#include "quality/defects.h"
#include "quality/place_search.h"

namespace clsurf::cli {

/// Does not move once it is made.
class PartContacts {
public:
    /// `surface` is that of the part. A ball that tilts is followed by its centre: then a surface of its own is
    /// made. Both must outlive it. O(1), or O(points) for a tool that tilts.
    PartContacts(const Part& part, const ClSurface& surface, const CuttingTool& tool);
    PartContacts(const PartContacts&) = delete;
    PartContacts& operator=(const PartContacts&) = delete;

    [[nodiscard]] CutterPlace place(PointIndex point) const;
    /// As find_places(), by contact points.
    [[nodiscard]] std::vector<FoundPlace> find(const WantedPlace& wanted) const;
    /// Adds the contact points to the defects of a report.
    void locate(QualityReport& report) const;

private:
    void locate(Defect& defect) const;
    [[nodiscard]] const Trajectory& path() const { return upright_path_ ? *upright_path_ : part_.path; }
    [[nodiscard]] const ClSurface& surface() const { return upright_surface_ ? *upright_surface_ : surface_; }

    const Part& part_;
    const ClSurface& surface_;
    std::optional<Trajectory> upright_path_, axes_;  ///< of a tool that tilts: a ball's, another one's
    std::optional<ClSurface> upright_surface_;
    std::optional<ContactPoints> points_;
};

}  // namespace clsurf::cli
