#pragma once
// Servo loops of all axes of the runs, as values of an identification.

#include <span>

#include "identify/identification.h"
#include "log/log.h"

namespace clsurf {

/// Fits the loop of every axis of the runs and puts it into the machine. O(records), parallel.
void identify_servos(std::span<const Log* const> runs, Identification& result);

}  // namespace clsurf
