#pragma once
// Run difference: two runs of a part compared place by place. All values are B minus A, at the points of A,
// weighted by arc length, not by time: a pause is one place.

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "compare/run_alignment.h"
#include "core/units.h"
#include "log/log.h"
#include "surface/cl_surface.h"
#include "toolpath/motion_estimate.h"
#include "toolpath/trajectory.h"

namespace clsurf {

enum class RunQuantity : std::uint8_t {
    speed,            ///< path speed [mm/s]
    acceleration,     ///< its magnitude [mm/s²]
    following_error,  ///< along the feed [mm], + if the measured position trails the commanded one; in reports: lag
    height,           ///< height of B's path above A's path along the surface normal [mm]
    jerk,             ///< root mean square of its magnitude over 50 ms [mm/s³]: roughness of the motion
};
inline constexpr std::size_t run_quantities = 5;
[[nodiscard]] constexpr std::size_t index_of(RunQuantity q) { return static_cast<std::size_t>(q); }

struct RunQuantityInfo {
    RunQuantity quantity;
    std::string_view name, label;
    Unit unit;                     ///< as shown
    std::string_view json_suffix;  ///< "mm_min"
};
/// All of them, in order.
[[nodiscard]] std::span<const RunQuantityInfo> run_quantity_table();

/// One of the runs to compare.
struct ComparedRun {
    const Log* log = nullptr;
    Trajectory path;                                         ///< runs are aligned by it
    std::optional<Trajectory> commanded, measured;           ///< if both are given, following errors are compared
    std::optional<Trajectory> truest;                        ///< heights are compared along it; nullopt: along `path`
    DerivativeMethod derivative = DerivativeMethod::savgol;  ///< of speeds and accelerations
};

struct RunThresholds {
    float speed = 0.03F;         ///< share of the speed at the place …
    float least_speed = 0.25F;   ///< … which counts as at least this share of the usual speed
    float period = 0.25F;        ///< plus the change of speed by the usual acceleration in this fraction of a period
    float acceleration = 0.15F;  ///< share of the usual acceleration
    float height = 0.0015F;      ///< [mm], for following errors and heights …
    float following_error_quanta = 1.5F;  ///< … and at least this many steps of the positions
    float height_quanta = 2.4F;
    float jerk = 0.5F;         ///< share of the jerk of the smoother run at the place …
    float usual_jerk = 0.05F;  ///< … plus this share of the usual jerk, and the effect of the steps of the positions
};

struct RunDifferences {
    RunAlignment alignment;
    std::array<Column<float>, run_quantities>
        of;  ///< per point of A, inside units; NaN: not compared; empty: not known
    std::array<float, run_quantities>
        threshold{};  ///< limits above which a place differs; for speed and jerk at their usual values
    RunThresholds rules;
    float usual_speed = 0;         ///< [mm/s] 95th percentile of A where it cuts
    float usual_acceleration = 0;  ///< [mm/s²] 99th percentile
    float usual_jerk = 0;          ///< [mm/s³] 95th percentile
    float speed_tolerance = 0;     ///< [mm/s] error of a speed by sampling alone
    float jerk_tolerance = 0;      ///< [mm/s³] difference that is not significant
    Column<float> speed_of_a;      ///< [mm/s]
    Column<float> jerk_of_a;       ///< [mm/s³] root mean square

    [[nodiscard]] bool has(RunQuantity q) const { return !of[index_of(q)].empty(); }
    /// The threshold of a quantity at a point.
    [[nodiscard]] float threshold_at(RunQuantity q, PointIndex i) const;
    /// The reference of relative speed differences at a point [mm/s].
    [[nodiscard]] float speed_base(PointIndex i) const;
};

/// `surface`: stitched from A's path. Points of rapids are not compared. Windows of derivatives are those of the run with the
/// longer period; following errors and heights are means over 15 ms. O(points of both).
[[nodiscard]] RunDifferences compare_runs(const ComparedRun& a, const ClSurface& surface, const ComparedRun& b,
                                          const RunThresholds& rules = {});

}  // namespace clsurf
