#pragma once
// A tilted plane: its begin and end, and the rotation of the axes to it.

#include <string>

#include "core/geometry.h"

namespace clsurf {

class Interpreter;

/// `text`: the words of the program.
void begin_tilted_plane(Interpreter& in, const std::string& text);
void end_tilted_plane(Interpreter& in, const std::string& text);
/// The rotary axes turn until the tool is normal to the plane; meanwhile the others are at rest, or keep the tip in
/// place.
void turn_to_plane(Interpreter& in, const Vec3& axis, bool keeps_tip, const std::string& text);

}  // namespace clsurf
