#include "repair/points/orientation.h"

#include <cmath>

namespace clsurf {
namespace {

// Both angles: docs/optimize.md#five-axes, points that stay.
constexpr double least_from_pole = 2 * rad_per_deg;
constexpr double most_turn_of_line = 30 * rad_per_deg;  ///< larger turns do not belong to finishing, or wind up an axis
constexpr double same_angle = 1e-9;                     ///< [rad] as programmed; six decimals of a degree are 1.7e-8
constexpr int judged_places = 8;                        ///< of a line

}  // namespace

Orientation::Orientation(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start)
    : motions_(&program.motions), kinematics_(&machine.kinematics), blocks_(program, machine, zero, start) {
    const std::int64_t count = motions_->size();
    divisible_.resize(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) divisible_[static_cast<std::size_t>(i)] = is_divisible(i) ? 1 : 0;
}

bool Orientation::turns(std::int64_t motion) const {
    return turn_between(angles(motion, 0), angles(motion, 1)) > same_angle;
}

Vec3 Orientation::programmed(std::int64_t motion, const RotaryAngles& angles) const {
    Vec3 words = motions_->rotary[static_cast<std::size_t>(motion)].vec();
    const Vec3 mine = kinematics_->programmed(angles);
    for (const char letter : {kinematics_->tilt.letter, kinematics_->rotation.letter})
        words[letter - 'a'] = mine[letter - 'a'];
    return words;
}

bool Orientation::is_divisible(std::int64_t motion) const {
    const auto programmed = [&](std::int64_t i) {
        return i < 0 ? RotaryAngles{} : kinematics_->angles_of(motions_->rotary[static_cast<std::size_t>(i)].vec());
    };
    const RotaryAngles from = angles(motion, 0), to = angles(motion, 1);
    // Beyond the pole a controller may continue with the tilt on the other side than programmed.
    if (turn_between(from, programmed(motion - 1)) > same_angle || turn_between(to, programmed(motion)) > same_angle)
        return false;
    const Xyz words = motions_->rotary[static_cast<std::size_t>(motion)],
              before = motion > 0 ? motions_->rotary[static_cast<std::size_t>(motion - 1)] : Xyz{};
    if (words == before) return true;
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "abc"[axis];
        const bool mine = letter == kinematics_->tilt.letter || letter == kinematics_->rotation.letter;
        if (!mine && words.vec()[axis] != before.vec()[axis]) return false;
    }
    if (turn_between(from, to) > most_turn_of_line) return false;
    for (int k = 0; k <= judged_places; ++k) {
        const RotaryAngles at = angles(motion, static_cast<double>(k) / judged_places);
        if (from_pole(at) < std::sin(least_from_pole)) return false;
    }
    return true;
}

}  // namespace clsurf
