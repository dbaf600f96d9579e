#include "program/interpret/modal_state.h"

namespace clsurf {

WorkFrame ModalState::work_frame() const {
    const WorkOffset offset = work_offsets.active();
    WorkFrame now;
    now.local = Eigen::Translation3d(offset.shift) * Eigen::AngleAxisd(offset.rotation * rad_per_deg, Vec3::UnitZ()) *
                Eigen::Translation3d(work_offsets.shift.linear);
    if (offset.rotation == 0) now.local.linear().setIdentity();
    now.tool = tool_offset.total - tool_offset.assumed;
    now.rotary = work_offsets.rotary() * rad_per_deg;
    now.held = held;
    now.words = frame;
    now.absolute = absolute;
    if (work_offsets.system == 0) return now;  // G500 of Siemens
    constexpr unsigned whole = WorkFrame::all_axes | WorkFrame::rotation;
    now.free = static_cast<std::uint8_t>(offset.set == 0 ? whole : WorkFrame::all_axes & ~unsigned{offset.set});
    if (now.free != 0) now.system = offset.measured_from != 0 ? offset.measured_from : work_offsets.system;
    return now;
}

}  // namespace clsurf
