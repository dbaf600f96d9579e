#pragma once
// Survey: what is known of a long log as a whole, so that parts of it can be judged without reading the rest: passes,
// the neighbours of each point, thresholds (docs/design/shards.md).

#include <optional>
#include <string>
#include <vector>

#include "core/block_fill.h"
#include "pipeline/part.h"
#include "pipeline/signals_of.h"
#include "predictor/mismatch.h"
#include "predictor/signals.h"

namespace clsurf {

/// Columns may be borrowed from a mapped file, which `keep_alive` holds.
struct Survey {
    PointIndex points = 0;  ///< of the log
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
    bool lines_of_log = false;         ///< they are those of the log's channel
    Column<std::uint32_t> lines;       ///< else the numbers that stand for it; empty: there are only motions
    Column<std::uint32_t> motions;     ///< LineMap::point_motions()
    Column<std::uint8_t> confidences;  ///< LineMap::confidences()
    ProgramMatch match;
    std::shared_ptr<const void> keep_alive;
    std::string file;  ///< the file that it was read from
    /// Checks for a survey from a file, called with a block of points [first, last) when it is first read. Throw InputError if
    /// the file is damaged there. Empty if there is nothing to check.
    BlockFill::Fill check_neighbours, check_lines;
};

/// Surveys a part. `wanted`: the positions that heights are measured from, as signals_of() takes it. Throws UsageError:
/// a machine with rotary axes, derivatives of a Kalman smoother. O(points), parallel; 25 bytes a point, besides the log.
[[nodiscard]] Survey make_survey(const Part& part, std::optional<Role> wanted = std::nullopt);

/// The part that a survey was made of, which must outlive it. Of the log only what is needed later is read. Throws InputError: the log has not
/// as many records. O(motions).
[[nodiscard]] Part surveyed_part(Program program, Log log, const PartRules& rules, const Survey& survey);

/// The surface of a part that was surveyed: of its positions those are gathered that are looked at. The survey must
/// outlive it. `block`: of gather_when_read(). O(passes).
[[nodiscard]] ClSurface surveyed_surface(const Part& part, const Survey& survey, PointIndex block = block_points);

/// The same for the signals. The surface must outlive them, and stay where it is. O(pieces).
[[nodiscard]] PartSignals surveyed_signals(const Part& part, const ClSurface& surface, const Survey& survey,
                                           std::optional<Role> wanted = std::nullopt);

/// Throws UsageError where the tool of a part is tilted by its program: contact points of shards are those of a tool along z.
void refuse_tilted_tool(const Part& part);

}  // namespace clsurf
