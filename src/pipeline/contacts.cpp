#include "pipeline/contacts.h"

#include <algorithm>

#include "core/parallel.h"
#include "surface/stitch.h"

namespace clsurf {
namespace {

constexpr PointIndex bounds_points = 64;  ///< points per run for its bounds

template <typename Work>
void for_each_index(std::size_t count, Work&& work) {
    parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) work(static_cast<std::size_t>(k));
    });
}

}  // namespace

PartContacts::PartContacts(const Log& log, const Trajectory& path, const LineMap& lines, const ClSurface& surface,
                           const CuttingTool& tool)
    : path_(path), surface_(surface) {
    std::optional<ToolAxes> axes;  // for a tool with changing axis
    if (!path.axis_known || (!path.kinematics && find_rotary_motion(log, path.role))) return;
    if (tilts(log, path)) {
        // On tilted planes the axis is constant, and the surface of the tips is the shifted surface of the centres.
        if (tool.kind == ToolKind::ball && path.stated_axes == nullptr) {
            upright_path_ = upright_ball(log, path, tool.radius);
            upright_surface_ = stitch(gather(*upright_path_), lines);
        } else {
            axes = tool_axes(log, path.role, path);
        }
    }
    points_.emplace(this->surface(), this->path(), std::move(axes), tool);
}

std::optional<Vec3> PartContacts::contact_of(PointIndex point) const {
    return points_ ? points_->at(point) : std::nullopt;
}

CutterPlace PartContacts::place(PointIndex point) const { return {path_.at(point), contact_of(point)}; }

std::vector<FoundPlace> PartContacts::find(const WantedPlace& wanted) const {
    if (!points_) return {};
    std::vector<FoundPlace> found = find_places(path(), surface().passes, &*points_, surface().step_over, wanted);
    for (FoundPlace& f : found) f.place.tip = path_.at(f.point);
    return found;
}

void PartContacts::locate(QualityReport& report) const {
    for (std::vector<Defect>* list : {&report.defects, &report.expected})
        for_each_index(list->size(), [&](std::size_t k) { locate((*list)[k]); });
}

void PartContacts::locate(RunReport& report) const {
    for_each_index(report.sections.size(), [&](std::size_t k) {
        RunDifferenceSection& section = report.sections[k];
        section.place.contact = contact_of(section.point);
    });
}

void PartContacts::locate(Defect& defect) const {
    defect.place.contact = contact_of(defect.point);
    for (const DefectSection& section : defect.sections) {
        const PointIndex every = std::max<PointIndex>(1, section.points.size() / bounds_points);
        for (PointIndex i = section.points.first; i <= section.points.last; i += every) {
            if (const std::optional<Vec3> contact = contact_of(i)) defect.contact_bounds.extend(*contact);
        }
        if (const std::optional<Vec3> contact = contact_of(section.points.last)) defect.contact_bounds.extend(*contact);
    }
}

}  // namespace clsurf
