#pragma once
// Targets of the axis words of a block: X Y Z, A B C, polar words, ANG=.

#include <optional>

#include "core/geometry.h"
#include "program/interpret/frames.h"
#include "program/interpret/modal_state.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// The target of the axis words in the work system [mm].
[[nodiscard]] Vec3 target_of(Interpreter& in, const Block& block, bool machine);
/// The axis words in machine or in programmed coordinates.
[[nodiscard]] Vec3 read_axes(Interpreter& in, const Block& block, bool machine);
/// With polar words: the coordinate along the plane's normal.
void straight_to_pole_plane(const ModalState& state, const Block& block, const Vec3& from, Vec3& end);
/// The position at radius and angle about the pole.
void put_at_pole(const PolarState& polar, int plane_axis, Vec3& end);
/// The end of a motion by radius [programmed lengths] and angle [deg] about the pole; a value that is not given is
/// unchanged.
void put_about_pole(PolarState& polar, const ModalState& state, std::optional<double> radius,
                    std::optional<double> angle, bool radius_adds, bool angle_adds, Vec3& end);
/// A, B, C [deg].
[[nodiscard]] Vec3 rotary_target(Interpreter& in, const Block& block);
/// ANG= with one coordinate of the plane: a line whose angle determines the other coordinate.
[[nodiscard]] bool ends_by_angle(const ModalState& state, const Block& block);

}  // namespace clsurf
