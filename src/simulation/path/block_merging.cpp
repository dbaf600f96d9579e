#include "simulation/path/block_merging.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "program/motion_source.h"

namespace clsurf {
namespace {

// As LinuxCNC 2.9 (docs/simulate.md#the-trapezoidal-planner, point 2).
constexpr std::size_t most_merged = 101;

bool mergeable(const PathElement& element) {
    return element.straight() && element.merging_tolerance > 0 && element.tolerance > 0 && std::isfinite(element.feed);
}

}  // namespace

/// Whether a line from the start of the merged blocks to the end of the next block passes all points within the tolerance.
bool BlockMerging::joins(const PathElement& element, double& deviation) const {
    if (passed_.size() >= most_merged || !mergeable(element) || element.feed != merged_.feed ||
        element.merging_tolerance != merged_.merging_tolerance || element.tolerance != merged_.tolerance)
        return false;
    const Vec3 chord = element.end - merged_.begin;
    const double square = chord.squaredNorm();
    if (!(square > no_arc_length * no_arc_length)) return false;
    deviation = 0;
    for (const Vec3& point : passed_) {
        const Vec3 offset = point - merged_.begin;
        const double place = std::clamp(offset.dot(chord) / square, 0.0, 1.0);
        deviation = std::max(deviation, (offset - place * chord).norm());
        if (deviation > element.merging_tolerance) return false;
    }
    return true;
}

bool BlockMerging::next(PathElement& element) {
    if (!std::exchange(waiting_, false) && !source_->next(waiting_element_)) return false;
    merged_ = waiting_element_;
    passed_.assign(1, merged_.end);
    while (mergeable(merged_) && source_->next(waiting_element_)) {
        double deviation = 0;
        if (!joins(waiting_element_, deviation)) {
            waiting_ = true;
            break;
        }
        PathElement line = element_of(MotionKind::feed, nullptr, merged_.begin, waiting_element_.end);
        line.take_block(waiting_element_);
        line.stops = waiting_element_.stops;
        line.block_length = line.length;
        line.deviation = deviation;
        merged_ = line;
        passed_.push_back(merged_.end);
    }
    element = merged_;
    element.block = blocks_++;
    return true;
}

std::vector<LineNumber> merged_lines(const Program& program, const Machine& machine) {
    WholeProgram whole(program);
    const bool trapezoidal = machine.controller.planner == PlannerKind::trapezoidal;
    BlockStream blocks(whole, machine, Vec3::Zero(), trapezoidal ? Stops::programmed : Stops::at_corners);
    BlockMerging merged(blocks);
    std::vector<LineNumber> lines;
    PathElement element;
    while (blocks.begin_section())
        while (merged.next(element)) lines.push_back(element.line);
    return lines;
}

std::vector<std::uint8_t> merged_with_next(const Program& program, const Machine& machine) {
    const std::vector<LineNumber> lines = merged_lines(program, machine);
    const std::unordered_set<LineNumber> left(lines.begin(), lines.end());
    const Motions& motions = program.motions;
    std::vector<std::uint8_t> merged(static_cast<std::size_t>(motions.size()), 0);
    for (std::size_t i = 0; i < merged.size(); ++i)
        merged[i] = motions.kind[i] == MotionKind::feed && !left.contains(motions.line[i]) ? 1 : 0;
    return merged;
}

}  // namespace clsurf
