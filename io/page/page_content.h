#pragma once
// ReportPage: what the page of `clsurf report` shows.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/defect_match.h"
#include "field/field.h"
#include "field/range.h"
#include "io/page/kept_points.h"
#include "io/reports/quality_report.h"
#include "io/reports/reported_measurement.h"
#include "log/log.h"
#include "mapping/line_map.h"
#include "pipeline/roughness_gauge.h"
#include "pipeline/speed_reasons.h"
#include "surface/cl_surface.h"
#include "surface/path_location.h"
#include "toolpath/trajectory.h"

namespace clsurf::io {

/// A class of a field whose values are names.
struct PageClass {
    std::string name;
    double value = 0;  ///< as shown
    std::array<std::uint8_t, 3> rgb{};
    double share = 0;  ///< of the cutting points
};

/// What one log shows. All that is pointed at must outlive the page.
struct PageSurface {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;
    const ClSurface* surface = nullptr;
    const Trajectory* path = nullptr;     ///< of the role that the surface is of
    std::vector<Trajectory> other_roles;  ///< positions that can be shown in its place
    const KeptPoints* kept = nullptr;
    std::span<const Field> fields;                         ///< one value per point of the log
    std::span<const std::vector<PageClass>> classes = {};  ///< per field; empty: its values are numbers
    std::span<const std::vector<PointRange>> ramps = {};   ///< per field: points in a lighter tone, rising
    std::span<const std::uint8_t> joined;                  ///< per kept point: goes on from the one before
    std::span<const std::uint32_t> triangles;              ///< numbers of kept points
    std::span<const std::uint32_t> segments;
    const SlowWords* slow = nullptr;                   ///< of the kept points
    std::span<const PathLocation> places_before = {};  ///< per point of the log: the same place of the log before
};

/// What became of the defects of the log before.
struct PageChange {
    const QualityReport* before = nullptr;
    DefectMatch match;
    std::optional<RoughnessChange> roughness;  ///< nothing: not known
};

struct PagePicture {
    std::string title, text;
    std::string png;
};

struct PageDefect {
    std::vector<std::vector<Vec3>> outlines;  ///< lines [mm] on the surface of the tool tips
    std::optional<PagePicture> picture;
    Vec3 normal = Vec3::Zero();                            ///< of the surface, there; zero: not known
    std::vector<std::vector<Vec3>> contact_outlines = {};  ///< the same on the part; empty: no tool is known
    std::string slow = {};                                 ///< why the tool is slow there, in words; empty: it is not
};

struct PageColourMap {
    std::string name, summary;
    bool centred = false;
    std::array<std::uint8_t, 3> below{}, above{};  ///< of values outside the range
    std::string rgb;                               ///< evenly spaced colours, three bytes each
};

/// A height map of what the tool leaves standing.
struct PageRelief {
    Vec3 origin = Vec3::Zero();  ///< [mm]
    double pitch = 0;            ///< [mm]
    std::int64_t columns = 0, rows = 0;
    std::span<const float> z;          ///< [mm] over the origin, row by row; NaN: none
    std::span<const float> deviation;  ///< [mm] over the form
    ShownRange range;                  ///< of the deviation [µm]
    std::string note;
};

/// The path as it is programmed: thin lines below those of a log.
struct PageProgrammed {
    std::vector<Vec3> corners;        ///< [mm]
    std::vector<std::uint8_t> begin;  ///< per corner: 1 where no line leads to it from the one before
};

/// A measurement of the part, next to what was predicted.
struct PageMeasured {
    ReportedMeasurement measurement;
    std::optional<PagePicture> picture;  ///< nothing: nothing was compared
};

/// How a field is distributed over the cutting points, in shown units.
struct PagePercentiles {
    std::string field;
    std::vector<double> of_magnitude;  ///< 50th, 90th, 99th, 100th of |value|; NaN: not known
};

struct ReportPage {
    std::string program, log, before;              ///< as they stand on the command line; `before` empty: none
    std::string log_date = {};                     ///< of the log's file, "2026-11-24 09:30 UTC"; empty: not known
    std::vector<std::string> reading_options;      ///< that `render` needs too, to read the same
    std::vector<std::string> as_machined_options;  ///< … and to draw the formed surface
    std::vector<PageSurface> surfaces;             ///< of `log`, then of `before`
    std::vector<ShownRange> ranges;                ///< per field, of all logs
    std::string first_field;                       ///< shown at first
    ReportedQuality quality;
    std::optional<PageMeasured> measured;  ///< where the part was measured
    std::optional<PageChange> change;      ///< where there is a log before
    std::vector<PageDefect> defects;       ///< one per defect of the report
    std::vector<PagePercentiles> percentiles;
    Diagnostics health;  ///< findings on program and log
    std::vector<PagePicture> pictures;
    std::vector<PageColourMap> colour_maps;
    std::vector<std::string> field_maps;  ///< per field, the name of the map that suits it
    std::optional<PageRelief> relief;
    std::optional<PageProgrammed> programmed;  ///< nothing: it is not that of the tool in the workpiece
    std::uint64_t most_bytes = 0;              ///< the limit that the points were chosen for
};

/// Percentiles of PagePercentiles.
inline constexpr double page_percentiles[] = {50, 90, 99, 100};

}  // namespace clsurf::io
