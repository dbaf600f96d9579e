#pragma once
// Kinds: planted logs beyond those of planted_log.h, to evaluate the predictor on data it was not developed with. Each kind
// combines a layout of passes (course.h), a feed with its period and resolution, and the planted faults.
//
// The motion is planned over the whole course: a speed limit by feed and curvature, faults as slower or faster sections,
// then the acceleration of the machine. A fault over several passes follows the closest places from pass to pass.

#include <span>

#include "course.h"
#include "planted_log.h"

namespace clsurf::planted {

/// The planted fault.
enum class Fault : std::uint8_t {
    dip,          ///< a slower section
    rise,         ///< a faster one
    oscillation,  ///< the speed oscillates
    lag,          ///< the measured path deviates from the commanded one, up or down
    offset,       ///< the programmed points are too high or too low
    short_dip,    ///< some 60 ms, at least 0.8 mm
    long_dip,     ///< a third of the pass
    end_dip,      ///< 3 to 8 mm from the end of a pass
    pair,         ///< two of opposite sign, two passes apart
    all,          ///< any except the pair
};

struct LogKind {
    std::string_view name;
    Layout layout;
    double feed;     ///< [mm/min]
    double period;   ///< [s]
    double quantum;  ///< [mm]
    Fault fault;
    double clock = 0;  ///< [s] standard deviation of the recording times, as with a separate computer
};

[[nodiscard]] std::span<const LogKind> log_kinds();

/// A log of a kind; without faults if `clean`. Sizes, surfaces, places and amplitudes depend on the seed.
[[nodiscard]] PlantedLog make_log_of_kind(const LogKind& kind, std::uint64_t seed, bool clean);

}  // namespace clsurf::planted
