#pragma once
// What both of HEIDENHAIN's languages share, and the meaning of words of DIN/ISO: M functions, frames and arcs (which
// Klartext has as well) and Q functions.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "program/interpret/interpreter_state.h"

namespace clsurf {

/// Functions of formulas in both of HEIDENHAIN's languages.
[[nodiscard]] std::span<const FunctionRow> heidenhain_functions();
/// The greatest value of MP7431 and of circleDeviation.
inline constexpr ArcTolerance heidenhain_arc_tolerance{
    .absolute = 0.016, .most = std::numeric_limits<double>::infinity(), .reach = 0.005, .relative_reach = 1e-3};

/// Frames in the order of their programming: the first one is outermost.
struct OrderedFrames {
    enum Part : std::size_t { datum, mirror, rotation, scaling, tilt, parts };
    std::array<ProgramFrame, parts> frame;
    std::vector<std::size_t> order;
};

/// State that both of HEIDENHAIN's languages keep from block to block.
struct HeidenhainState : DialectState {
    OrderedFrames frames;
    Vec3 datum = Vec3::Zero();                                            ///< G54, cycle 7 [mm]
    double turned_by = 0;                                                 ///< G73, cycle 10 [deg]
    double contour_tolerance = std::numeric_limits<double>::quiet_NaN();  ///< G62, cycle 32 [mm]; NaN: the machine's
};
[[nodiscard]] inline HeidenhainState& heidenhain_state(Interpreter& in) {
    return static_cast<HeidenhainState&>(*in.dialect_state_);
}

/// M91, M92: the positions of the block are those of the machine.
bool machine_position(Interpreter& in, int code, const Block& block);
/// M128, M129: positions are those of the tool tip while rotary axes move.
bool tool_centre_point(Interpreter& in, int code, const Block& block);

/// G54, G28, G73, G72: each replaces its own earlier one; the one that was programmed first stays outermost.
void set_frame_part(Interpreter& in, OrderedFrames::Part part, const ProgramFrame& frame);
/// In inch programs the feed counts tenths of an inch.
void set_inches(Interpreter& in, bool inches);
/// An arc about the pole, or along the tangent. False if its radius is given.
bool arc_about_pole(Interpreter& in, const Block& block, ArcWords& words);

/// D00 … D12: `D01 Q5 P01 +Q2 P02 3` sets Q5; D09 … D12 jump to the label of the third parameter. Returns whether the
/// line was one.
bool run_q_function(Interpreter& in, std::string_view text);
/// `L5,3`: back to label 5 three times; `L5,0` and `L5` call it. Returns whether the line was one.
bool run_label_line(Interpreter& in, std::string_view text);

}  // namespace clsurf
