#pragma once
// ProgramFrame: the effect of a program's rotation, scaling, mirroring and local zeros (G68, G51, G52, TRANS, ROT …)
// on its coordinates: work position = turn · programmed position + shift.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry.h"
#include "core/units.h"

namespace clsurf {

class ProgramFrame {
public:
    [[nodiscard]] bool active() const { return active_; }
    [[nodiscard]] Vec3 to_work(const Vec3& p) const { return active_ ? Vec3(times(turn_, p) + shift_) : p; }
    [[nodiscard]] Vec3 to_programmed(const Vec3& w) const { return active_ ? times(back_, w - shift_) : w; }
    [[nodiscard]] Vec3 direction_to_work(const Vec3& d) const { return active_ ? times(turn_, d) : d; }
    [[nodiscard]] Vec3 direction_to_programmed(const Vec3& d) const { return active_ ? times(back_, d) : d; }

    /// First `inner`, then this one.
    [[nodiscard]] ProgramFrame around(const ProgramFrame& inner) const {
        return ProgramFrame(turn_ * inner.turn_, times(turn_, inner.shift_) + shift_);
    }
    static ProgramFrame moved(const Vec3& by) { return ProgramFrame(Eigen::Matrix3d::Identity(), by); }
    /// About `centre`.
    static ProgramFrame scaled(const Vec3& factors, const Vec3& centre) {
        return ProgramFrame(factors.asDiagonal(), centre - centre.cwiseProduct(factors));
    }
    /// Counter-clockwise about an axis through `centre` [deg].
    static ProgramFrame turned(const Vec3& axis, double degrees, const Vec3& centre = Vec3::Zero()) {
        Eigen::Matrix3d turn = Eigen::AngleAxisd(degrees * rad_per_deg, axis.normalized()).toRotationMatrix();
        // Quarter turns are exact, so that an axis that is still unknown does not affect the others.
        constexpr double rounding = 1e-15;
        turn = (turn.array().abs() < rounding).select(0.0, turn);
        return ProgramFrame(turn, centre - times(turn, centre));
    }

    /// The image of an arc about a principal axis: its new axis, and whether its direction is reversed; nullopt: the
    /// image is not a circle in a principal plane.
    struct Circle {
        int axis;
        bool reversed;
    };
    [[nodiscard]] std::optional<Circle> circle(int axis) const {
        if (!active_) return Circle{axis, false};
        constexpr double tolerance = 1e-9;
        const Vec3 u = turn_.col((axis + 1) % 3);
        const Vec3 v = turn_.col((axis + 2) % 3);
        if (std::abs(u.norm() - v.norm()) > tolerance * u.norm() || std::abs(u.dot(v)) > tolerance * u.squaredNorm())
            return std::nullopt;
        const Vec3 normal = u.cross(v).normalized();
        for (int k = 0; k < 3; ++k) {
            if (std::abs(normal[k]) < 1 - tolerance) continue;
            // A helix rises along its axis.
            if (turn_.col(axis).cross(normal).norm() > tolerance * turn_.col(axis).norm()) return std::nullopt;
            return Circle{k, normal[k] < 0};
        }
        return std::nullopt;
    }

    ProgramFrame() = default;

    [[nodiscard]] bool operator==(const ProgramFrame& other) const {
        return active_ == other.active_ && (!active_ || numbers() == other.numbers());
    }
    /// Numbers that identify the frame.
    [[nodiscard]] std::array<double, 12> numbers() const {
        std::array<double, 12> all{};
        std::copy_n(turn_.data(), 9, all.begin());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // About an unknown position: an arbitrary number that equals itself.
            const double shift = shift_[static_cast<Eigen::Index>(axis)];
            all[9 + axis] = std::isnan(shift) ? std::numeric_limits<double>::max() : shift;
        }
        return all;
    }

private:
    ProgramFrame(const Eigen::Matrix3d& turn, const Vec3& shift) : turn_(turn), back_(turn.inverse()), shift_(shift) {
        active_ = !(turn_.isIdentity(0) && shift_.isZero(0));
    }
    /// A product that ignores terms multiplied by zero: an unknown axis stays the only one.
    static Vec3 times(const Eigen::Matrix3d& m, const Vec3& p) {
        Vec3 result = Vec3::Zero();
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                if (m(i, k) != 0) result[i] += m(i, k) * p[k];
            }
        }
        return result;
    }

    Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity(), back_ = Eigen::Matrix3d::Identity();
    Vec3 shift_ = Vec3::Zero();  ///< [mm]
    bool active_ = false;
};

}  // namespace clsurf
