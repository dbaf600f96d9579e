#pragma once
// CutterPlace: where the tool is: its tip and, if the tool is known, the point where it touches the part. A mark is
// at the contact point; a position in the log or in the program is a tip.

#include <optional>

#include "core/geometry.h"

namespace clsurf {

struct CutterPlace {
    Vec3 tip = Vec3::Zero();      ///< [mm] in the workpiece
    std::optional<Vec3> contact;  ///< [mm]; nullopt: no tool is known, or it does not cut there

    /// The place on the part: the contact point if it is known, else the tip.
    [[nodiscard]] const Vec3& position() const { return contact ? *contact : tip; }
};

}  // namespace clsurf
