// The motions of blocks: appended, with their frame, axes and call.

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/units.h"
#include "program/interpret/compensated_motions.h"
#include "program/interpret/curves.h"
#include "program/interpret/feeds.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/tool_axis.h"

namespace clsurf {
namespace {

/// The common rotation of the rotary axes, or of the tool axis if it is a vector [deg].
double turn_to(const Interpreter& in, const Vec3& rotary) {
    const auto known = [](const Vec3& turn) { return Vec3(turn.array().isNaN().select(0.0, turn)); };
    if (!tool_axis_is_vector(in.five_axis_, in.state_)) return known(rotary - in.state_.rotary).norm();
    const Column<Xyz>& axes = in.program_.motions.tool_axis;
    return axes.empty() ? 0 : angle_between(known(axes.back().vec()), in.state_.tool_axis) / rad_per_deg;
}

/// Finds the index of the next motion's frame; adds the frame if it is new.
void settle_work_frame(const ModalState& state, KnownWorkFrames& work_frames, Motions& motions,
                       std::uint64_t forgotten) {
    work_frames.changes = state.frame_changes;
    work_frames.held = state.held;
    work_frames.absolute = state.absolute;
    work_frames.words = state.frame;
    const WorkFrame frame = state.work_frame();
    std::array<double, 34> key{};
    std::copy_n(frame.local.data(), 16, key.begin());
    key[16] = frame.system;
    key[17] = frame.free + 16 * frame.held + 256 * frame.absolute;
    std::copy_n(frame.tool.data(), 3, key.begin() + 18);
    // Rotary offsets: one number suffices to distinguish those of a program.
    key[21] = frame.rotary.dot(Vec3(1, 1e-3, 1e-6));
    std::ranges::copy(frame.words.numbers(), key.begin() + 22);
    std::vector<WorkFrame>& frames = motions.frames;
    const auto [known, added] = work_frames.known.try_emplace(key, static_cast<std::uint32_t>(frames.size()));
    if (added && work_frames.known.size() == 1 && forgotten == 0 && motions.kind.size() == 1) {
        known->second = 0;
        frames.front() = frame;
    } else if (added) {
        frames.push_back(frame);
    }
    work_frames.current = known->second;
}

}  // namespace

/// The axes are at rest for a time.
void Interpreter::dwell(double seconds) {
    constexpr double longest = 86'400;  // a day: a log has a record for each of its periods
    if (seconds < 0) fail("negative dwell time");
    if (!(seconds <= longest)) fail(fmt::format("a dwell of {:.3g} s: the longest is {:.0f} s", seconds, longest));
    push(MotionKind::dwell, tool_position(compensation_, state_), state_.rotary, static_cast<float>(seconds));
}

void Interpreter::straight(MotionKind kind, const Vec3& end, const Vec3& rotary) {
    const Vec3 from = state_.position.array().isNaN().select(end, state_.position);
    const double length = (end - from).norm(), turn = length > 0 ? 0 : turn_to(*this, rotary);
    const float feed = kind == MotionKind::rapid ? std::numeric_limits<float>::quiet_NaN()
                       : turn > 0                ? feed_for(state_, turn, 1)
                                                 : feed_for(state_, length);
    push(kind, end, rotary, feed);
}

void Interpreter::push_arc(Arc arc, bool clockwise, const Vec3& begin, const Vec3& end, const Vec3& rotary) {
    if (curves_.is_open()) {
        // The spline ends in the direction at the beginning of the arc.
        Vec3 out = begin - arc.centre.vec();
        out[arc.axis] = 0;
        const Vec3 axis = Vec3::Unit(arc.axis);
        close_spline(*this, clockwise ? out.cross(axis) : axis.cross(out));
    }
    arc.motion = program_.motions.size();
    program_.motions.arcs.push_back(arc);
    push(clockwise ? MotionKind::cw : MotionKind::ccw, end, rotary,
         feed_for(state_, arc_length(arc, clockwise, begin, end)));
}

void Interpreter::push(MotionKind kind, const Vec3& end, const Vec3& rotary, float feed) {
    if (curves_.is_open()) close_spline_before(*this, end);
    Motions& m = program_.motions;
    if (forgotten_ + m.kind.size() >= most_motions_)
        fail(fmt::format("more than {} motions from {} lines: an endless loop?", most_motions_,
                         program_.main().line_count()));
    if (end.array().isInf().any()) fail("a position is not finite");
    if (feed == 0 && kind != MotionKind::dwell && !feed_missed_) {
        feed_missed_ = true;
        note(Severity::warning, "program.no-feed",
             state_.feed == 0 ? "a cutting motion without feed (F); reported once"
                              : "a cutting motion with a feed of 0 (is the spindle speed missing?); reported once");
    }
    m.kind.push_back(kind);
    m.end.push_back(Xyz(end));
    m.feed.push_back(feed);
    m.line.push_back(place_.line);
    if (state_.frame_changes != work_frames_.changes || state_.held != work_frames_.held ||
        state_.absolute != work_frames_.absolute || state_.frame != work_frames_.words)
        settle_work_frame(state_, work_frames_, program_.motions, forgotten_);
    for (unsigned axis = 0; state_.unplaced != 0 && axis < 3; ++axis) {
        if ((state_.unplaced >> axis & 1) != 0) m.programmed_from[axis] = m.size();
    }
    if (work_frames_.current != 0 || !m.frame.empty()) {
        if (m.frame.empty()) m.frame = Column<std::uint32_t>(m.kind.size() - 1, 0);
        m.frame.push_back(work_frames_.current);
    }
    const bool vector = tool_axis_is_vector(five_axis_, state_);
    const Vec3 angles = vector ? Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) : rotary;
    if (!m.rotary.empty() || angles.squaredNorm() != 0) {
        if (m.rotary.empty()) m.rotary = Column<Xyz>(m.kind.size() - 1, Xyz(0, 0, 0));
        m.rotary.push_back(Xyz(angles * rad_per_deg));
    }
    if (vector || !m.tool_axis.empty()) {
        const Xyz none(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (m.tool_axis.empty()) m.tool_axis = Column<Xyz>(m.kind.size() - 1, none);
        m.tool_axis.push_back(vector ? Xyz(state_.tool_axis) : none);
    }
    if (!m.file.empty() || place_.file != 0) {
        if (m.file.empty()) m.file = Column<std::uint16_t>(m.kind.size() - 1, 0);
        m.file.push_back(static_cast<std::uint16_t>(place_.file));
    }
    if (!m.calls.empty()) {
        if (m.call.empty()) m.call = Column<std::uint32_t>(m.kind.size() - 1, 0);
        m.call.push_back(calls_.running);
    }
    arcs_.begin_of_last = state_.position;
    state_.position = end;
    state_.rotary = angles;
}

}  // namespace clsurf
