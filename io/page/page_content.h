#pragma once
// ReportPage: the content of the page of `clsurf report`.

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

/// A class of a field whose values have names.
struct PageClass {
    std::string name;
    double value = 0;  ///< as shown
    std::array<std::uint8_t, 3> rgb{};
    double share = 0;  ///< share of the cutting points
};

/// The view of one log. Everything that it points to must outlive the page.
struct PageSurface {
    const Log* log = nullptr;
    const LineMap* lines = nullptr;
    const ClSurface* surface = nullptr;
    const Trajectory* path = nullptr;     ///< positions of the role of the surface
    std::vector<Trajectory> other_roles;  ///< positions of other roles that can be shown instead
    const KeptPoints* kept = nullptr;
    std::span<const Field> fields;                         ///< one value per point of the log
    std::span<const std::vector<PageClass>> classes = {};  ///< per field; empty: its values are numbers
    std::span<const std::vector<PointRange>> ramps = {};   ///< per field: points in a lighter tone, increasing
    std::span<const std::uint8_t> joined;                  ///< per kept point: connected to the previous one
    std::span<const std::uint32_t> triangles;              ///< indices of kept points
    std::span<const std::uint32_t> segments;
    const SlowWords* slow = nullptr;                   ///< reasons why the tool is slow, for the kept points
    std::span<const PathLocation> places_before = {};  ///< per point of the log: the same location in the earlier log
};

/// What changed in the defects since the earlier log.
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
    Vec3 normal = Vec3::Zero();                            ///< surface normal at this place; zero: not known
    std::vector<std::vector<Vec3>> contact_outlines = {};  ///< the same on the part; empty: the tool is not known
    std::string slow = {};                                 ///< why the tool is slow there; empty: it is not slow
};

struct PageColourMap {
    std::string name, summary;
    bool centred = false;
    std::array<std::uint8_t, 3> below{}, above{};  ///< colours of values outside the range
    std::string rgb;                               ///< evenly spaced colours, three bytes each
};

/// A height map of the as-machined surface.
struct PageHeightMap {
    Vec3 origin = Vec3::Zero();  ///< [mm]
    double pitch = 0;            ///< [mm]
    std::int64_t columns = 0, rows = 0;
    std::span<const float> z;          ///< heights [mm] above the origin, row by row; NaN: none
    std::span<const float> deviation;  ///< heights [mm] above the form
    ShownRange range;                  ///< range of the deviation [µm]
    std::string note;
};

/// The programmed path: thin lines below those of a log.
struct PageProgrammed {
    std::vector<Vec3> corners;        ///< [mm]
    std::vector<std::uint8_t> begin;  ///< per corner: 1 if no line leads to it from the previous one
};

/// A measurement of the part, next to the prediction.
struct PageMeasured {
    ReportedMeasurement measurement;
    std::optional<PagePicture> picture;  ///< nothing: nothing was compared
};

/// The distribution of a field over the cutting points, in shown units.
struct PagePercentiles {
    std::string field;
    std::vector<double> of_magnitude;  ///< 50th, 90th, 99th, 100th of |value|; NaN: not known
};

struct ReportPage {
    std::string program, log, before;              ///< as given on the command line; `before` empty: none
    std::string log_date = {};                     ///< time of the log's file, "2026-11-24 09:30 UTC"; empty: not known
    std::vector<std::string> reading_options;      ///< options that `render` needs to read the same
    std::vector<std::string> as_machined_options;  ///< … and to draw the as-machined surface
    std::vector<PageSurface> surfaces;             ///< surface of `log`, then of `before`
    std::vector<ShownRange> ranges;                ///< per field, of all logs
    std::string first_field;                       ///< shown at first
    ReportedQuality quality;
    std::optional<PageMeasured> measured;  ///< if the part was measured
    std::optional<PageChange> change;      ///< if there is an earlier log
    std::vector<PageDefect> defects;       ///< one per defect of the report
    std::vector<PagePercentiles> percentiles;
    Diagnostics health;  ///< findings on program and log
    std::vector<PagePicture> pictures;
    std::vector<PageColourMap> colour_maps;
    std::vector<std::string> field_maps;  ///< per field, the name of its colour map
    std::optional<PageHeightMap> height_map;
    std::optional<PageProgrammed> programmed;  ///< nothing: not the path of the tool in the workpiece
    std::uint64_t most_bytes = 0;              ///< the size limit for which the points were chosen
};

/// Percentiles of PagePercentiles.
inline constexpr double page_percentiles[] = {50, 90, 99, 100};

}  // namespace clsurf::io
