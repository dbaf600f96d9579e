#include "program/frame_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "core/units.h"
#include "program/interpret/arc.h"
#include "program/interpret/dialect_rules.h"

namespace clsurf {
namespace {

/// Rounding of a product of poses, which must not create a new frame: of rotations, and of shifts [mm].
constexpr double turn_rounding = 1e-14, shift_rounding = 1e-10;

bool is_identity(const Eigen::Isometry3d& pose) { return pose.matrix().isIdentity(0); }

Eigen::Isometry3d without_rounding(Eigen::Isometry3d pose) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            double& v = pose.linear()(row, column);
            if (std::abs(v) < turn_rounding) v = 0;
            if (std::abs(std::abs(v) - 1) < turn_rounding) v = std::copysign(1.0, v);
        }
        if (std::abs(pose.translation()[row]) < shift_rounding) pose.translation()[row] = 0;
    }
    return pose;
}

/// The frame of the first motion that cuts; that of the last motion if none does.
std::size_t first_frame(const Motions& motions) {
    if (motions.frame.empty()) return 0;
    const auto found = std::find_if(motions.kind.begin(), motions.kind.end(), is_cut);
    const auto at = static_cast<std::size_t>(found - motions.kind.begin());
    return motions.frame[std::min(at, motions.kind.size() - 1)];
}

/// A rotated arc: its new principal axis (-1: none) and its own axis, and whether its direction is reversed.
struct TurnedArc {
    int axis;
    bool reversed;
};
TurnedArc turned(const Eigen::Isometry3d& pose, int axis) {
    const Vec3 normal = pose.linear().col(axis);
    for (int k = 0; k < 3; ++k) {
        if (std::abs(std::abs(normal[k]) - 1) < turn_rounding) return {k, normal[k] < 0};
    }
    return {-1, false};
}

/// An arc as the ends of its chords.
struct Chords {
    std::int64_t motion;
    std::vector<Xyz> ends;
};

/// Replaces arcs by chords.
void insert_chords(Motions& motions, std::vector<ProgramEvent>& events, const std::vector<Chords>& all) {
    const Motions from = motions;
    std::vector<std::int64_t> shift(from.kind.size() + 1, 0);  // for each motion: rows inserted before it
    for (const Chords& c : all)
        shift[static_cast<std::size_t>(c.motion) + 1] += static_cast<std::int64_t>(c.ends.size()) - 1;
    for (std::size_t i = 1; i < shift.size(); ++i) shift[i] += shift[i - 1];
    const auto widen = [&](auto& column, const auto& old) {
        if (old.empty()) return;
        column.resize(old.size() + static_cast<std::size_t>(shift.back()));
        for (std::size_t i = 0; i < old.size(); ++i) {
            const auto first = i + static_cast<std::size_t>(shift[i]);
            const auto last = i + static_cast<std::size_t>(shift[i + 1]);
            for (std::size_t k = first; k <= last; ++k) column[k] = old[i];
        }
    };
    widen(motions.kind, from.kind);
    widen(motions.end, from.end);
    widen(motions.feed, from.feed);
    widen(motions.line, from.line);
    widen(motions.rotary, from.rotary);
    widen(motions.tool_axis, from.tool_axis);
    widen(motions.file, from.file);
    widen(motions.call, from.call);
    widen(motions.frame, from.frame);
    for (const Chords& c : all) {
        const auto old = static_cast<std::size_t>(c.motion);
        const auto first = old + static_cast<std::size_t>(shift[old]);
        const double count = static_cast<double>(c.ends.size());
        for (std::size_t k = 0; k < c.ends.size(); ++k) {
            motions.kind[first + k] = MotionKind::spline;
            motions.end[first + k] = c.ends[k];
            if (from.rotary.empty() || old == 0) continue;
            const Vec3 before = from.rotary[old - 1].vec();
            const double part = static_cast<double>(k + 1) / count;
            motions.rotary[first + k] = Xyz(before + part * (from.rotary[old].vec() - before));
        }
    }
    std::erase_if(motions.arcs, [&](const Arc& arc) {
        return std::any_of(all.begin(), all.end(), [&](const Chords& c) { return c.motion == arc.motion; });
    });
    for (Arc& arc : motions.arcs) arc.motion += shift[static_cast<std::size_t>(arc.motion)];
    for (Curve& curve : motions.curves) curve.motion += shift[static_cast<std::size_t>(curve.motion)];
    for (ProgramEvent& event : events) {
        const auto at = static_cast<std::size_t>(std::clamp<std::int64_t>(event.motion, 0, from.size()));
        event.motion += shift[at];
    }
}

}  // namespace

Vec3 apply(const Eigen::Isometry3d& pose, const Vec3& p) {
    if (!p.hasNaN()) return pose * p;
    Vec3 result = pose.translation();
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (pose.linear()(i, k) != 0) result[i] += pose.linear()(i, k) * p[k];
        }
    }
    return result;
}

Eigen::Isometry3d pose_of(const Vec3& shift, double degrees) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = shift;
    if (degrees != 0) pose.linear() = Eigen::AngleAxisd(degrees * rad_per_deg, Vec3::UnitZ()).toRotationMatrix();
    return without_rounding(pose);
}

/// The effect of its system's unknown offset on a frame: only the components that the program has not set.
Eigen::Isometry3d FramePlacer::offset_of(const WorkFrame& frame) const {
    Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
    if (frame.system == 0) return offset;
    if (const auto found = offsets_.find(frame.system); found != offsets_.end()) offset = found->second;
    if ((frame.free & WorkFrame::rotation) != 0) return offset;
    offset.linear().setIdentity();
    for (int axis = 0; axis < 3; ++axis) {
        if ((frame.free >> axis & 1) == 0) offset.translation()[axis] = 0;
    }
    return offset;
}

void FramePlacer::forget_start(Motions& motions) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    motions.start = Xyz(unknown, unknown, unknown);
    for (int axis = 0; axis < 3; ++axis) {
        const auto until = std::min(motions.programmed_from[static_cast<std::size_t>(axis)], motions.size());
        for (std::int64_t i = 0; i < until; ++i) {
            Vec3 end = motions.end[static_cast<std::size_t>(i)].vec();
            end[axis] = unknown;
            motions.end[static_cast<std::size_t>(i)] = Xyz(end);
        }
    }
}

void FramePlacer::begin(Motions& motions) {
    begun_ = true;
    if (poses_.starts_anywhere) forget_start(motions);
    first_ = first_frame(motions);
    const WorkFrame& first = motions.frames[first_];
    const auto tool = [&](const WorkFrame& frame) {
        return Eigen::Translation3d(poses_.tool_by_kinematics ? Vec3(frame.tool - first.tool) : frame.tool);
    };
    // The offset of a system from the pose of its first frame.
    const auto solve = [&](const WorkFrame& frame, const Eigen::Isometry3d& pose) {
        return Eigen::Isometry3d(tool(frame).inverse() * pose * frame.local.inverse());
    };
    const Eigen::Isometry3d own = tool(first) * first.local;
    Eigen::Isometry3d pose = own;
    if (poses_.zero) {
        pose = *poses_.zero;
        if ((first.free & WorkFrame::rotation) != 0)
            offsets_[first.system] = solve(first, pose);
        else
            displaced_ = pose * own.inverse();
    }
    const std::vector<int> unknown = unknown_systems(motions);
    for (const int system : unknown) {
        const auto given = poses_.systems.find(system);
        if (given == poses_.systems.end()) {
            if (system != first.system && offsets_.contains(first.system)) offsets_[system] = offsets_[first.system];
            continue;
        }
        for (std::size_t i = 0; i < motions.kind.size(); ++i) {
            const WorkFrame& frame = motions.frame_of(static_cast<std::int64_t>(i));
            if (!is_cut(motions.kind[i]) || frame.system != system) continue;
            offsets_[system] = solve(frame, given->second);
            if (system == first.system && !poses_.zero) pose = given->second;
            break;
        }
    }
    for (auto& [system, offset] : offsets_) {
        offset = without_rounding(offset);
        by_axis_ = by_axis_ || !is_identity(offset);
    }
    if (coordinates_ == Coordinates::machine) return;
    // The interpreter's start is a machine position with all unknown offsets zero.
    motions.start = Xyz(apply(without_rounding(own.inverse()), motions.start.vec()));
    if (coordinates_ == Coordinates::level) {
        Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
        turn.linear() = pose.linear();
        motions.start = Xyz(apply(turn, motions.start.vec()));
    }
    reference_.translation() = pose.translation();
    if (coordinates_ == Coordinates::workpiece) reference_.linear() = pose.linear();
}

void FramePlacer::follow_frames(Motions& motions) {
    const Vec3 tool_of_reference = poses_.tool_by_kinematics ? motions.frames[first_].tool : Vec3(Vec3::Zero());
    for (std::size_t i = true_.size(); i < motions.frames.size(); ++i) {
        WorkFrame& frame = motions.frames[i];
        const Eigen::Translation3d tool(frame.tool - tool_of_reference);
        nominal_.push_back(tool * frame.local);
        true_.push_back(tool * offset_of(frame) * frame.local);
        frame.placed = without_rounding(reference_.inverse() * displaced_ * true_.back());
        const bool apart = by_axis_ && (frame.held | frame.absolute) != 0;
        moves_ = moves_ || apart || !is_identity(frame.placed) || !frame.rotary.isZero(0);
    }
}

/// With unknown offsets the axes are placed one by one: an axis may be at rest since the last frame, at a machine
/// position, or at a position of the work system.
void FramePlacer::place_by_axis(Motions& motions, std::int64_t i) {
    const WorkFrame& frame = motions.frame_of(i);
    const std::size_t at = motions.frame.empty() ? 0 : motions.frame[static_cast<std::size_t>(i)];
    Xyz& end = motions.end[static_cast<std::size_t>(i)];
    const Vec3 nominal = end.vec();
    Vec3 work = nominal;
    if (frame.held != 0) {
        const Vec3 off = apply(true_[at].inverse(), machine_) - apply(nominal_[at].inverse(), nominal_machine_);
        for (int axis = 0; axis < 3; ++axis) {
            if ((frame.held >> axis & 1) != 0 && std::isfinite(off[axis])) work[axis] += off[axis];
        }
    }
    nominal_machine_ = apply(nominal_[at], nominal);
    machine_ = apply(true_[at], work);
    for (int axis = 0; axis < 3; ++axis) {
        if ((frame.absolute >> axis & 1) != 0) machine_[axis] = nominal_machine_[axis];
    }
    end = Xyz(apply(without_rounding(reference_.inverse() * displaced_), machine_));
}

/// A curve is transformed like the end of its motion, which is already placed.
void FramePlacer::place_curve(const Motions& motions, Curve& curve) {
    const Eigen::Isometry3d& placed = motions.frame_of(curve.motion).placed;
    const Vec3 off = motions.end[static_cast<std::size_t>(curve.motion)].vec() - apply(placed, curve.span->at(1));
    const Vec3 shift = off.array().isNaN().select(0.0, off);
    curve.span = std::make_shared<const BezierCurve>(
        curve.span->mapped([&](const Vec3& p) { return Vec3(apply(placed, p) + shift); }));
}

std::int64_t FramePlacer::place(Motions& motions, std::vector<ProgramEvent>& events, std::int64_t count) {
    if (count == 0) return 0;
    if (!begun_) begin(motions);
    follow_frames(motions);
    if (!moves_) return count;
    for (std::int64_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const WorkFrame& frame = motions.frame_of(i);
        if (by_axis_)
            place_by_axis(motions, i);
        else
            motions.end[at] = Xyz(apply(frame.placed, motions.end[at].vec()));
        if (!motions.tool_axis.empty())
            motions.tool_axis[at] = Xyz(frame.placed.linear() * motions.tool_axis[at].vec());
        if (!motions.rotary.empty()) motions.rotary[at] = Xyz(motions.rotary[at].vec() + frame.rotary);
    }
    for (Curve& curve : motions.curves) {
        if (curve.motion >= count) break;
        place_curve(motions, curve);
    }
    std::vector<Chords> tilted;
    for (Arc& arc : motions.arcs) {
        if (arc.motion >= count) break;
        const auto at = static_cast<std::size_t>(arc.motion);
        const Eigen::Isometry3d& placed = motions.frame_of(arc.motion).placed;
        const TurnedArc now = turned(placed, arc.axis);
        MotionKind& kind = motions.kind[at];
        if (now.axis < 0) {
            const Eigen::Isometry3d back = placed.inverse();
            Chords chords{arc.motion, {}};
            for (const Vec3& p :
                 arc_chords(arc, kind == MotionKind::cw, apply(back, motions.begin_of(arc.motion).vec()),
                            apply(back, motions.end[at].vec())))
                chords.ends.emplace_back(apply(placed, p));
            tilted.push_back(std::move(chords));
            continue;
        }
        arc.centre = Xyz(apply(placed, arc.centre.vec()));
        arc.axis = static_cast<std::uint8_t>(now.axis);
        if (now.reversed) kind = kind == MotionKind::cw ? MotionKind::ccw : MotionKind::cw;
    }
    if (tilted.empty()) return count;
    const std::int64_t before = motions.size();
    insert_chords(motions, events, tilted);
    return count + motions.size() - before;
}

Eigen::Isometry3d place_motions(Program& program, const FramePoses& poses, Coordinates coordinates) {
    const std::vector<WorkFrame>& frames = program.motions.frames;
    if (std::any_of(frames.begin(), frames.end(), [](const WorkFrame& frame) { return !is_identity(frame.placed); }))
        throw std::logic_error("place_motions: the motions have already been placed");
    FramePlacer placer(poses, coordinates);
    (void)placer.place(program.motions, program.events, program.motions.size());
    return placer.reference();
}

std::vector<int> unknown_systems(const Motions& motions) {
    std::vector<int> systems;
    std::vector<bool> seen(motions.frames.size(), false);
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        if (!is_cut(motions.kind[i])) continue;
        const std::size_t frame = motions.frame.empty() ? 0 : motions.frame[i];
        if (!seen[frame]) {
            seen[frame] = true;
            const WorkFrame& f = motions.frames[frame];
            if ((f.free & WorkFrame::rotation) != 0 &&
                std::find(systems.begin(), systems.end(), f.system) == systems.end())
                systems.push_back(f.system);
        }
        if (motions.frame.empty()) break;
    }
    return systems;
}

std::string name_of_work_system(int number, const Dialect* dialect) {
    constexpr int plain = 6;  // G54 … G59
    if (number >= 1 && number <= plain) return fmt::format("G{}", 53 + number);
    const bool own = dialect != nullptr && dialect->rules != nullptr && dialect->rules->work_system_name != nullptr;
    if (own) return dialect->rules->work_system_name(number);
    return fmt::format("G54.1 P{}", number - plain);
}

std::string common_work_system(const Motions& motions) {
    constexpr int plain = 6;  // G54 … G59
    const int system = motions.frames.front().system;
    const auto same = [&](const WorkFrame& f) { return f.system == system; };
    const bool one = std::all_of(motions.frames.begin(), motions.frames.end(), same);
    return one && system >= 1 && system <= plain ? name_of_work_system(system, nullptr) : std::string();
}

}  // namespace clsurf
