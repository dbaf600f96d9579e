#pragma once
// A plane of the workpiece that the tool stands on upright: when it begins and ends, and how the axes turn there.

#include <string>

#include "core/geometry.h"

namespace clsurf {

class Interpreter;

/// `text`: the words of the program.
void begin_tilted_plane(Interpreter& in, const std::string& text);
void end_tilted_plane(Interpreter& in, const std::string& text);
/// The rotary axes turn until the tool stands upright on the plane; the others stand still meanwhile, or
/// keep the tip where it is.
void turn_to_plane(Interpreter& in, const Vec3& axis, bool keeps_tip, const std::string& text);

}  // namespace clsurf
