#pragma once
// The servo loop of an axis, fitted to commanded and feedback positions.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "identify/servo_selection.h"

namespace clsurf {

struct ServoFit {
    ServoParameters parameters;
    std::array<double, servo_terms> standard_error{};  ///< of parameters; infinite: not identifiable
    bool moves = false;                                ///< the axis was commanded to move
    PointIndex records = 0;                            ///< number of compared records
    double quantum = 0;                                ///< step of the feedback positions [unit]; 0: none found
    double noise = 0;               ///< rms change of the residual from record to record, without rounding [unit]
    double residual = 0;            ///< rms [unit]
    double explained = 0;           ///< residual that quantum and noise explain, rms [unit]
    double lag = 0, lag_error = 0;  ///< at constant speed, against the set point of the same record [s]
    std::vector<TermEvidence> evidence;

    [[nodiscard]] double time_constant(double period) const;
    [[nodiscard]] double time_constant_error(double period) const;
    [[nodiscard]] bool knows(ServoTerm term) const;
};

/// Friction, backlash, dead time and the integral of the velocity loop are kept if they lower the information criterion.
/// Standard errors hold for correlated residuals (sums of scores over groups of records). O(records), at most 10^6 of them,
/// evenly spaced.
[[nodiscard]] ServoFit fit_servo(std::span<const AxisRecord> records, double period);

}  // namespace clsurf
