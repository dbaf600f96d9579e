#include "simulation/run/five_axis_run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/place.h"
#include "program/motion_source.h"
#include "simulation/path/block_stream.h"
#include "simulation/path/curve_blocks.h"
#include "simulation/path/five_axis_path.h"
#include "simulation/plan/five_axis_speeds.h"
#include "simulation/run/five_axis_log.h"

namespace clsurf {
namespace {

constexpr int places_of_spline = 32;  ///< places of a span at which its curvature is evaluated
constexpr double chords_off = 0.03;   ///< greatest deviation of the chords of a curved block, as a share of a tolerance
constexpr int most_chords = 4096;     ///< of a block
constexpr int judged_parts = 8;       ///< parts of a block, to check whether angles are proportional to arc length

class FiveAxisRun {
public:
    FiveAxisRun(const Program& program, const Machine& machine, const FiveAxisBlocks& blocks, const FiveAxisSink& sink)
        : machine_(&machine),
          blocks_(&blocks),
          program_name_(program.main().name()),
          log_(program, machine, blocks.limits(), sink) {}

    /// Runs a section between two rests of the program.
    void run_section(ElementSource& source, const Vec3& at) {
        tip_ = at;
        chords_.clear();
        double tolerance = 0;
        PathElement element;
        while (source.next(element)) {
            if (!(element.length > 0)) continue;
            add(element, std::min(tolerance, element.tolerance));
            tolerance = element.tolerance;
            next_block_ = element.line;
        }
        run_chords();
    }

    /// Runs the dwells and turns before a block, during which the tip is at rest.
    void wait_until(LineNumber line) {
        for (; next_block_ < line; ++next_block_) {
            const std::size_t block = next_block_;
            if (!blocks_->waits(block)) continue;
            const RotaryAngles to = blocks_->axis_path(block).at(1);
            if (to.tilt == angles_.tilt && to.rotation == angles_.rotation) {
                rest(blocks_->waiting(block));
                continue;
            }
            PathElement turn;
            turn.begin = turn.end = tip_;
            turn.feed = infinite_feed;
            turn.line = static_cast<LineNumber>(block + 1);
            add(turn, 0);
            // A line that turns about the tip is one turn, even if it consists of several blocks.
            if (!goes_on(block, line)) run_chords();
        }
    }

    FiveAxisSummary finish() {
        FiveAxisPoint point = standing();
        log_.add(point);
        return log_.finish();
    }
    void begin_at(const Vec3& tip) { tip_ = tip; }

private:
    static constexpr double infinite_feed = std::numeric_limits<double>::infinity();

    /// Whether the block after a turn, before `end`, is a turn of the same line.
    [[nodiscard]] bool goes_on(std::size_t block, LineNumber end) const {
        if (block + 1 >= end || !blocks_->waits(block + 1)) return false;
        const RotaryAngles to = blocks_->axis_path(block + 1).at(1);
        const bool turns = to.tilt != angles_.tilt || to.rotation != angles_.rotation;
        return turns && blocks_->line(block + 1) == blocks_->line(block);
    }

    void add(const PathElement& element, double tolerance) {
        const std::size_t block = element.line - 1;
        const ToolAxisPath& axis_path = blocks_->axis_path(block);
        const double least = machine_->controller.chord_tolerance;
        const double allowed = std::max(element.tolerance, least);
        const double chords = std::max(chords_of_tip(element, allowed), chords_of_angles(axis_path));
        const int count = static_cast<int>(std::clamp<double>(chords, 1, most_chords));
        if (chords_.empty()) begin_ = joined(tip_, angles_);
        for (int k = 1; k <= count; ++k) {
            const double part = static_cast<double>(k) / count;
            FiveAxisChord chord;
            tip_ = k == count ? element.end : element.at(part * element.length);
            angles_ = axis_path.at(part);
            chord.end = joined(tip_, angles_);
            // The override does not apply to a rapid, whose feed is infinite.
            chord.feed = element.feed * machine_->controller.feed_override;
            chord.turn_speed = blocks_->turn_speed(block) * machine_->controller.feed_override;
            chord.inside = k > 1;
            chord.tolerance = chord.inside ? allowed : std::max(tolerance, 0.0) > 0 ? tolerance : least;
            chord.block = static_cast<std::uint32_t>(block);
            chord.part_from = static_cast<double>(k - 1) / count;
            chord.part_to = part;
            chords_.push_back(chord);
        }
    }

    static FiveAxes joined(const Vec3& tip, const RotaryAngles& angles) {
        FiveAxes both;
        both << tip, angles.tilt, angles.rotation;
        return both;
    }

    /// Number of chords; may be more than an int can represent.
    static double chords_of_tip(const PathElement& element, double tolerance) {
        if (element.straight()) return 1;
        if (element.spline) {
            // Chords are equally long, so the sharpest bend decides.
            double bend = 0;
            for (int k = 0; k <= places_of_spline; ++k)
                bend = std::max(bend, element.second_derivative(element.length * k / places_of_spline).norm());
            return std::ceil(element.length * std::sqrt(bend / (8 * chords_off * tolerance))) + 1;
        }
        // The sagitta of a chord that turns by t is its length times t/8.
        return std::ceil(std::sqrt(element.turning() * element.length / (8 * chords_off * tolerance)));
    }

    [[nodiscard]] double chords_of_angles(const ToolAxisPath& axis_path) const {
        const RotaryAngles from = axis_path.at(0), to = axis_path.at(1);
        double off = 0;
        for (int k = 1; k < judged_parts; ++k) {
            const double part = static_cast<double>(k) / judged_parts;
            const RotaryAngles angles = axis_path.at(part);
            off = std::max({off, std::abs(angles.tilt - from.tilt - part * (to.tilt - from.tilt)),
                            std::abs(angles.rotation - from.rotation - part * (to.rotation - from.rotation))});
        }
        return std::ceil(std::sqrt(off / (chords_off * machine_->kinematics.axis_tolerance)));
    }

    void run_chords() {
        if (chords_.empty()) return;
        const FiveAxisPath path(machine_->kinematics, blocks_->zero(), begin_, chords_);
        chords_.clear();
        if (!(path.length() > 0)) return;
        const auto place_of = [&](std::size_t block) { return Place::of_line(program_name_, blocks_->line(block)); };
        for (const FiveAxisMotion& motion : plan_speeds(path, *machine_, place_of)) {
            const double end = time_ + motion.duration;
            for (; next_time() < end; add_point(path, motion, next_time() - time_)) {}
            time_ = end;
        }
    }

    void add_point(const FiveAxisPath& path, const FiveAxisMotion& motion, double time) {
        double speed = 0;
        const double u = std::min(motion.at(std::max(time, 0.0), speed), path.length());
        const FiveAxisPlace place = path.at(u);
        const std::size_t chord = path.chord_at(u);
        const std::size_t block = path.chord(chord).block;
        log_.note_deviation(place.deviation);
        if (blocks_->cuts(block)) {
            const Kinematics& k = machine_->kinematics;
            const ToolAxisPath& axis_path = blocks_->axis_path(block);
            const Vec3 ideal =
                great_circle(k.axis_of(axis_path.at(0)), k.axis_of(axis_path.at(1)), path.part_at(chord, u));
            log_.note_orientation(angle_between(k.axis_of(place.angles), ideal));
        }
        last_line_ = blocks_->line(block);
        add_point(place.tip, place.angles, speed * place.pace, motion.limit);
    }

    void add_point(const Vec3& tip, const RotaryAngles& angles, double speed, LimitingFactor limit) {
        FiveAxisPoint point;
        point.commanded = machine_position(tip, angles);
        point.speed = speed;
        point.line = last_line_;
        point.limit = limit;
        log_.add(point);
    }

    void rest(double wait) {
        for (time_ += wait; next_time() < time_;) log_.add(standing());
    }

    [[nodiscard]] std::array<double, 5> machine_position(const Vec3& tip, const RotaryAngles& angles) const {
        const Vec3 linear = machine_->kinematics.to_axes(tip + blocks_->zero(), angles);
        return {linear.x(), linear.y(), linear.z(), angles.tilt, angles.rotation};
    }
    [[nodiscard]] FiveAxisPoint standing() const {
        FiveAxisPoint point;
        point.commanded = machine_position(tip_, angles_);
        point.line = last_line_;
        return point;
    }
    [[nodiscard]] double next_time() const { return static_cast<double>(log_.points()) * machine_->controller.period; }

    const Machine* machine_;
    const FiveAxisBlocks* blocks_;
    std::string program_name_;
    FiveAxisLog log_;
    std::vector<FiveAxisChord> chords_;
    FiveAxes begin_ = FiveAxes::Zero();
    Vec3 tip_ = Vec3::Zero();
    RotaryAngles angles_;
    LineNumber next_block_ = 0, last_line_ = 0;
    double time_ = 0;
};

/// Reports settings of the controller that only a three-axis planner uses, if they are not at their defaults.
void note_settings_without_effect(const ControllerSettings& c, const std::string& program, Diagnostics& diagnostics) {
    std::string names;
    const auto add = [&](bool set, const char* name) {
        if (set) names += (names.empty() ? "" : ", ") + std::string(name);
    };
    add(c.lookahead_distance > 0, "lookahead_distance");
    add(c.replan_blocks > 0, "replan_blocks");
    add(c.block_time > 0, "block_time");
    add(c.whole_periods, "whole_periods");
    if (!names.empty())
        diagnostics.add({Severity::warning, "motion.no-effect", Place::of_file(program),
                         names + ": without effect, because five axes are planned along the whole path at once", ""});
}

}  // namespace

FiveAxisSummary run_five_axes(const Program& program, const Machine& machine, FiveAxisBlocks blocks, const Vec3& start,
                              const FiveAxisSink& sink, const Progress& progress) {
    blocks.forget_caps();
    WholeProgram source(blocks.planned());
    BlockStream stream(source, machine, start);
    FiveAxisRun run(program, machine, blocks, sink);
    Vec3 at = stream.position();
    run.begin_at(at);
    while (stream.begin_section()) {
        std::unique_ptr<CurveBlocks> curves;
        if (machine.controller.curve != CurveMode::none)
            curves = std::make_unique<CurveBlocks>(stream, machine.controller.curve);
        run.run_section(curves ? static_cast<ElementSource&>(*curves) : stream, at);
        at = stream.section_end();
        run.wait_until(stream.dwell_line());
        if (progress) progress("plan and interpolate", stream.done());
    }
    FiveAxisSummary summary = run.finish();
    note_settings_without_effect(machine.controller, program.main().name(), summary.run.diagnostics);
    if (!summary.axes_ok) {
        summary.run.diagnostics.add({Severity::warning, "motion.limits", Place::of_file(program.main().name()),
                                     "an axis exceeds a limit by more than 0.1 %", "a lower feed helps"});
    }
    return summary;
}

}  // namespace clsurf
