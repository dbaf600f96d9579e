#pragma once
// ToolState: the known tools and the one in the spindle. CompensationState: the state of cutter compensation.

#include <cstddef>
#include <cstdint>

#include "core/geometry.h"
#include "program/interpret/cutter_compensation.h"
#include "program/tool_table.h"

namespace clsurf {

struct ToolState {
    ToolTable table;
    int next = 0;  ///< number of the T word
    Tool in_spindle;
    int length_row = 0, radius_row = 0;  ///< last programmed by H and D
};

struct CompensationState {
    CutterCompensation path;
    std::size_t open_motions = 0;    ///< the first motion whose end an inside corner may still move
    bool enters_at_offset = false;   ///< G41 of the controls: the next motion determines the end of the entry
    bool entry_programmed = false;   ///< the entry move has been read
    std::int64_t ended_at = -1;      ///< motions before G40: the next one is a straight one
    std::int64_t unread_since = -1;  ///< number of motions when position and machine diverged
    Vec3 unread = Vec3::Zero();      ///< from the position in the program to the last motion's end [mm]
};

}  // namespace clsurf
