#pragma once
// The deviation of the commanded motion from the programmed path, compared with the tolerance in force: P of G64, the
// tolerance of a cycle, or the machine's own.

#include <optional>
#include <vector>

#include "mapping/line_map.h"
#include "program/program.h"
#include "toolpath/toolpath.h"
#include "toolpath/trajectory.h"

namespace clsurf {

/// Deviation of a record, and the permitted deviation.
struct PathDeviation {
    double distance = 0;   ///< [mm] NaN: not judged
    double tolerance = 0;  ///< [mm]
};

class PathTolerance {
public:
    /// `own` [mm]: the machine's tolerance, used if the program sets none; nullopt: such motions are not judged. All
    /// references must outlive the object. O(motions + events).
    PathTolerance(const Trajectory& path, const Program& program, const LineMap& lines, PointIndex lead,
                  std::optional<double> own);

    /// Whether any motion has a tolerance.
    [[nodiscard]] bool any() const { return any_; }
    /// The smallest tolerance of any motion [mm]; infinite: none.
    [[nodiscard]] double least() const { return least_; }
    /// Reads the records [first, last]. Rapids and exact stops are not judged. A corner has the tolerance of the motion
    /// that ends in it. O(records).
    [[nodiscard]] std::vector<PathDeviation> read(PointRange records) const;

private:
    struct Nearest {
        std::int64_t motion = -1;
        double distance = 0;
    };
    [[nodiscard]] Nearest nearest(const Vec3& position, std::int64_t first, std::int64_t last) const;
    [[nodiscard]] double tolerance_at(std::int64_t motion) const;
    [[nodiscard]] bool cuts(std::int64_t motion) const;

    const Trajectory* path_;
    const Program* program_;
    const LineMap* lines_;
    PointIndex lead_;
    Toolpath toolpath_;
    std::vector<float> tolerances_;  ///< by motion [mm]; infinite: none
    bool any_ = false;
    double least_;
};

}  // namespace clsurf
