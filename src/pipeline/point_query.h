#pragma once
// PointQuery: what a part knows of a point: its line, its place, its speed; and which point lies at a place or a time.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "field/position_fields.h"
#include "mapping/call_chain.h"
#include "pipeline/contacts.h"
#include "pipeline/speed_reasons.h"

namespace clsurf {

/// What is known of a point.
struct QueryMatch {
    PointIndex point = 0;
    double time = 0;  ///< [s]
    LineNumber line = 0;
    std::string text;  ///< of the line
    CutterPlace place;
    std::optional<std::int64_t> pass;  ///< number of the cut pass, from 1, where it was found by place
    double speed = 0;                  ///< [mm/s]
    double acceleration = 0;           ///< [mm/s²]
    std::optional<double> speed_uncertainty, acceleration_uncertainty;  ///< standard deviations, where known
    std::string estimated_from;  ///< what speed and acceleration are estimated from; empty: positions in a window
    /// Where the table was, by scale and encoder together, with the standard deviation of each coordinate [mm].
    struct FusedPosition {
        Vec3 position, uncertainty;
    };
    std::optional<FusedPosition> fused;
    SpeedReasons why;        ///< the tool is slower than programmed
    double confidence = 0;   ///< 0 … 1
    double distance = 0;     ///< [mm] to the asked position; 0 where none was asked
    CallChain calls;         ///< of a point in a subprogram
    PointRange line_points;  ///< the run of points of this line round the point
};

/// Does not move once it is made.
class PointQuery {
public:
    /// `part` must outlive it. The CL surface is made where `needs_surface` says so, and where the tool is known.
    /// O(points).
    PointQuery(const Part& part, bool needs_surface);
    PointQuery(const PointQuery&) = delete;
    PointQuery& operator=(const PointQuery&) = delete;

    [[nodiscard]] const Part& part() const { return part_; }
    /// [mm]; 0: not known, or no surface was made.
    [[nodiscard]] double step_over() const { return surface_ ? surface_->step_over : 0; }
    /// Domain: a point of the log. O(points of its line).
    [[nodiscard]] QueryMatch match(PointIndex point) const;
    /// The nearest point of each of the nearest passes, or of each of the nearest lines where there is one pass only. By
    /// contact points where the tool is known and WantedPlace::of_tip does not ask for tips. Needs the surface.
    [[nodiscard]] std::vector<FoundPlace> find_nearest(const WantedPlace& wanted) const;
    /// Whether places on the part are contact points, so that those of the tool tip are others.
    [[nodiscard]] bool knows_contacts() const { return contacts_ && contacts_->known(); }
    /// Whether a place so far [mm] from the nearest one that was found does not lie on the part. Needs the surface.
    [[nodiscard]] bool is_off_the_part(double distance) const;
    /// The runs of points of a line: of the program's own file 0, or of another of its files.
    [[nodiscard]] std::vector<PointRange> points_of_line(std::size_t file, LineNumber line) const;

private:
    [[nodiscard]] CutterPlace place(PointIndex point) const;
    void add_motion(QueryMatch& match) const;

    const Part& part_;
    CallChains chains_;
    bool estimated_ = false;  ///< fields have standard deviations
    bool fused_ = false;      ///< positions are those of scale and encoder together
    std::optional<PositionFields> fields_;
    std::optional<ClSurface> surface_;
    std::unique_ptr<const PartContacts> contacts_;
};

/// The point whose record is nearest to a time [s]; out of the log's points where the log does not last so long and has no
/// channel `time`. O(log points).
[[nodiscard]] PointIndex point_at_time(const Log& log, double time);

}  // namespace clsurf
