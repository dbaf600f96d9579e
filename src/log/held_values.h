#pragma once
// Values of a slow log at the times of a fast one.

#include <vector>

#include "log/log.h"

namespace clsurf {

/// How the times of two logs belong together.
struct HoldRule {
    double offset = 0;  ///< [s] time in the slow log at which the fast one has time 0
    double age = 1;     ///< [s] for which a value is held at most
};

/// For each record of `fast` the last value that `channel` of `slow` had by then, NaN where it had none or the value is
/// older than rule.age. Records without a value and records whose time goes back are passed over.
/// O(fast.records · log(slow.records)), parallel.
[[nodiscard]] std::vector<double> held_values(const Log& slow, const Channel& channel, const Log& fast,
                                              const HoldRule& rule);

}  // namespace clsurf
