#include "field/field_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry.h"

namespace clsurf {
namespace {

constexpr double slowest_for_direction = 0.1;  ///< [mm/s]; slower, the feed has no direction

using Vector = FieldBlock::Vector;

double norm(const Vector& v, std::size_t i) {
    return std::sqrt(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
}

double tangential(const Vector& velocity, const Vector& acceleration, std::size_t i) {
    const double v = norm(velocity, i);
    if (!(v > slowest_for_direction)) return std::numeric_limits<double>::quiet_NaN();
    return (acceleration[0][i] * velocity[0][i] + acceleration[1][i] * velocity[1][i] +
            acceleration[2][i] * velocity[2][i]) /
           v;
}

/// |v × a|.
double cross_norm(const Vector& v, const Vector& a, std::size_t i) {
    const auto part = [&](std::size_t k, std::size_t l) { return v[k][i] * a[l][i] - v[l][i] * a[k][i]; };
    const double x = part(1, 2);
    const double y = part(2, 0);
    const double z = part(0, 1);
    return std::sqrt(x * x + y * y + z * z);
}
double normal(const Vector& velocity, const Vector& acceleration, std::size_t i) {
    const double v = norm(velocity, i);
    return v > slowest_for_direction ? cross_norm(velocity, acceleration, i) / v
                                     : std::numeric_limits<double>::quiet_NaN();
}

double following_error(const Vector& commanded, const Vector& measured, std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double d = measured[k][i] - commanded[k][i];
        sum += d * d;
    }
    return std::sqrt(sum);
}

void error_component(const FieldBlock& block, float* out) {
    const double* const measured = block.component(needs::measured);
    const double* const commanded = block.component(needs::commanded);
    for (std::size_t i = 0; i < block.count(); ++i) out[i] = static_cast<float>(measured[i] - commanded[i]);
}

/// Angle between commanded and measured tool axis; atan2 keeps it accurate near 0.
double orientation_error(const Vector& commanded, const Vector& measured, std::size_t i) {
    return angle_between(Vec3(commanded[0][i], commanded[1][i], commanded[2][i]),
                         Vec3(measured[0][i], measured[1][i], measured[2][i]));
}

/// Squared distance of the measured point i to the commanded path from point k to k + 1.
double squared_to_step(const Vector& commanded, const Vector& measured, std::size_t i, std::ptrdiff_t k) {
    double step2 = 0;
    double dot = 0;
    double far2 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double step = commanded[axis][k + 1] - commanded[axis][k];
        const double to = measured[axis][i] - commanded[axis][k];
        step2 += step * step;
        dot += step * to;
        far2 += to * to;
    }
    if (!(step2 > 0)) return far2;
    const double t = std::fmin(1.0, std::fmax(0.0, dot / step2));
    return std::fmax(0.0, far2 - 2 * t * dot + t * t * step2);
}

/// Distance of the measured point from the commanded path around it. The projection is followed from point to point; it lags
/// behind the command.
void contour_error(const FieldBlock& block, float* out) {
    constexpr std::ptrdiff_t farthest_start = FieldBlock::commanded_before - 6;  // a few more steps can be searched
    const Vector& commanded = block.vector(needs::commanded);
    const Vector& measured = block.vector(needs::measured);
    std::ptrdiff_t projection = -1;  // the step before the same time: the position of a lagging axis
    for (std::size_t i = 0; i < block.count(); ++i) {
        const auto here = static_cast<std::ptrdiff_t>(i);
        projection = std::max<std::ptrdiff_t>(std::min(projection + 1, here), here - farthest_start);
        double best = squared_to_step(commanded, measured, i, projection);
        for (const int direction : {-1, 1}) {
            for (std::ptrdiff_t k = projection + direction;
                 k > here - FieldBlock::commanded_before && k < here + FieldBlock::commanded_after; k += direction) {
                const double next = squared_to_step(commanded, measured, i, k);
                if (!(next <= best)) break;
                best = next;
                projection = k;
            }
        }
        out[i] = static_cast<float>(std::sqrt(best));
    }
}

constexpr Unit deg_min{"deg/min", (deg_per_rad * seconds_per_minute)};
constexpr Unit deg_s2{"deg/s²", deg_per_rad};
constexpr FieldScale up = FieldScale::sequential;
constexpr FieldScale both = FieldScale::diverging;
constexpr FieldSubject tip = FieldSubject::tip;
constexpr int of_axes = 100;  ///< rank in reports: after the fields of the path
constexpr FieldSubject tool_axis = FieldSubject::tool_axis;
constexpr FieldSubject rotary_axis = FieldSubject::rotary_axis;

/// Small values are good.
constexpr FieldRow lower(FieldRow row) {
    row.preference = FieldPreference::lower;
    return row;
}

/// A speed: fast is good, and its colours span at least a tenth of the median.
constexpr FieldRow faster(FieldRow row) {
    row.preference = FieldPreference::higher;
    row.least_span_of_median = 0.1;
    return row;
}

constexpr auto table = std::to_array<FieldRow>({
    // name, label, unit, colours, axis, subject, needs, kernel, synonyms, rank in reports, percentiles there
    faster({"speed",
            "Path speed",
            unit::mm_min,
            up,
            0,
            tip,
            needs::velocity,
            kernel::each<norm, needs::velocity>,
            {"velocity", "feedrate"},
            2}),
    lower({"acceleration",
           "Acceleration",
           unit::mm_s2,
           up,
           0,
           tip,
           needs::acceleration,
           kernel::each<norm, needs::acceleration>,
           {"accel"},
           2}),
    lower({"jerk", "Jerk", unit::mm_s3, up, 0, tip, needs::jerk, kernel::each<norm, needs::jerk>, {}, 4}),
    {"tangential_acceleration",
     "Acceleration along the path",
     unit::mm_s2,
     both,
     0,
     tip,
     needs::velocity | needs::acceleration,
     kernel::each<tangential, needs::velocity, needs::acceleration>,
     {},
     3},
    lower({"normal_acceleration", "Acceleration across the path", unit::mm_s2, up, 0, tip,
           needs::velocity | needs::acceleration, kernel::each<normal, needs::velocity, needs::acceleration>}),
    {"curvature", "Curvature of the path", unit::per_mm, up, 0, tip, needs::curvature,
     kernel::scalar<needs::curvature>},
    lower({"following_error",
           "Following error",
           unit::um,
           up,
           0,
           tip,
           needs::error,
           kernel::each<following_error, needs::commanded, needs::measured>,
           {"lag"},
           5}),
    lower({"contour_error", "Contour error", unit::um, up, 0, tip, needs::error, contour_error, {"error"}, 6, true}),
    {"following_error.x", "Following error of X", unit::um, both, 'x', tip, needs::error, error_component},
    {"following_error.y", "Following error of Y", unit::um, both, 'y', tip, needs::error, error_component},
    {"following_error.z", "Following error of Z", unit::um, both, 'z', tip, needs::error, error_component},
    {"speed.x",
     "Speed of X",
     unit::mm_min,
     both,
     'x',
     tip,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"speed.y",
     "Speed of Y",
     unit::mm_min,
     both,
     'y',
     tip,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"speed.z",
     "Speed of Z",
     unit::mm_min,
     both,
     'z',
     tip,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"acceleration.x",
     "Acceleration of X",
     unit::mm_s2,
     both,
     'x',
     tip,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"acceleration.y",
     "Acceleration of Y",
     unit::mm_s2,
     both,
     'y',
     tip,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"acceleration.z",
     "Acceleration of Z",
     unit::mm_s2,
     both,
     'z',
     tip,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"jerk.x", "Jerk of X", unit::mm_s3, both, 'x', tip, needs::jerk, kernel::component<needs::jerk>},
    {"jerk.y", "Jerk of Y", unit::mm_s3, both, 'y', tip, needs::jerk, kernel::component<needs::jerk>},
    {"jerk.z", "Jerk of Z", unit::mm_s3, both, 'z', tip, needs::jerk, kernel::component<needs::jerk>},
    {"position.x", "Position X", unit::mm, up, 'x', tip, needs::position, kernel::component<needs::position>},
    {"position.y", "Position Y", unit::mm, up, 'y', tip, needs::position, kernel::component<needs::position>},
    {"position.z", "Position Z", unit::mm, up, 'z', tip, needs::position, kernel::component<needs::position>},
    lower({"position_uncertainty.x", "Standard deviation of position X", unit::um, up, 'x', tip, needs::position_sigma,
           kernel::component<needs::position_sigma>}),
    lower({"position_uncertainty.y", "Standard deviation of position Y", unit::um, up, 'y', tip, needs::position_sigma,
           kernel::component<needs::position_sigma>}),
    lower({"position_uncertainty.z", "Standard deviation of position Z", unit::um, up, 'z', tip, needs::position_sigma,
           kernel::component<needs::position_sigma>}),
    lower({"speed_uncertainty", "Standard deviation of the path speed", unit::mm_min, up, 0, tip, needs::velocity_sigma,
           kernel::scalar<needs::velocity_sigma>}),
    lower({"acceleration_uncertainty", "Standard deviation of the acceleration", unit::mm_s2, up, 0, tip,
           needs::acceleration_sigma, kernel::scalar<needs::acceleration_sigma>}),
    lower({"jerk_uncertainty", "Standard deviation of the jerk", unit::mm_s3, up, 0, tip, needs::jerk_sigma,
           kernel::scalar<needs::jerk_sigma>}),
    lower({"orientation_error", "Error of the tool axis", unit::deg, up, 0, tool_axis, needs::error,
           kernel::each<orientation_error, needs::commanded, needs::measured>}),
    lower({"tool_axis_speed", "Speed of the tool axis", deg_min, up, 0, tool_axis, needs::velocity,
           kernel::each<norm, needs::velocity>}),
    {"tool_axis.x", "Tool axis X", unit::none, both, 'x', tool_axis, needs::position,
     kernel::component<needs::position>},
    {"tool_axis.y", "Tool axis Y", unit::none, both, 'y', tool_axis, needs::position,
     kernel::component<needs::position>},
    {"tool_axis.z", "Tool axis Z", unit::none, both, 'z', tool_axis, needs::position,
     kernel::component<needs::position>},
    {"speed.a",
     "Speed of A",
     deg_min,
     both,
     'a',
     rotary_axis,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"speed.b",
     "Speed of B",
     deg_min,
     both,
     'b',
     rotary_axis,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"speed.c",
     "Speed of C",
     deg_min,
     both,
     'c',
     rotary_axis,
     needs::velocity,
     kernel::component<needs::velocity>,
     {},
     of_axes},
    {"acceleration.a",
     "Acceleration of A",
     deg_s2,
     both,
     'a',
     rotary_axis,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"acceleration.b",
     "Acceleration of B",
     deg_s2,
     both,
     'b',
     rotary_axis,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"acceleration.c",
     "Acceleration of C",
     deg_s2,
     both,
     'c',
     rotary_axis,
     needs::acceleration,
     kernel::component<needs::acceleration>,
     {},
     of_axes},
    {"time", "Time", unit::s, up, 0, tip, needs::time, kernel::scalar<needs::time>},
});

}  // namespace

std::span<const FieldRow> field_table() { return table; }

}  // namespace clsurf
