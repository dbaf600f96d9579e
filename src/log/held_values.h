#pragma once
// Values of a slow log at the times of a fast one.

#include <vector>

#include "log/log.h"

namespace clsurf {

/// How the time bases of two logs are related.
struct HoldRule {
    double offset = 0;  ///< [s] time in the slow log at which the fast one has time 0
    double age = 1;     ///< [s] longest time for which a value is held
};

/// For each record of `fast`, the latest value of `channel` of `slow`; NaN if there is none yet or it is older than
/// rule.age. Records without a value and records whose time goes back are skipped. O(fast.records · log(slow.records)),
/// parallel.
[[nodiscard]] std::vector<double> held_values(const Log& slow, const Channel& channel, const Log& fast,
                                              const HoldRule& rule);

}  // namespace clsurf
