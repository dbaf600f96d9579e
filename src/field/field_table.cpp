#include "field/field_table.h"

#include <array>
#include <cmath>
#include <limits>

#include "machine/kinematics.h"

namespace clsurf {
namespace {

constexpr double slowest_for_direction = 0.1;  ///< [mm/s]; slower, the feed has no direction

double norm(const double* const (&v)[3], std::size_t i) {
    return std::sqrt(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
}

/// A row's kernel from a function of one point.
template <auto value>
void each(const FieldBlock& block, float* out) {
    for (std::size_t i = 0; i < block.count; ++i) out[i] = static_cast<float>(value(block, i));
}

double speed(const FieldBlock& b, std::size_t i) { return norm(b.velocity, i); }
double acceleration(const FieldBlock& b, std::size_t i) { return norm(b.acceleration, i); }
double jerk(const FieldBlock& b, std::size_t i) { return norm(b.jerk, i); }

double tangential(const FieldBlock& b, std::size_t i) {
    const double v = norm(b.velocity, i);
    if (!(v > slowest_for_direction)) return std::numeric_limits<double>::quiet_NaN();
    return (b.acceleration[0][i] * b.velocity[0][i] + b.acceleration[1][i] * b.velocity[1][i] +
            b.acceleration[2][i] * b.velocity[2][i]) /
           v;
}

/// |v × a|.
double cross_norm(const FieldBlock& b, std::size_t i) {
    const auto part = [&](int k, int l) {
        return b.velocity[k][i] * b.acceleration[l][i] - b.velocity[l][i] * b.acceleration[k][i];
    };
    const double x = part(1, 2);
    const double y = part(2, 0);
    const double z = part(0, 1);
    return std::sqrt(x * x + y * y + z * z);
}
double normal(const FieldBlock& b, std::size_t i) {
    const double v = norm(b.velocity, i);
    return v > slowest_for_direction ? cross_norm(b, i) / v : std::numeric_limits<double>::quiet_NaN();
}
double curvature(const FieldBlock& b, std::size_t i) {
    const double v = norm(b.velocity, i);
    return v > slowest_for_direction ? cross_norm(b, i) / (v * v * v) : std::numeric_limits<double>::quiet_NaN();
}

double following_error(const FieldBlock& b, std::size_t i) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double d = b.measured[k][i] - b.commanded[k][i];
        sum += d * d;
    }
    return std::sqrt(sum);
}

double uncertainty_of(const FieldBlock& b, std::size_t i) { return b.uncertainty[i]; }

template <int axis>
double position_of(const FieldBlock& b, std::size_t i) {
    return b.position[axis][i];
}
template <int axis>
double velocity_of(const FieldBlock& b, std::size_t i) {
    return b.velocity[axis][i];
}
template <int axis>
double acceleration_of(const FieldBlock& b, std::size_t i) {
    return b.acceleration[axis][i];
}
template <int axis>
double jerk_of(const FieldBlock& b, std::size_t i) {
    return b.jerk[axis][i];
}
template <int axis>
double error_of(const FieldBlock& b, std::size_t i) {
    return b.measured[axis][i] - b.commanded[axis][i];
}

/// Angle between commanded and measured tool axis, by atan2: good near 0.
double orientation_error(const FieldBlock& b, std::size_t i) {
    const Vec3 commanded(b.commanded[0][i], b.commanded[1][i], b.commanded[2][i]);
    return angle_between(commanded, Vec3(b.measured[0][i], b.measured[1][i], b.measured[2][i]));
}

/// Squared distance of the measured point i to the commanded way from point k to k + 1.
double squared_to_step(const FieldBlock& b, std::size_t i, std::ptrdiff_t k) {
    double way2 = 0;
    double dot = 0;
    double far2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = b.commanded[axis][k + 1] - b.commanded[axis][k];
        const double to = b.measured[axis][i] - b.commanded[axis][k];
        way2 += way * way;
        dot += way * to;
        far2 += to * to;
    }
    if (!(way2 > 0)) return far2;
    const double t = std::fmin(1.0, std::fmax(0.0, dot / way2));
    return std::fmax(0.0, far2 - 2 * t * dot + t * t * way2);
}

/// Distance of the measured point to the commanded path round it. The foot is followed from point to
/// point, a lag behind the command; positions reach `halo` points beyond the block (field_set.cpp).
void contour_error(const FieldBlock& b, float* out) {
    std::ptrdiff_t foot = -1;  // the step before the same time: where a lagging axis is
    for (std::size_t i = 0; i < b.count; ++i) {
        const auto here = static_cast<std::ptrdiff_t>(i);
        foot = std::max<std::ptrdiff_t>(std::min(foot + 1, here), here - 250);
        double best = squared_to_step(b, i, foot);
        for (const int direction : {-1, 1}) {
            for (std::ptrdiff_t k = foot + direction; k > here - 256 && k < here + 8; k += direction) {
                const double next = squared_to_step(b, i, k);
                if (!(next <= best)) break;
                best = next;
                foot = k;
            }
        }
        out[i] = static_cast<float>(std::sqrt(best));
    }
}

constexpr Unit deg_min{"deg/min", (deg_per_rad * seconds_per_minute)};
constexpr Unit deg_s2{"deg/s²", deg_per_rad};
constexpr FieldScale up = FieldScale::sequential;
constexpr FieldScale both = FieldScale::diverging;

constexpr auto table = std::to_array<FieldRow>({
    {"speed", "Path speed", unit::mm_min, up, needs::velocity, each<speed>},
    {"acceleration", "Acceleration", unit::mm_s2, up, needs::acceleration, each<acceleration>},
    {"jerk", "Jerk", unit::mm_s3, up, needs::jerk, each<jerk>},
    {"tangential_acceleration", "Acceleration along the path", unit::mm_s2, both, needs::velocity | needs::acceleration,
     each<tangential>},
    {"normal_acceleration", "Acceleration across the path", unit::mm_s2, up, needs::velocity | needs::acceleration,
     each<normal>},
    {"curvature", "Curvature of the path", unit::per_mm, up, needs::velocity | needs::acceleration, each<curvature>},
    {"following_error", "Following error", unit::um, up, needs::error, each<following_error>},
    {"contour_error", "Contour error", unit::um, up, needs::error, contour_error},
    {"following_error.x", "Following error of X", unit::um, both, needs::error, each<error_of<0>>},
    {"following_error.y", "Following error of Y", unit::um, both, needs::error, each<error_of<1>>},
    {"following_error.z", "Following error of Z", unit::um, both, needs::error, each<error_of<2>>},
    {"speed.x", "Speed of X", unit::mm_min, both, needs::velocity, each<velocity_of<0>>},
    {"speed.y", "Speed of Y", unit::mm_min, both, needs::velocity, each<velocity_of<1>>},
    {"speed.z", "Speed of Z", unit::mm_min, both, needs::velocity, each<velocity_of<2>>},
    {"acceleration.x", "Acceleration of X", unit::mm_s2, both, needs::acceleration, each<acceleration_of<0>>},
    {"acceleration.y", "Acceleration of Y", unit::mm_s2, both, needs::acceleration, each<acceleration_of<1>>},
    {"acceleration.z", "Acceleration of Z", unit::mm_s2, both, needs::acceleration, each<acceleration_of<2>>},
    {"jerk.x", "Jerk of X", unit::mm_s3, both, needs::jerk, each<jerk_of<0>>},
    {"jerk.y", "Jerk of Y", unit::mm_s3, both, needs::jerk, each<jerk_of<1>>},
    {"jerk.z", "Jerk of Z", unit::mm_s3, both, needs::jerk, each<jerk_of<2>>},
    {"position.x", "Position X", unit::mm, up, needs::position, each<position_of<0>>},
    {"position.y", "Position Y", unit::mm, up, needs::position, each<position_of<1>>},
    {"position.z", "Position Z", unit::mm, up, needs::position, each<position_of<2>>},
    {"speed_uncertainty", "Standard deviation of the path speed", unit::mm_min, up,
     needs::velocity | needs::uncertainty, each<uncertainty_of>},
    {"acceleration_uncertainty", "Standard deviation of the acceleration", unit::mm_s2, up,
     needs::acceleration | needs::uncertainty, each<uncertainty_of>},
    {"jerk_uncertainty", "Standard deviation of the jerk", unit::mm_s3, up, needs::jerk | needs::uncertainty,
     each<uncertainty_of>},
    {"orientation_error", "Error of the tool axis", unit::deg, up, needs::error | needs::tool_axis,
     each<orientation_error>},
    {"tool_axis_speed", "Speed of the tool axis", deg_min, up, needs::velocity | needs::tool_axis, each<speed>},
    {"tool_axis.x", "Tool axis X", unit::none, both, needs::position | needs::tool_axis, each<position_of<0>>},
    {"tool_axis.y", "Tool axis Y", unit::none, both, needs::position | needs::tool_axis, each<position_of<1>>},
    {"tool_axis.z", "Tool axis Z", unit::none, both, needs::position | needs::tool_axis, each<position_of<2>>},
    {"speed.a", "Speed of A", deg_min, both, needs::velocity | needs::angle, each<velocity_of<0>>},
    {"speed.b", "Speed of B", deg_min, both, needs::velocity | needs::angle, each<velocity_of<0>>},
    {"speed.c", "Speed of C", deg_min, both, needs::velocity | needs::angle, each<velocity_of<0>>},
    {"acceleration.a", "Acceleration of A", deg_s2, both, needs::acceleration | needs::angle, each<acceleration_of<0>>},
    {"acceleration.b", "Acceleration of B", deg_s2, both, needs::acceleration | needs::angle, each<acceleration_of<0>>},
    {"acceleration.c", "Acceleration of C", deg_s2, both, needs::acceleration | needs::angle, each<acceleration_of<0>>},
});

}  // namespace

std::span<const FieldRow> field_table() { return table; }

const FieldRow* find_field_row(std::string_view name) {
    for (const FieldRow& row : table) {
        if (row.name == name) return &row;
    }
    return nullptr;
}

}  // namespace clsurf
