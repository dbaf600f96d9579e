#include "cli/contacts.h"

#include <algorithm>

#include "core/parallel.h"

namespace clsurf::cli {
namespace {

constexpr PointIndex bounds_points = 64;  ///< of a run, that tell its bounds

}  // namespace

PartContacts::PartContacts(const Part& part, const ClSurface& surface, const CuttingTool& tool)
    : part_(part), surface_(surface) {
    if (tilts(part.log, part.path)) {
        if (tool.kind == ToolKind::ball) {
            upright_path_ = upright_ball(part.log, part.path, tool.radius);
            upright_surface_ = clsurf::stitch(gather(*upright_path_), *part.lines);
        } else {
            axes_ = tool_axes(part.log, part.path.role, part.path);
        }
    }
    points_.emplace(this->surface(), path(), axes_ ? &*axes_ : nullptr, tool);
}

CutterPlace PartContacts::place(PointIndex point) const { return {part_.path.at(point), points_->at(point)}; }

std::vector<FoundPlace> PartContacts::find(const WantedPlace& wanted) const {
    std::vector<FoundPlace> found = find_places(path(), surface().passes, &*points_, surface().step_over, wanted);
    for (FoundPlace& f : found) f.place.tip = part_.path.at(f.point);
    return found;
}

void PartContacts::locate(QualityReport& report) const {
    for (std::vector<Defect>* list : {&report.defects, &report.expected}) {
        parallel_for(static_cast<std::int64_t>(list->size()), 1, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) locate((*list)[static_cast<std::size_t>(k)]);
        });
    }
}

void PartContacts::locate(Defect& defect) const {
    defect.place.contact = points_->at(defect.point);
    for (const DefectRun& run : defect.runs) {
        const PointIndex every = std::max<PointIndex>(1, run.points.size() / bounds_points);
        for (PointIndex i = run.points.first; i <= run.points.last; i += every) {
            if (const std::optional<Vec3> contact = points_->at(i)) defect.contact_bounds.extend(*contact);
        }
        if (const std::optional<Vec3> contact = points_->at(run.points.last)) defect.contact_bounds.extend(*contact);
    }
}

}  // namespace clsurf::cli
