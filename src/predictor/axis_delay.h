#pragma once
// Axis delay: how far each axis trails its command, and which axes differ enough to make a systematic lag.

#include "predictor/defect.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Fits measured − commanded = −delay · velocity to each axis, by least squares over some 20,000 points of the systematic lag of a
/// report, and gives that defect the delays of the axes that differ. A delay that all axes share moves the tool along its path
/// only. The delays are given where they explain at least half of the variance of the lag; else the cause is another one. Nothing for
/// trajectories with rotary axes: their tips are not those of linear axes.
void explain_systematic_lag(QualityReport& report, const Trajectory& path, const Trajectory& measured,
                            const Signals& signals);

}  // namespace clsurf
