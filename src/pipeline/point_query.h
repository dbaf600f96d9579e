#pragma once
// PointQuery: the data of a point of a part (line, place, speed), and the search for a point by place or time.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "field/position_fields.h"
#include "mapping/call_chain.h"
#include "pipeline/contacts.h"
#include "pipeline/speed_reasons.h"

namespace clsurf {

/// The data of a point.
struct QueryMatch {
    PointIndex point = 0;
    double time = 0;  ///< [s]
    LineNumber line = 0;
    std::string text;  ///< of the line
    CutterPlace place;
    std::optional<std::int64_t> pass;  ///< number of the cut pass, from 1, if it was found by place
    double speed = 0;                  ///< [mm/s]
    double acceleration = 0;           ///< [mm/s²]
    std::optional<double> speed_uncertainty, acceleration_uncertainty;  ///< standard deviations, if known
    std::string estimated_from;  ///< what speed and acceleration are estimated from; empty: positions in a window
    /// Position of the table from scale and encoder, with the standard deviation of each coordinate [mm].
    struct FusedPosition {
        Vec3 position, uncertainty;
    };
    std::optional<FusedPosition> fused;
    SpeedReasons why;        ///< if the tool is slower than programmed
    double confidence = 0;   ///< 0 … 1
    double distance = 0;     ///< [mm] to the requested position; 0 if there is none
    CallChain calls;         ///< for a point in a subprogram
    PointRange line_points;  ///< the run of points of this line that contains the point
};

/// Not movable.
class PointQuery {
public:
    /// `part` must outlive the object. The CL surface is made if `needs_surface` is set, and if the tool is known.
    /// O(points).
    PointQuery(const Part& part, bool needs_surface);
    PointQuery(const PointQuery&) = delete;
    PointQuery& operator=(const PointQuery&) = delete;

    [[nodiscard]] const Part& part() const { return part_; }
    /// [mm]; 0: not known, or no surface was made.
    [[nodiscard]] double step_over() const { return surface_ ? surface_->step_over : 0; }
    /// Domain: a point of the log. O(points of its line).
    [[nodiscard]] QueryMatch match(PointIndex point) const;
    /// The nearest point of each of the nearest passes, or of each of the nearest lines if there is only one pass. Uses
    /// contact points if the tool is known and WantedPlace::of_tip is not set. Needs the surface.
    [[nodiscard]] std::vector<FoundPlace> find_nearest(const WantedPlace& wanted) const;
    /// Whether places on the part are contact points and therefore differ from the places of the tool tip.
    [[nodiscard]] bool knows_contacts() const { return contacts_ && contacts_->known(); }
    /// Whether a place is off the part, from its distance [mm] to the nearest point found. Needs the surface.
    [[nodiscard]] bool is_off_the_part(double distance) const;
    /// The runs of points of a line, in a file of the program; file 0 is the program itself.
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

/// The point whose record is nearest to a time [s]. Outside the log's points if the log is shorter and has no channel
/// `time`. O(log points).
[[nodiscard]] PointIndex point_at_time(const Log& log, double time);

}  // namespace clsurf
