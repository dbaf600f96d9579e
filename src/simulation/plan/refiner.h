#pragma once
// Refiner: turns the runs of the look-ahead, whose acceleration is zero at every node, into nearly
// time-optimal speeds that carry acceleration through the nodes.
//
// A window of runs is divided into cells. SpeedProblem finds the fastest speeds between the states at its
// ends; places between its samples at which they break a limit become samples. Most of a window is then run; the
// rest begins the next window. The runs are the fallback: they keep every limit, and each window ends in one of
// their states. Runs that cannot become faster pass unchanged: a run on straight spans between rests, and a long
// cruise at the permitted speed.

#include <deque>
#include <vector>

#include "simulation/plan/lookahead.h"
#include "simulation/plan/planned_motion.h"
#include "simulation/plan/rest_ramp.h"
#include "simulation/plan/speed_problem.h"

namespace clsurf {

class Refiner {
public:
    /// `blocks`: most that a window may span; 0: runs stay as they are planned. Both must outlive it.
    Refiner(const Machine& machine, MotionSink& sink, std::int64_t blocks);

    /// The next run, whose profile begins where that of the last one ended; `spans` are the run's own.
    /// A run that ends at rest ends its window.
    void push(const SpeedRun& run, std::span<const Span> spans);

private:
    struct KeptRun {
        SCurve profile;
        std::vector<Span> spans;
        bool derated = false, plain = true;
        bool from_rest = false, to_rest = false;
    };
    /// A part of a run, by time on its profile [s].
    struct Section {
        std::int64_t run = 0;
        double from = 0, to = 0;
    };
    struct Cell {
        double length = 0, turning = 0;  ///< [mm, rad]
        std::size_t parts = 0;           ///< how many
        std::int64_t run = 0;            ///< that it begins on
        std::int64_t block = 0;
        LimitingFactor at_cap = LimitingFactor::feed, in_bend = LimitingFactor::axis_acceleration;
        bool rounded = false;  ///< a corner rounding is in it
        // Where it ends in the plan.
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
    double knot_time_, least_time_;  ///< longest cell, and the shortest where spans are shorter [s]

    std::deque<KeptRun> runs_;
    std::int64_t first_run_ = 0;
    std::vector<Section> waiting_;  ///< since the window was last solved
    bool divided_ = false;          ///< the waiting sections are in cells
    bool ends_at_rest_ = false;
    // Next to a rest v² is no quadratic: these ways are run by the jerk, the greatest one if it leads anywhere.
    Section lead_, tail_;
    RestRamp steepest_lead_, steepest_tail_;

    std::vector<Cell> cells_;
    std::vector<CellPart> parts_;  ///< of the cells in turn, then of the one being made
    std::size_t solved_ = 0;       ///< first cells, whose values hold the limits
    SpeedProblem problem_;
    KnotState start_, end_;                     ///< of the cells
    Cell open_;                                 ///< the cell being made
    std::vector<PathSample> samples_;           ///< of the cell being made
    double least_bend_speed_ = infinite_speed;  ///< of them [mm/s]
};

}  // namespace clsurf
