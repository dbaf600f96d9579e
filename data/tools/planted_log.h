#pragma once
// Logs with planted defects of known place, kind and depth, to evaluate a predictor.
//
// A surface is covered with passes (zigzag, one-way, closed loops, a spiral). Every pass gets a speed
// plan and, if a defect is planted on it, a slower section, an oscillating speed, or an offset of
// the measured positions along the surface normal. Commanded and measured positions are sampled at
// the period, with noise and rounding like those of a controller's recorder.

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"
#include "log/log.h"

namespace clsurf::planted {

enum class Shape : std::uint8_t { zigzag, one_way, loops, spiral };
enum class Surface : std::uint8_t { transition, dome, wave };
enum class Kind : std::uint8_t { speed, oscillation, lag, offset };

[[nodiscard]] std::string_view name_of(Shape shape);
[[nodiscard]] std::string_view name_of(Kind kind);

struct Defect {
    Kind kind = Kind::speed;
    int first_pass = 0, last_pass = 0;
    int every = 1;            ///< 2: on every second of these passes
    double from = 0, to = 0;  ///< [mm] along the pass, in the coordinate at its beginning: full amplitude
    double edge = 0.5;        ///< [mm] raised-cosine edges outside
    double amplitude =
        0;              ///< speed, oscillation: share of the speed, + slower; lag, offset of the points: [mm], + above
    double wave = 1.0;  ///< [mm] wavelength of an oscillation
};

struct Recipe {
    std::uint64_t seed = 1;
    Shape shape = Shape::zigzag;
    Surface surface = Surface::transition;
    double height = 4;   ///< [mm] amplitude of the surface
    double width = 3;    ///< [mm] length over which a transition rises; wavelength / 2π of a wave
    double length = 24;  ///< [mm] length of a straight pass; diameter of loops and spirals
    int passes = 30;
    double step_over = 0.3;  ///< [mm]
    double feed = 50;        ///< [mm/s]
    double period = 0.001;   ///< [s]
    double quantum = 0.001;  ///< [mm] resolution of positions
    double noise = 0.0002;   ///< [mm] standard deviation of the measured positions
    double scatter = 0.004;  ///< relative scatter of the speed from pass to pass
    double delay = 0.001;    ///< [s] delay of measured positions after commanded ones
    double give = 2e-5;      ///< [mm per mm/s²] offset along the normal per normal acceleration
    double jitter = 0;       ///< standard deviation of the period
    double block = 0.6;      ///< [mm] programmed step
    std::vector<Defect> defects;
};

struct PlantedLog {
    Recipe recipe;
    std::string program;
    std::vector<double> commanded[3], measured[3];
    std::vector<std::uint32_t> line;
    std::vector<int> pass;                       ///< −1: link
    std::vector<double> speed;                   ///< [mm/s] planned speed; empty: not kept
    std::vector<std::vector<PointIndex>> truth;  ///< points of each defect at half amplitude or more
};

[[nodiscard]] PlantedLog make_planted_log(const Recipe& recipe);

/// A random recipe, with up to four defects far apart; none if `clean`. `hard`: 5 to 10 %,
/// 2 to 3 µm; otherwise 10 to 40 %, 3 to 10 µm.
[[nodiscard]] Recipe random_recipe(std::uint64_t seed, Shape shape, bool clean, bool hard);

/// The log as the project reads it: cmd.*, fb.*, line. Its columns are views of `planted`, which must outlive it.
[[nodiscard]] Log as_log(const PlantedLog& planted);

}  // namespace clsurf::planted
