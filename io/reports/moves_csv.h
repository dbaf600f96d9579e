#pragma once
// The motions of a program as CSV, one row per motion, in the active work coordinate system: mm, deg, mm/min.
// Columns: line,kind,x,y,z,a,b,c,ci,cj,ck,turns,plane,feed; empty if not applicable.

#include <functional>
#include <string_view>

#include "machine/kinematics.h"
#include "program/program.h"

namespace clsurf::io {

/// Passes the text on in pieces of about a megabyte. With `kinematics` (nullptr: none) the columns ti,tj,tk follow:
/// the tool axis in the workpiece.
void write_moves_csv(const Motions& motions, const Kinematics* kinematics,
                     const std::function<void(std::string_view)>& write);

}  // namespace clsurf::io
