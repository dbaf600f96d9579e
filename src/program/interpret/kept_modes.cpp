#include "program/interpret/kept_modes.h"

#include <optional>

#include "program/interpret/feeds.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/offsets.h"
#include "program/interpret/path_modes.h"

namespace clsurf {

void keep_modes(Interpreter& in, int code) {
    std::optional<ModalState>& kept = in.calls_.kept_modes.back();
    if (code == 70 || code == 73) {
        kept = in.state_;
        if (code == 73) in.calls_.restores_modes.back() = true;
        return;
    }
    if (code == 71) {
        kept.reset();
        return;
    }
    if (!kept) {
        in.note(Severity::warning, "program.modes", "M72 without M70 or M73 before it");
        return;
    }
    restore_modes(in, *kept);
}

void restore_modes(Interpreter& in, const ModalState& kept) {
    in.state_.unit_mm = kept.unit_mm;
    in.state_.feed_unit_mm = kept.feed_unit_mm;
    in.state_.plane_axis = kept.plane_axis;
    in.state_.incremental = kept.incremental;
    in.state_.centre_absolute = kept.centre_absolute;
    select_feed_mode(in, kept.feed_mode);
    in.state_.feed = kept.feed;
    in.state_.spindle = kept.spindle;
    in.state_.retract_to_r = kept.retract_to_r;
    in.state_.diameter = kept.diameter;
    set_path_mode(in, "path-mode", "as it was", kept.path_mode);
    select_work_system(in, kept.work_offsets.system);
    if (kept.tool_offset.total.isZero()) in.state_.rebase([&] { in.state_.tool_offset = {}; });
    if (kept.work_offsets.shift.is_zero() && !in.state_.work_offsets.shift.is_zero()) restore_shift(in.state_, 92.2_g);
}

}  // namespace clsurf
