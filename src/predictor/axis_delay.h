#pragma once
// Axis delay: how far each axis trails its command, and which axes differ enough to cause a systematic lag.

#include "predictor/defect.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Fits measured − commanded = −delay · velocity to each axis by least squares, over some 20,000 points of the systematic lag
/// of a report. Stores in that defect the delays of the axes that differ. A delay that all axes share only moves the tool along
/// its path. No delays are stored if they explain less than half of the variance of the lag, which then has another cause, or
/// if the trajectory has rotary axes, because its tips are then not the positions of the linear axes.
void explain_systematic_lag(QualityReport& report, const Trajectory& path, const Trajectory& measured,
                            const Signals& signals);

}  // namespace clsurf
