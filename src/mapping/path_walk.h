#pragma once
// PathWalk: follows a tool along the programmed path, forward only, from one logged point to the next.

#include <cstdint>

#include "core/column.h"
#include "mapping/walk_window.h"
#include "toolpath/toolpath.h"

namespace clsurf {

/// The state of a walk on the path.
struct WalkState {
    std::int64_t motion = 0;
    double fraction = 0;  ///< of the motion's length, 0 … 1
    double distance = 0;  ///< [mm] from the point to the path there
};

class PathWalk {
public:
    /// `path` must outlive it. O(motions).
    explicit PathWalk(const Toolpath& path);

    /// The projection of `p` at or after `from`, on no motion beyond `last`, for a tool that moved by `chord` [mm].
    [[nodiscard]] WalkState advance(const WalkState& from, const Vec3& p, double chord, std::int64_t last) const;
    /// As above, to the end of the program.
    [[nodiscard]] WalkState advance(const WalkState& from, const Vec3& p, double chord) const {
        return advance(from, p, chord, path_.size() - 1);
    }

    /// [mm] A walk that is farther from the path is lost.
    static constexpr double lost_distance = WalkWindow<double>::lost_distance;

private:
    [[nodiscard]] double length(std::int64_t m) const { return length_[static_cast<std::size_t>(m)]; }

    const Toolpath& path_;
    Column<double> length_;
};

}  // namespace clsurf
