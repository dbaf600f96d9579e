#pragma once
// Look-ahead: speeds at the nodes between blocks, and the planning of a window of spans as runs.
//
// The scan goes backward and forward once. With a jerk limit it uses the reach of a ramp instead of v² = 2aL,
// which would give blocks that no jerk-limited profile can run. Zero acceleration at every node would waste
// time in short blocks, so spans are joined to *runs*, each planned as one seven-phase profile. The profile of
// a run is checked against the limits of every span in it, at its speed and acceleration there. If one is
// exceeded, the run gets lower tangential limits or is divided at the worst span. A single span never exceeds
// its limits: the scan guarantees it. Several shares of the limits for ramps through bends are tried for each
// window, and the fastest plan is used.

#include <limits>
#include <span>
#include <vector>

#include "simulation/path/path_stream.h"
#include "simulation/plan/derating.h"
#include "simulation/plan/scurve.h"

namespace clsurf {

/// The path between two nodes, for the scan.
struct ScanSegment {
    double length = 0, acceleration = 0, jerk = 0;
};

/// Lowers node speeds to what can be run: node i lies before segment i. On entry `speeds` holds the
/// limit of each node, the first one the present speed. False: the present speed is too high to
/// brake from. O(segments).
[[nodiscard]] bool scan_speeds(std::span<const ScanSegment> segments, std::span<double> speeds);

/// Spans [first, last) of a window run as one profile.
struct SpeedRun {
    std::size_t first = 0, last = 0;
    bool derated = false;  ///< with the tangential limits that its most bent span leaves
    double length = 0, acceleration = 0, jerk = 0, speed = 0;
    double start_speed = 0, end_speed = 0;
    bool checked = false;  ///< profile belongs to these speeds and holds
    SCurve profile;
};

class WindowPlanner {
public:
    /// `refined`: the plan is what a refinement starts from. It then needs no comparison of easings: the one is taken
    /// that leaves least to ramps, whose steady speeds are the nearest to the refined ones.
    WindowPlanner(const Machine& machine, bool refined) : machine_(&machine), refined_(refined) {}

    /// Plans spans from a speed to rest at their end. `nodes`: span numbers where a node has to be. False:
    /// the start speed cannot be braked from with these nodes. The runs stay until the next call.
    [[nodiscard]] bool plan(std::span<const Span> spans, double start_speed, std::span<const std::size_t> nodes);
    [[nodiscard]] const std::vector<SpeedRun>& runs() const { return best_; }

private:
    struct Verdict {
        double worst = 0;      ///< greatest part of a limit, 1: just held
        bool at_cap = false;   ///< it is the speed itself, with no acceleration
        std::size_t span = 0;  ///< where
    };
    [[nodiscard]] bool plan_with(std::size_t derating, std::span<const Span> spans, double start_speed,
                                 std::span<const std::size_t> nodes);
    [[nodiscard]] const Derating& derated(std::span<const Span> spans, std::size_t span);
    /// The runs between the nodes, to begin with.
    void cut(std::span<const Span> spans, std::span<const std::size_t> nodes);
    void set_limits(SpeedRun& run, std::span<const Span> spans);
    [[nodiscard]] double part_of_limits(const Span& span, double speed, double acceleration, double jerk) const;
    [[nodiscard]] Verdict judge(const SpeedRun& run, std::span<const Span> spans) const;
    void divide(const SpeedRun& run, const Verdict& verdict, std::vector<SpeedRun>& into) const;

    const Machine* machine_;
    bool refined_;
    std::size_t derating_ = 0;  ///< in force in plan_with()
    std::vector<Derating>
        derated_;  ///< of the spans by that, as far as it was asked for; otherwise its cap is less than 0
    std::vector<SpeedRun> runs_, next_, best_;
    std::vector<ScanSegment> segments_;
    std::vector<double> speeds_;
};

}  // namespace clsurf
