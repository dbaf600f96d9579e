#pragma once
// OptimizeRules: the permitted differences of a repaired program.

#include <optional>
#include <string>

#include "core/geometry.h"
#include "core/units.h"
#include "machined/tool.h"
#include "mapping/program_match.h"
#include "toolpath/motion_estimate.h"

namespace clsurf {

/// Largest angle between the new and the programmed tool axis: a hundredth of a degree moves the centre of a ball of 6
/// mm radius by 1 µm.
inline constexpr double most_turned = 0.01 * rad_per_deg;

/// Which feeds a new program gets.
enum class FeedChoice : unsigned char {
    searched,   ///< feeds that make adjacent passes equal, as far as the time allows
    intervals,  ///< the speeds of its constant-speed intervals (Wu et al. 2022)
};

struct OptimizeRules {
    FeedChoice feeds = FeedChoice::searched;
    bool splines = false;       ///< sections are written as splines if the dialect has them; three axes
    double tolerance = 0.005;   ///< [mm] from the programmed path
    double more_time = 0;       ///< permitted additional time of the new program, as a share
    int least_decimals = 0;     ///< of new coordinates; 0: as many as the program has
    Vec3 start = Vec3::Zero();  ///< [mm] where the axes stand before the program
    Vec3 zero = Vec3::Zero();   ///< [mm] machine position of its zero, on five axes
    DerivativeMethod derivative = DerivativeMethod::savgol;  ///< of the runs that are judged
    std::optional<CuttingTool> tool;                         ///< tool whose surface must not get rougher; three axes
    int machines = 4;                ///< of the ensemble that must be better; 0: the nominal machine alone decides
    bool keeps_front = false;        ///< all candidates that pass are compared by time, mismatch and jerk
    std::optional<double> weight{};  ///< selects one of them (tradeoff/front.h); nullopt: the objective selects
    [[nodiscard]] bool needs_front() const { return keeps_front || weight.has_value(); }
    bool all_finalists = false;  ///< lists all, instead of only the best that the ensemble accepts
    ProgramIdentity identity = ProgramIdentity::unknown;  ///< of the program that a recorded run ran
    std::string header;                                   ///< text of the comment that states the origin of the program
};

}  // namespace clsurf
