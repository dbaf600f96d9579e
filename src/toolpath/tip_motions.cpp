#include "toolpath/tip_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "program/feed_mode_cursor.h"
#include "program/interpret/arc.h"
#include "program/tool_centre_point.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double chord_turn = 0.5 * rad_per_deg;  ///< turn of a rotary axis for each chord
constexpr double least_length = 1e-9;             ///< [mm] least length of a motion with a displacement
constexpr int most_chords = 2000;                 ///< greatest number of chords of a motion

class TipMaker {
public:
    TipMaker(Program& program, const Kinematics& kinematics, const Eigen::Isometry3d& pose, const Vec3& start)
        : program_(&program),
          from_(&program.motions),
          kinematics_(&kinematics),
          pose_(pose),
          back_(pose.inverse()),
          zero_(kinematics.zero_position()),
          control_(program),
          feed_mode_(program),
          path_(program.motions, start),
          start_(start) {}

    Motions make() {
        std::vector<std::int64_t> first(from_->kind.size() + 1);  // new index of the first motion of each
        to_.start = from_->start;
        to_.calls = from_->calls;
        tip_ = known(from_->start.vec());
        RotaryAngles before;
        for (std::int64_t i = 0; i < from_->size(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            first[at] = to_.size();
            const RotaryAngles angles = kinematics_->angles_of(from_->rotary[at].vec());
            const bool tip_programmed = control_.on(i);
            const bool level = is_zero(before) && is_zero(angles);
            if (tip_programmed != tips_) read_anew(tip_programmed, before);
            for (int axis = 0; axis < 3; ++axis) {
                const double word = known(from_->end[at].vec())[axis];
                if (word != last_[axis]) held_[axis] = std::numeric_limits<double>::quiet_NaN();
                last_[axis] = word;
            }
            if (tip_programmed || level || from_->kind[at] == MotionKind::dwell)
                keep(i, from_->kind[at] != MotionKind::dwell);
            else
                transform(i, before, angles);
            before = angles;
        }
        first.back() = to_.size();
        for (ProgramEvent& event : program_->events) {
            event.motion = first[static_cast<std::size_t>(std::clamp<std::int64_t>(event.motion, 0, from_->size()))];
        }
        return std::move(to_);
    }

private:
    static bool is_zero(const RotaryAngles& angles) { return angles.tilt == 0 && angles.rotation == 0; }

    /// Coordinates that no word has set are those of the start.
    [[nodiscard]] Vec3 known(const Vec3& programmed) const {
        return programmed.array().isNaN().select(start_, programmed);
    }

    /// Tip for a programmed position of the axes, and back.
    [[nodiscard]] Vec3 tip_of(const Vec3& position, const RotaryAngles& angles) const {
        return back_ * kinematics_->to_workpiece(pose_ * position + zero_, angles).tip;
    }
    [[nodiscard]] Vec3 position_of(const Vec3& tip, const RotaryAngles& angles) const {
        return back_ * (kinematics_->to_axes(pose_ * tip, angles) - zero_);
    }

    /// Tip control is switched on or off: the same position now has other coordinates. Coordinates that no word has
    /// changed since keep the machine position.
    void read_anew(bool tips, const RotaryAngles& angles) {
        tips_ = tips;
        if (!is_zero(angles)) held_ = tips ? tip_ : position_of(tip_, angles);
    }
    [[nodiscard]] Vec3 programmed(std::int64_t motion) const {
        return held_.array().isNaN().select(known(from_->end[static_cast<std::size_t>(motion)].vec()), held_);
    }

    void put(std::int64_t motion, MotionKind kind, const Vec3& end, const Xyz& rotary) {
        const auto at = static_cast<std::size_t>(motion);
        to_.kind.push_back(kind);
        to_.end.push_back(Xyz(end));
        to_.feed.push_back(from_->feed[at]);
        to_.line.push_back(from_->line[at]);
        to_.rotary.push_back(rotary);
        if (!from_->tool_axis.empty()) to_.tool_axis.push_back(from_->tool_axis[at]);
        if (!from_->file.empty()) to_.file.push_back(from_->file[at]);
        if (!from_->call.empty()) to_.call.push_back(from_->call[at]);
        tip_ = end;
    }

    void keep(std::int64_t motion, bool moves) {
        const auto at = static_cast<std::size_t>(motion);
        if (const Arc* arc = is_arc(from_->kind[at]) ? from_->arc_of(motion) : nullptr) {
            to_.arcs.push_back(*arc);
            to_.arcs.back().motion = to_.size();
        }
        if (const Curve* curve = from_->curve_of(motion)) {
            const Vec3 off = programmed(motion) - known(from_->end[at].vec());
            const Vec3 shift = off.array().isNaN().select(0.0, off);
            put_curve(*curve, [&](const Vec3& p) { return Vec3(p + shift); });
        }
        put(motion, from_->kind[at], moves ? programmed(motion) : tip_, from_->rotary[at]);
    }

    template <typename Map>
    void put_curve(const Curve& curve, const Map& map) {
        to_.curves.push_back({to_.size(), std::make_shared<const BezierCurve>(curve.span->mapped(map))});
    }

    void transform(std::int64_t motion, const RotaryAngles& before, const RotaryAngles& after) {
        const auto at = static_cast<std::size_t>(motion);
        const MotionKind kind = from_->kind[at];
        // If the previous motion was one of the tip, the words count from the positions of the axes.
        const Vec3 begin = position_of(tip_, before);
        const Vec3 end = programmed(motion);
        if (const Curve* curve = from_->curve_of(motion)) {
            // No rotary axis turns along a curve.
            put_curve(*curve, [&](const Vec3& p) { return tip_of(known(p), after); });
            put(motion, kind, tip_of(end, after), from_->rotary[at]);
            return;
        }
        const double turn = std::max(std::abs(after.tilt - before.tilt), std::abs(after.rotation - before.rotation));
        int chords = std::clamp(static_cast<int>(std::ceil(turn / chord_turn)), 1, most_chords);
        const Arc* arc = is_arc(kind) ? from_->arc_of(motion) : nullptr;
        if (arc != nullptr) {
            const double arc_length = path_.length(motion);
            const double radius = std::max((end - arc->centre.vec()).norm(), arc_chord_error);
            if (arc_length > 0) chords = std::max(chords, chord_count(radius, arc_length / radius, 0));
        }
        const Vec3 turned_from = motion > 0 ? from_->rotary[at - 1].vec() : Vec3::Zero();
        const Vec3 turned_to = from_->rotary[at].vec();
        const std::size_t first = to_.kind.size();
        const Vec3 tip_from = tip_;
        for (int k = 1; k <= chords; ++k) {
            const double part = static_cast<double>(k) / chords;
            const Vec3 position = arc != nullptr ? path_.at(motion, part)
                                                 : begin.array().isNaN().select(end, begin + part * (end - begin));
            const RotaryAngles angles{before.tilt + part * (after.tilt - before.tilt),
                                      before.rotation + part * (after.rotation - before.rotation)};
            put(motion, arc != nullptr ? MotionKind::spline : kind, tip_of(k == chords ? end : position, angles),
                Xyz(turned_from + part * (turned_to - turned_from)));
        }
        const Vec3 displacement = begin.array().isNaN().select(0.0, end - begin);
        const double length = arc != nullptr ? path_.length(motion) : displacement.norm();
        if (kind != MotionKind::rapid && (!(length > least_length) || feed_mode_.inverse_time(motion)))
            take_time(first, tip_from, length > least_length ? length : (turned_to - turned_from).norm() / rad_per_deg);
    }

    /// The motions from `first` on get the duration of one whose feed counts along `programmed`, mm or degrees, in equal
    /// parts: F per revolution does not depend on the tip's path, and neither does inverse time.
    void take_time(std::size_t first, Vec3 at, double programmed) {
        const double parts = static_cast<double>(to_.kind.size() - first);
        for (std::size_t i = first; i < to_.kind.size(); ++i) {
            const Vec3 end = to_.end[i].vec();
            const double tip = (end - at).norm();
            // If the tip is at rest, F counts degrees as before.
            if (tip > least_length && programmed > 0) to_.feed[i] *= static_cast<float>(tip * parts / programmed);
            at = end;
        }
    }

    Program* program_;
    const Motions* from_;
    const Kinematics* kinematics_;
    Eigen::Isometry3d pose_, back_;
    Vec3 zero_;
    ToolCentrePoint control_;
    FeedModeCursor feed_mode_;
    Toolpath path_;
    Motions to_;
    Vec3 start_;
    Vec3 tip_;
    bool tips_ = false;
    Vec3 last_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< programmed
    Vec3 held_ = Vec3::Constant(
        std::numeric_limits<double>::quiet_NaN());  ///< active until a word changes it; NaN: it has been changed
};

}  // namespace

void make_tip_motions(Program& program, const Kinematics& kinematics, const Eigen::Isometry3d& pose,
                      const Vec3& start) {
    if (program.motions.rotary.empty() || kinematics.always_tool_centre_point || !kinematics.has_rotary()) return;
    program.motions = TipMaker(program, kinematics, pose, start).make();
}

void make_tip_motions(Program& program, const Kinematics& kinematics, const Vec3& offset, const Vec3& start) {
    make_tip_motions(program, kinematics, Eigen::Isometry3d(Eigen::Translation3d(-offset)), start);
}

void solve_tool_axes(Program& program, const Machine& machine) {
    const Kinematics& kinematics = machine.kinematics;
    const auto range = [&](std::size_t axis) {
        // Travel limits apply to the displayed angle; angles here have the sign applied.
        const double sign = axis == 0 ? kinematics.tilt.sign : kinematics.rotation.sign;
        const MachineAxis& a = machine.rotary[axis];
        return sign > 0 ? AngleRange{a.travel_low, a.travel_high} : AngleRange{-a.travel_high, -a.travel_low};
    };
    solve_tool_axes(program, kinematics, range(0), range(1));
}

namespace {

/// Reports the first motion of every axis that the program turns and the machine lacks.
void note_missing_axes(Program& program, const Kinematics& kinematics) {
    const Motions& motions = program.motions;
    for (int k = 0; k < 3; ++k) {
        const char letter = "abc"[k];
        if (letter == kinematics.tilt.letter || letter == kinematics.rotation.letter) continue;
        const auto turned = std::find_if(motions.rotary.begin(), motions.rotary.end(),
                                         [&](const Xyz& r) { return std::abs(r.vec()[k]) > 0; });
        if (turned == motions.rotary.end()) continue;
        const auto at = static_cast<std::size_t>(turned - motions.rotary.begin());
        const std::string& file = program.files[motions.file.empty() ? 0 : motions.file[at]].name();
        program.diagnostics.add({Severity::warning, "program.axis", Place::of_line(file, motions.line[at]),
                                 fmt::format("axis {} turns, but the machine does not have it: it is read as 0",
                                             static_cast<char>(letter - 'a' + 'A')),
                                 "[kinematics] rotary names the machine's two"});
    }
}

}  // namespace

void solve_tool_axes(Program& program, const Kinematics& kinematics, const AngleRange& tilt, const AngleRange& rotation,
                     const Eigen::Matrix3d& turn) {
    Motions& motions = program.motions;
    if (!kinematics.has_rotary()) return;
    note_missing_axes(program, kinematics);
    if (motions.tool_axis.empty()) return;
    if (motions.rotary.empty()) motions.rotary = Column<Xyz>(motions.kind.size(), Xyz(0, 0, 0));
    const auto is_vector = [&](std::size_t i) { return !std::isnan(motions.tool_axis[i].x); };
    RotaryAngles before;
    std::vector<Vec3> axes;
    for (std::size_t first = 0; first < motions.kind.size();) {
        if (!is_vector(first)) {
            const Vec3 named = motions.rotary[first].vec();
            motions.rotary[first] = Xyz(named.array().isNaN().select(kinematics.programmed(before), named));
            before = kinematics.angles_of(motions.rotary[first].vec());
            ++first;
            continue;
        }
        axes.clear();
        std::size_t last = first;
        for (; last < motions.kind.size() && is_vector(last); ++last)
            axes.push_back(turn * motions.tool_axis[last].vec());
        const std::vector<RotaryAngles> found = follow_rotary(kinematics, axes, before, tilt, rotation);
        if (found.size() < axes.size()) {
            throw InputError(Place::of_line(program.main().name(), motions.line[first + found.size()]),
                             "the tool axis cannot be reached within the travel of the rotary axes");
        }
        for (std::size_t i = first; i < last; ++i) motions.rotary[i] = Xyz(kinematics.programmed(found[i - first]));
        before = found.back();
        first = last;
    }
}

}  // namespace clsurf
