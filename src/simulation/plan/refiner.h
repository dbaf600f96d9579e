#pragma once
// Refiner: turns the runs of the look-ahead, whose acceleration is zero at every node, into nearly
// time-optimal speeds that carry acceleration through the nodes.
//
// A window of runs is divided into cells. SpeedProblem finds the fastest speeds between the states at the ends of the
// window. If they exceed a limit between samples, that place becomes a sample. Most of a window is then run; the rest
// begins the next window. The runs are the fallback: they satisfy every limit, and each window ends in one of their states.
// Runs that cannot become faster pass unchanged: a run on straight spans between rests, and a long cruise at the permitted
// speed.

#include <deque>
#include <vector>

#include "simulation/plan/lookahead.h"
#include "simulation/plan/planned_motion.h"
#include "simulation/plan/rest_ramp.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

class Refiner {
public:
    /// `blocks`: greatest number of blocks in a window; 0: runs are passed on as planned. Both references must outlive the
    /// object.
    Refiner(const Machine& machine, MotionSink& sink, std::int64_t blocks);

    /// Takes the next run. Its profile begins where the last one ended; `spans` are its own spans. A run that ends at rest
    /// ends its window.
    void push(const SpeedRun& run, std::span<const Span> spans);

private:
    struct KeptRun {
        SCurve profile;
        std::vector<Span> spans;
        bool derated = false, plain = true;
        bool from_rest = false, to_rest = false;
    };
    /// A section of a run, by time on its profile [s].
    struct Section {
        std::int64_t run = 0;
        double from = 0, to = 0;
    };
    struct Cell {
        double length = 0, turning = 0;  ///< [mm, rad]
        std::size_t parts = 0;           ///< number of parts
        std::int64_t run = 0;            ///< number of the run on which it begins
        std::int64_t block = 0;
        LimitingFactor at_cap = LimitingFactor::feed, in_bend = LimitingFactor::axis_acceleration;
        bool rounded = false;  ///< it contains a corner rounding
        // The end of the cell in the plan.
        KnotState end;
        std::int64_t end_run = 0;
        double end_time = 0;
    };

    [[nodiscard]] const KeptRun& kept(std::int64_t run) const {
        return runs_[static_cast<std::size_t>(run - first_run_)];
    }
    [[nodiscard]] bool cruises_at_the_cap(const KeptRun& run) const;
    void run_as_planned(const Section& section);
    void add(const Section& section);
    void divide(Section& section);
    void add_cells(const Section& section);
    void end_cell_before(const Span& span);
    void close_cell();
    void add_part(CellPart& part, double begin, CellLimits& limits);
    [[nodiscard]] std::vector<SpeedProblem::Between> broken_between() const;
    void solve(bool to_the_end);
    [[nodiscard]] bool solve_in_part();
    [[nodiscard]] bool solve_from_rests(bool to_rest);
    void run_lead();
    void run_tail();
    void wait_from(const Cell& cell);
    void run_cells(std::size_t count, bool to_rest);
    void close();
    void forget_runs();

    const Machine* machine_;
    MotionSink* sink_;
    std::int64_t blocks_;
    double knot_time_, least_time_;  ///< [s] duration of cells: the longest, and the shortest if spans are shorter

    std::deque<KeptRun> runs_;
    std::int64_t first_run_ = 0;
    std::vector<Section> waiting_;  ///< since the last solution of the window
    bool divided_ = false;          ///< the waiting sections are in cells
    bool ends_at_rest_ = false;
    // Next to a rest v² is not a quadratic: these sections run at constant jerk, the greatest possible one if it is
    // feasible.
    Section lead_, tail_;
    RestRamp steepest_lead_, steepest_tail_;

    std::vector<Cell> cells_;
    std::vector<CellPart> parts_;  ///< of the cells in order, then of the cell that is being made
    std::size_t solved_ = 0;       ///< number of leading cells whose values satisfy the limits
    SpeedProblem problem_;
    KnotState start_, end_;                     ///< of the cells
    Cell open_;                                 ///< the cell that is being made
    std::vector<PathSample> samples_;           ///< of the cell that is being made
    double least_bend_speed_ = infinite_speed;  ///< of the samples [mm/s]
};

}  // namespace clsurf
