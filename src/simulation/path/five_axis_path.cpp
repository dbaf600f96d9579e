#include "simulation/path/five_axis_path.h"

#include <algorithm>
#include <cmath>

#include "core/not_finite.h"

namespace clsurf {
namespace {

constexpr double length_of_angle = 10;  ///< [mm/rad] of u, for blocks that only turn
// As on three axes (docs/simulate.md#2-corner-rounding).
constexpr std::size_t joints_reached = 20;  ///< joints to each side that a rounding may cross
constexpr double at_joint = 15.0 / 96.0;    ///< G(0)
constexpr double inside_chords = 4;         ///< width of a rounding inside a curved block, in chords
constexpr double least_turn = 1e-12;        ///< a smaller jump of the slope is ignored
constexpr double least_length = 1e-9;       ///< [mm] of a chord; ten times the rounding of doubles at 1 km

using VectorJet = std::array<Vec3, 4>;
using ScalarJet = std::array<double, 4>;

double rounding(double x) {
    return 15.0 / 16.0 * (1.0 / 6 + x * (-8.0 / 15 + x * (0.5 + x * x * (-1.0 / 6 + x * x / 30))));
}

/// The n-th derivatives of a product.
template <typename Result, typename A, typename B, typename Product>
Result leibniz(const A& a, const B& b, const Product& product) {
    return {product(a[0], b[0]), product(a[1], b[0]) + product(a[0], b[1]),
            product(a[2], b[0]) + 2 * product(a[1], b[1]) + product(a[0], b[2]),
            product(a[3], b[0]) + 3 * product(a[2], b[1]) + 3 * product(a[1], b[2]) + product(a[0], b[3])};
}

/// `v` rotated about a unit vector by `sign` times an angle; both vary along the path.
VectorJet turned_jet(const VectorJet& v, const Vec3& axis, const ScalarJet& angle, double sign) {
    const double s = std::sin(sign * angle[0]), c = std::cos(sign * angle[0]);
    const double d1 = sign * angle[1], d2 = sign * angle[2], d3 = sign * angle[3];
    const ScalarJet sine{s, c * d1, c * d2 - s * d1 * d1, c * d3 - 3 * s * d1 * d2 - c * d1 * d1 * d1};
    const ScalarJet cosine{c, -s * d1, -s * d2 - c * d1 * d1, -s * d3 - 3 * c * d1 * d2 + s * d1 * d1 * d1};
    VectorJet along, across, turned_by_quarter;
    for (std::size_t k = 0; k < 4; ++k) {
        along[k] = axis.dot(v[k]) * axis;
        across[k] = v[k] - along[k];
        turned_by_quarter[k] = axis.cross(v[k]);
    }
    const auto times = [](double a, const Vec3& b) -> Vec3 { return a * b; };
    const auto near = leibniz<VectorJet>(cosine, across, times);
    const auto side = leibniz<VectorJet>(sine, turned_by_quarter, times);
    for (std::size_t k = 0; k < 4; ++k) along[k] += near[k] + side[k];
    return along;
}

/// Kinematics::to_axes() with derivatives.
VectorJet to_axes(const Kinematics& k, VectorJet tip, const ScalarJet& tilt, const ScalarJet& rotation) {
    const VectorJet tool{k.tool_length * k.tool_axis, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    switch (k.type) {
        case KinematicsType::xyz: break;
        case KinematicsType::table_table: {
            tip[0] -= k.rotation_centre;
            VectorJet turned = turned_jet(tip, k.rotation.direction, rotation, -1);
            turned[0] += k.centre_from_tilt;
            turned = turned_jet(turned, k.tilt.direction, tilt, -1);
            turned[0] += k.tilt_point + tool[0];
            return turned;
        }
        case KinematicsType::head_head: {
            VectorJet head = turned_jet(tool, k.tilt.direction, tilt, 1);
            head[0] += k.tilt_from_rotation;
            head = turned_jet(head, k.rotation.direction, rotation, 1);
            for (std::size_t n = 0; n < 4; ++n) tip[n] += head[n];
            return tip;
        }
        case KinematicsType::table_head: {
            tip[0] -= k.rotation_centre;
            VectorJet turned = turned_jet(tip, k.rotation.direction, rotation, -1);
            const VectorJet head = turned_jet(tool, k.tilt.direction, tilt, 1);
            for (std::size_t n = 0; n < 4; ++n) turned[n] += head[n];
            turned[0] += k.rotation_centre;
            return turned;
        }
    }
    return tip;
}

}  // namespace

FiveAxisPath::FiveAxisPath(const Kinematics& kinematics, const Vec3& zero, const FiveAxes& begin,
                           const std::vector<FiveAxisChord>& chords)
    : kinematics_(&kinematics), zero_(zero) {
    FiveAxes at = begin;
    for (const FiveAxisChord& chord : chords) {
        const FiveAxes step = chord.end - at;
        const double length = std::hypot(step.head<3>().norm(), length_of_angle * step.tail<2>().norm());
        if (!(length > least_length)) continue;
        chords_.push_back(chord);
        begins_.push_back(at);
        slopes_.push_back(step / length);
        ends_.push_back(this->length() + length);
        at = chord.end;
    }
    set_widths();
}

void FiveAxisPath::set_widths() {
    if (chords_.size() < 2) return;
    joints_.resize(chords_.size() - 1);
    std::vector<double> of_tip(joints_.size()), of_angles(joints_.size(), kinematics_->axis_tolerance);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        joints_[j].turn = slopes_[j + 1] - slopes_[j];
        of_tip[j] = chords_[j + 1].tolerance;
    }
    fit(&Joint::tip_width, 0, 3, of_tip);
    fit(&Joint::angle_width, 3, 2, of_angles);
}

/// Widths that also satisfy the tolerances where roundings overlap: between joints the sum of the deviations is convex, and
/// at a joint all widths times f make it at most f times as great.
void FiveAxisPath::fit(double Joint::*width, int first, int count, const std::vector<double>& tolerances) {
    const std::size_t n = joints_.size();
    std::vector<double> turns(n), sums(n, 0.0), factors(n, 1.0);
    const auto reached = [&](std::size_t j, const auto& visit) {
        const double w = joints_[j].*width;
        for (std::size_t k = j; k < n && ends_[k] - ends_[j] < w; ++k) visit(k, (ends_[k] - ends_[j]) / w);
        for (std::size_t k = j; k-- > 0 && ends_[j] - ends_[k] < w;) visit(k, (ends_[j] - ends_[k]) / w);
    };
    for (std::size_t j = 0; j < n; ++j) {
        turns[j] = joints_[j].turn.segment(first, count).norm();
        if (!(turns[j] > least_turn)) continue;
        double w = tolerances[j] / (at_joint * turns[j]);
        // The ends of the path keep their positions, and a rounding reaches over a limited number of joints.
        const double before = j >= joints_reached ? ends_[j] - ends_[j - joints_reached] : ends_[j];
        const double after = (j + joints_reached < n ? ends_[j + joints_reached] : length()) - ends_[j];
        w = std::min({w, before, after});
        if (chords_[j + 1].inside)
            w = std::min(w, inside_chords * std::min(ends_[j] - begin_of(j), ends_[j + 1] - ends_[j]));
        joints_[j].*width = w;
        reached(j, [&](std::size_t k, double x) { sums[k] += turns[j] * w * rounding(x); });
    }
    for (std::size_t j = 0; j < n; ++j) {
        reached(j, [&](std::size_t k, double) { factors[j] = std::min(factors[j], tolerances[k] / sums[k]); });
    }
    for (std::size_t j = 0; j < n; ++j) joints_[j].*width *= factors[j];
}

std::size_t FiveAxisPath::chord_at(double u) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), u);
    return std::min(static_cast<std::size_t>(found - ends_.begin()), ends_.size() - 1);
}

double FiveAxisPath::clearance(double u) const {
    const std::size_t chord = chord_at(u);
    double clear = infinite;
    const std::size_t low = chord > joints_reached ? chord - joints_reached : 0,
                      high = std::min(joints_.size(), chord + joints_reached);
    for (std::size_t j = low; j < high; ++j) {
        const double width = std::max(joints_[j].tip_width, joints_[j].angle_width);
        clear = std::min(clear, std::abs(u - ends_[j]) - width);
    }
    return std::max(0.0, clear);
}

double FiveAxisPath::part_at(std::size_t chord, double u) const {
    const double from = begin_of(chord);
    const double share = std::clamp((u - from) / (ends_[chord] - from), 0.0, 1.0);
    const FiveAxisChord& c = chords_[chord];
    return c.part_from + share * (c.part_to - c.part_from);
}

FiveAxisPath::Jet FiveAxisPath::jet(double u, std::size_t chord) const {
    Jet jet{begins_[chord] + (u - begin_of(chord)) * slopes_[chord], slopes_[chord], FiveAxes::Zero(),
            FiveAxes::Zero()};
    const auto add = [&](std::size_t j, int first, int count, double w) {
        const double d = u - ends_[j];
        if (!(std::abs(d) < w)) return;  // most joints are out of reach
        const double x = std::abs(d) / w;
        const auto turn = joints_[j].turn.segment(first, count);
        const double rest = 1 - x * x, side = d < 0 ? -1 : 1;
        const double sum = 15.0 / 16.0 * (8.0 / 15 - x * (1 - x * x * (2.0 / 3 - x * x / 5)));
        jet[0].segment(first, count) += w * rounding(x) * turn;
        jet[1].segment(first, count) -= side * sum * turn;
        jet[2].segment(first, count) += 15.0 / 16.0 * rest * rest / w * turn;
        jet[3].segment(first, count) -= side * 15.0 / 4.0 * x * rest / (w * w) * turn;
    };
    const std::size_t low = chord > joints_reached ? chord - joints_reached : 0,
                      high = std::min(joints_.size(), chord + joints_reached);
    for (std::size_t j = low; j < high; ++j) {
        add(j, 0, 3, joints_[j].tip_width);
        add(j, 3, 2, joints_[j].angle_width);
    }
    return jet;
}

FiveAxisPlace FiveAxisPath::at(double u) const {
    const std::size_t chord = chord_at(u);
    const Jet here = jet(u, chord);
    const FiveAxes& place = here[0];
    const Vec3 plain = (begins_[chord] + (u - begin_of(chord)) * slopes_[chord]).head<3>();
    return {place.head<3>(), {place[3], place[4]}, (place.head<3>() - plain).norm(), here[1].head<3>().norm()};
}

AxisSample<5> FiveAxisPath::derivatives(double u, PathDerivatives& tip) const {
    const Jet at = jet(u, chord_at(u));
    VectorJet tips;
    ScalarJet tilt, rotation;
    for (std::size_t k = 0; k < 4; ++k) {
        tips[k] = at[k].head<3>();
        tilt[k] = at[k][3];
        rotation[k] = at[k][4];
    }
    tip = {tips[1], tips[2], tips[3]};
    tips[0] += zero_;
    const VectorJet axes = to_axes(*kinematics_, tips, tilt, rotation);
    AxisSample<5> sample;
    sample.first << axes[1], tilt[1], rotation[1];
    sample.second << axes[2], tilt[2], rotation[2];
    sample.third << axes[3], tilt[3], rotation[3];
    const double pace = tip.first.norm();
    if (pace > least_turn) sample.pace = pace_of(tip);
    return sample;
}

std::vector<double> FiveAxisPath::places() const {
    std::vector<double> places{0, length()};
    for (std::size_t i = 0; i < chords_.size(); ++i) {
        const double begin = begin_of(i), length_of_chord = ends_[i] - begin;
        for (int k = 0; k < 8; ++k) places.push_back(begin + length_of_chord * k / 8);
        if (i == joints_.size()) continue;
        for (const double w : {joints_[i].tip_width, joints_[i].angle_width}) {
            if (!(w > 0)) continue;
            // If the chord is shorter than the rounding, its own places are dense enough.
            const bool before = w <= length_of_chord, after = w <= ends_[i + 1] - ends_[i];
            for (const double x : {0.2, 0.58, 1.0}) {
                if (before) places.push_back(ends_[i] - x * w);
                if (after) places.push_back(ends_[i] + x * w);
            }
        }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end(), [](double a, double b) { return b - a < least_length; }),
                 places.end());
    return places;
}

}  // namespace clsurf
