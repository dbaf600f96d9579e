#pragma once
// Look-ahead: speeds at the nodes between blocks, and the planning of a window of spans as runs.
//
// The scan goes backward and forward once. With a jerk limit it uses the length of a ramp instead of v² = 2aL, which would
// give blocks that no jerk-limited profile can run. Zero acceleration at every node would waste time in short blocks, so
// spans are joined to *runs*, each planned as one seven-phase profile. The profile of a run is checked against the limits
// of every span in it, at the speed and acceleration there. If a limit is exceeded, the run gets lower tangential limits or
// is divided at the worst span. A single span never exceeds its limits: the scan guarantees it. For each window, several
// shares of the limits are tried for ramps on bends, and the fastest plan is used.

#include <limits>
#include <span>
#include <vector>

#include "simulation/path/path_stream.h"
#include "simulation/plan/derating.h"
#include "simulation/plan/scurve.h"

namespace clsurf {

/// The path between two nodes, as input of the scan.
struct ScanSegment {
    double length = 0, acceleration = 0, jerk = 0;
};

/// Lowers node speeds until every segment can be run. Node i is before segment i. On entry `speeds` holds the limit of each
/// node, and the present speed as the first value. False: the path is too short to brake from the present speed.
/// O(segments).
[[nodiscard]] bool scan_speeds(std::span<const ScanSegment> segments, std::span<double> speeds);

/// Spans [first, last) of a window run as one profile.
struct SpeedRun {
    std::size_t first = 0, last = 0;
    bool derated = false;  ///< uses the tangential limits that its most bent span leaves
    double length = 0, acceleration = 0, jerk = 0, speed = 0;
    double start_speed = 0, end_speed = 0;
    bool checked = false;  ///< the profile belongs to these speeds and satisfies the limits
    SCurve profile;
};

class WindowPlanner {
public:
    /// `refined`: the plan is the start of a refinement. Then deratings are not compared. The one that leaves least to
    /// ramps is used, because its steady speeds are nearest to the refined speeds.
    WindowPlanner(const Machine& machine, bool refined) : machine_(&machine), refined_(refined) {}

    /// Plans spans from a speed to rest at their end. `nodes`: span numbers at which a node is required. False: with these
    /// nodes the path is too short to brake from the start speed. The runs remain valid until the next call.
    [[nodiscard]] bool plan(std::span<const Span> spans, double start_speed, std::span<const std::size_t> nodes);
    [[nodiscard]] const std::vector<SpeedRun>& runs() const { return best_; }

private:
    struct Verdict {
        double worst = 0;      ///< greatest share of a limit; 1: exactly at the limit
        bool at_cap = false;   ///< the limit is exceeded by the speed alone, without acceleration
        std::size_t span = 0;  ///< number of the span with the worst share
    };
    [[nodiscard]] bool plan_with(std::size_t derating, std::span<const Span> spans, double start_speed,
                                 std::span<const std::size_t> nodes);
    [[nodiscard]] const Derating& derated(std::span<const Span> spans, std::size_t span);
    /// The first runs: one between each two nodes.
    void cut(std::span<const Span> spans, std::span<const std::size_t> nodes);
    void set_limits(SpeedRun& run, std::span<const Span> spans);
    [[nodiscard]] double part_of_limits(const Span& span, double speed, double acceleration, double jerk) const;
    [[nodiscard]] Verdict judge(const SpeedRun& run, std::span<const Span> spans) const;
    void divide(const SpeedRun& run, const Verdict& verdict, std::vector<SpeedRun>& into) const;

    const Machine* machine_;
    bool refined_;
    std::size_t derating_ = 0;  ///< in force in plan_with()
    std::vector<Derating>
        derated_;  ///< of the spans, for the derating in force, computed when needed; a cap below 0: not computed
    std::vector<SpeedRun> runs_, next_, best_;
    std::vector<ScanSegment> segments_;
    std::vector<double> speeds_;
};

}  // namespace clsurf
