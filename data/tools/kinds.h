#pragma once
// Kinds: planted logs beyond those of planted_log.h, to measure the predictor where it was not developed. Each kind joins a
// layout of passes (course.h), a feed with its period and resolution, and the faults that are planted.
//
// The motion is planned over the whole course: a speed limit by feed and curvature, faults as slower or faster sections of
// it, then the acceleration that the machine has. A fault of several passes lies at the place nearest to that on the first.

#include <span>

#include "course.h"
#include "planted_log.h"

namespace clsurf::planted {

/// What is planted.
enum class Fault : std::uint8_t {
    dip,          ///< a slower section
    rise,         ///< a faster one
    oscillation,  ///< the speed swings
    lag,          ///< the measured path leaves the commanded one, up or down
    offset,       ///< the programmed points lie too high or too low
    short_dip,    ///< some 60 ms, at least 0.8 mm
    long_dip,     ///< a third of the pass
    end_dip,      ///< 3 to 8 mm from the end of a pass
    pair,         ///< two of opposite sign, two passes apart
    all,          ///< any but the pair
};

struct LogKind {
    std::string_view name;
    Layout layout;
    double feed;     ///< [mm/min]
    double period;   ///< [s]
    double quantum;  ///< [mm]
    Fault fault;
    double clock = 0;  ///< [s] standard deviation of the time at which a record is taken, as by a second computer
};

[[nodiscard]] std::span<const LogKind> log_kinds();

/// A log of a kind; without faults where `clean`. Sizes, surfaces, places and amplitudes follow the seed.
[[nodiscard]] PlantedLog make_log_of_kind(const LogKind& kind, std::uint64_t seed, bool clean);

}  // namespace clsurf::planted
