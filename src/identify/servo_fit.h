#pragma once
// The servo loop of an axis, fitted to commanded and fed-back positions.

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
    PointIndex records = 0;                            ///< that the fit compares
    double quantum = 0;                                ///< step of the fed-back positions [unit]; 0: none found
    double noise = 0;               ///< rms of the residual from record to record, beyond rounding [unit]
    double residual = 0;            ///< rms [unit]
    double explained = 0;           ///< what quantum and noise make of it, rms [unit]
    double lag = 0, lag_error = 0;  ///< at constant speed, of the set point of the same record [s]
    std::vector<TermEvidence> evidence;

    [[nodiscard]] double time_constant(double period) const;
    [[nodiscard]] double time_constant_error(double period) const;
    [[nodiscard]] bool knows(ServoTerm term) const;
};

/// Friction, backlash, dead time and the integral of the velocity loop are kept where the information criterion falls with
/// them. Standard errors hold for correlated residuals (sums of scores over groups of
/// records). O(records), at most 10^6 of them, evenly spaced.
[[nodiscard]] ServoFit fit_servo(std::span<const AxisRecord> records, double period);

}  // namespace clsurf
