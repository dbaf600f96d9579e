#pragma once
// Survey: the data about a whole log with which its parts can be judged without the rest: passes, neighbours of each
// point, thresholds (docs/design/shards.md).

#include <optional>
#include <string>
#include <vector>

#include "core/block_fill.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "predictor/mismatch.h"
#include "predictor/signals.h"

namespace clsurf {

/// Columns may refer to a mapped file, which `keep_alive` keeps open.
struct Survey {
    PointIndex points = 0;  ///< number of points of the log
    Role role = Role::commanded;
    Vec3 offset = Vec3::Zero();  ///< of the trajectory
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Vec3 origin = Vec3::Zero();                      ///< of the positions
    Column<double> arc_lengths;                      ///< ArcLength::sums()
    std::vector<Eigen::AlignedBox3f> boxes;          ///< ClSurface::boxes
    std::vector<Eigen::AlignedBox3f> surface_boxes;  ///< ClSurface::surface_boxes
    Passes passes;
    std::vector<bool> low_links;  ///< ClSurface::low_links
    std::vector<PointRange> step_over_moves;
    Adjacency neighbours;
    double step_over = 0;
    PointIndex not_finishing = 0;
    double cut_length = 0;           ///< [mm]
    std::vector<PointRange> pieces;  ///< smoothing_segments()
    SignalFacts facts;
    Thresholds thresholds;
    bool lines_of_log = false;         ///< lines are those of the log's channel
    Column<std::uint32_t> lines;       ///< line numbers if lines_of_log is false; empty: only motions
    Column<std::uint32_t> motions;     ///< LineMap::point_motions()
    Column<std::uint8_t> confidences;  ///< LineMap::confidences()
    ProgramMatch match;
    std::shared_ptr<const void> keep_alive;
    std::string file;  ///< the file from which it was read
    /// Checks for a survey from a file, called with a block of points [first, last) before its first use. Throw InputError
    /// if the file is damaged there. Empty if there is nothing to check.
    BlockFill::Fill check_neighbours, check_lines;
};

/// Surveys a part. `wanted`: the positions from which heights are measured, as for signals_of(). Throws UsageError: a
/// machine with rotary axes, or derivatives of a Kalman smoother. O(points), parallel; memory: 25 bytes per point, without
/// the log.
[[nodiscard]] Survey make_survey(const Part& part, std::optional<Role> wanted = std::nullopt);

/// The part from which a survey was made; the survey must outlive it. Reads only the needed data of the log. Throws
/// InputError: the log has another number of records. O(motions).
[[nodiscard]] Part surveyed_part(Program program, Log log, const PartRules& rules, const Survey& survey);

/// The surface of a surveyed part; gathers only the positions that are used. The survey must outlive it. `block`: of
/// gather_when_read(). O(passes).
[[nodiscard]] ClSurface surveyed_surface(const Part& part, const Survey& survey, PointIndex block = block_points);

/// The same for the signals. The surface must outlive them and must not move. O(pieces).
[[nodiscard]] PartSignals surveyed_signals(const Part& part, const ClSurface& surface, const Survey& survey,
                                           std::optional<Role> wanted = std::nullopt);

/// Throws UsageError if the program tilts the tool: contact points of shards assume a tool along z.
void refuse_tilted_tool(const Part& part);

}  // namespace clsurf
