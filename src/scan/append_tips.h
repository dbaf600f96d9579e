#pragma once
// The tips of a pass in the XZ plane, as a chain of chords.

#include <vector>

#include "program/program.h"

namespace clsurf {

/// Appends the tips [mm] of a motion at feed: points on its spline, if it is one, and its end.
inline void append_tips(const Motions& motions, std::int64_t motion, std::vector<Vec2>& tips) {
    if (const Curve* curve = motions.curve_of(motion)) {
        constexpr int divided = 32;
        for (int n = 1; n < divided; ++n) {
            const Vec3 at = curve->span->at(static_cast<double>(n) / divided);
            tips.emplace_back(at.x(), at.z());
        }
    }
    const Xyz& end = motions.end[static_cast<std::size_t>(motion)];
    tips.emplace_back(end.x, end.z);
}

}  // namespace clsurf
