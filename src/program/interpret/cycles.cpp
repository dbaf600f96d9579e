// Canned cycles G73 … G89 as motions. Rules: RS274/NGC, section 3.5.16; LinuxCNC, "Canned cycles";
// Fanuc, operator's manual of the series 30i, "Canned cycle for drilling".

#include "program/interpret/cycles.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/axis_words.h"
#include "program/interpret/interpreter_state.h"
#include "program/interpret/threading.h"

namespace clsurf {
namespace {

/// The actions of a cycle between R and its bottom.
struct Stroke {
    bool dwells = false, feeds_out = false, pecks = false, breaks_chips = false;
};

constexpr double peck_clearance_mm = 0.254;  ///< 0.010 inch, as in RS274/NGC; Fanuc has a parameter for it
constexpr int most_pecks = 1'000'000;

/// The actions of a cycle between R and Z.
Stroke stroke_of(int code, bool rs274) {
    switch (code) {
        case 730: return {.pecks = true, .breaks_chips = true};
        case 820: return {.dwells = true};
        case 830: return {.pecks = true};
        case 740:
        case 840:
        case 842:
        case 843: return {.dwells = !rs274, .feeds_out = true};
        case 850: return {.feeds_out = true};
        case 860:
        case 880: return {.dwells = true};
        case 890: return {.dwells = true, .feeds_out = true};
        default: return {};
    }
}

/// How many holes a block drills: L, in some dialects also K.
int cycle_repeats(const Block& block, bool by_k) {
    int repeats = 1;
    for (const char letter : {'L', 'K'}) {
        if (letter == 'K' && !by_k) continue;
        if (block.words.given(letter)) repeats = static_cast<int>(std::clamp(block.words.of(letter), 0.0, 1e6));
    }
    return repeats;
}

/// R, depth, Q, P and I J K, which are modal from hole to hole.
void read_cycle_words(Interpreter& in, const Block& block, const Stroke& stroke) {
    const auto word = [&](char letter, double& kept) {
        if (block.words.given(letter)) kept = block.words.of(letter);
    };
    word('R', in.cycle_.r);
    word("XYZ"[in.state_.plane_axis], in.cycle_.z);
    word('Q', in.cycle_.q);
    if (block.words.given('P')) in.cycle_.p = block.words.of('P') * in.rules_->cycles.dwell_unit;
    const int code = in.state_.cycle / 10;
    // In other cycles K is the number of repeats.
    const bool steps_aside = code == 76 || code == 87;
    for (int k = 0; steps_aside && k < 3; ++k) word("IJK"[k], in.cycle_.ijk[k]);
    for (const auto& [letter, kept] :
         {std::pair('R', &in.cycle_.r), std::pair("XYZ"[in.state_.plane_axis], &in.cycle_.z)}) {
        if (!std::isnan(*kept)) continue;
        in.note(Severity::warning, "program.cycle", fmt::format("G{0} without {1}: read as {1}0", code, letter));
        *kept = 0;
    }
    if (!stroke.pecks || in.cycle_.q > 0) return;
    if (in.rules_->cycles.rs274) in.fail(fmt::format("G{} needs Q greater than 0", code));
    in.note(Severity::warning, "program.cycle", fmt::format("G{} without Q: read as one stroke", code));
}

/// The ends of the pecks of Q above the bottom [mm].
std::vector<double> peck_depths(const Interpreter& in, double r, double bottom) {
    std::vector<double> depths;
    const double peck = in.cycle_.q * in.state_.unit_mm;
    if (!(peck > 0)) return depths;
    if ((r - bottom) / peck > most_pecks) in.fail("too many pecks: Q is too small");
    for (double depth = r - peck; depth > bottom; depth -= peck) depths.push_back(depth);
    return depths;
}

/// G74 and G84 outside the XY plane. LinuxCNC's interpreter (convert_cycle_g74_g84, up to 2.10) passes the axes in
/// another order, and the machine moves accordingly: along X in G18, along Y to the wrong position in G19.
void tap_turned(Interpreter& in, double bottom, double clear, const Vec3& rotary) {
    const Vec3 hole = in.state_.position;
    const bool zx = in.state_.plane_axis == 1;
    const auto at = [&](double height) {
        return zx ? Vec3(height, hole.z(), hole.x()) : Vec3(hole.z(), height, hole.y());
    };
    in.note(
        Severity::warning, "program.cycle",
        fmt::format("G{} in {}: LinuxCNC uses the axes in a wrong order; the motions are read as LinuxCNC makes them",
                    in.state_.cycle / 10, zx ? "G18" : "G19"));
    in.straight(MotionKind::feed, at(bottom), rotary);
    in.straight(MotionKind::feed, at(clear), rotary);
    in.state_.position = hole;  // the position from which the interpreter continues
    in.state_.position[in.state_.plane_axis] = clear;
}

/// From R down through the depths, and out.
void drill(Interpreter& in, const Stroke& stroke, double r, double bottom, double clear,
           const std::vector<double>& depths, const Vec3& rotary) {
    const int c = in.state_.plane_axis;
    const bool rs274 = in.rules_->cycles.rs274;
    if (rs274 && c != 2 && (in.state_.cycle == 74_g || in.state_.cycle == 84_g)) {
        tap_turned(in, bottom, clear, rotary);
        return;
    }
    for (const double depth : depths) {
        go_to_level(in, MotionKind::feed, depth, rotary);
        if (stroke.dwells && in.cycle_.p > 0) in.dwell(in.cycle_.p);
        if (!stroke.breaks_chips) go_to_level(in, MotionKind::rapid, r, rotary);
        go_to_level(in, MotionKind::rapid, depth + peck_clearance_mm, rotary);
    }
    go_to_level(in, MotionKind::feed, bottom, rotary);
    if (stroke.dwells && (rs274 || in.cycle_.p > 0)) in.dwell(in.cycle_.p);
    if (in.state_.cycle == 880 && rs274) {
        // The operator retracts the tool by hand: no motion of the program.
        in.event("stop", "G88");
        in.state_.position[c] = clear;
        return;
    }
    if (stroke.feeds_out) {
        // Feeds end at R, but LinuxCNC stays at feed to the clearance level, except in G85.
        const bool all_the_way = rs274 && in.state_.cycle != 850;
        go_to_level(in, MotionKind::feed, all_the_way ? clear : r, rotary);
        if (in.state_.programmed()[c] == clear) return;
    }
    go_to_level(in, MotionKind::rapid, clear, rotary);
}

/// Q (or I J K) of Fanuc's boring cycles: the lateral shift of the cutting edge. Its direction is a parameter of the
/// control; without I J K along the plane's first axis.
Vec3 edge_shift(const CycleState& cycle, const ModalState& state) {
    const int c = state.plane_axis;
    Vec3 aside = cycle.ijk * state.unit_mm;
    aside[c] = 0;
    if (aside.isZero()) aside[(c + 1) % 3] = cycle.q * state.unit_mm;
    return aside;
}

/// G76 of Fanuc: down at feed, lateral shift, and out without contact.
void bore_fine(Interpreter& in, double bottom, double clear, const Vec3& rotary) {
    go_to_level(in, MotionKind::feed, bottom, rotary);
    if (in.cycle_.p > 0) in.dwell(in.cycle_.p);
    const Vec3 aside = edge_shift(in.cycle_, in.state_);
    step_aside(in, aside, rotary);
    go_to_level(in, MotionKind::rapid, clear, rotary);
    step_aside(in, -aside, rotary);
}

/// G87 of Fanuc: lateral shift, below the hole to R, back to its middle, up to Z at feed, and out along the same
/// path.
void bore_back_shifted(Interpreter& in, double r, double top, double clear, const Vec3& rotary) {
    const Vec3 aside = edge_shift(in.cycle_, in.state_);
    step_aside(in, aside, rotary);
    go_to_level(in, MotionKind::rapid, r, rotary);
    step_aside(in, -aside, rotary);
    go_to_level(in, MotionKind::feed, top, rotary);
    if (in.cycle_.p > 0) in.dwell(in.cycle_.p);
    step_aside(in, aside, rotary);
    go_to_level(in, MotionKind::rapid, clear, rotary);
    step_aside(in, -aside, rotary);
}

/// G87, back boring: in next to the hole, below it to its middle, up to K at feed, and out along the same path.
void bore_back(Interpreter& in, double r, double bottom, double clear, const Vec3& rotary) {
    const int c = in.state_.plane_axis;
    Vec3 aside = in.cycle_.ijk * in.state_.unit_mm;
    const double top = aside[c] + (in.state_.incremental ? bottom : 0.0);
    aside[c] = 0;
    const Vec3 hole = in.state_.position;
    const auto to = [&](MotionKind kind, const Vec3& beside, double height) {
        Vec3 end = hole + beside;
        end[c] = height;
        in.straight(kind, end, rotary);
    };
    const Vec3 middle = Vec3::Zero();
    to(MotionKind::rapid, aside, r);
    to(MotionKind::rapid, aside, bottom);
    to(MotionKind::rapid, middle, bottom);
    to(MotionKind::feed, middle, top);
    to(MotionKind::feed, middle, bottom);
    to(MotionKind::rapid, aside, bottom);
    to(MotionKind::rapid, aside, clear);
    to(MotionKind::rapid, middle, clear);
}

}  // namespace

void drilling_cycle(Interpreter& in, const Block& block) {
    const int code = in.state_.cycle;
    const bool rs274 = in.rules_->cycles.rs274;
    if (code == 76_g && rs274) {
        thread_cycle(in, block);
        return;
    }
    const bool from_below = code == 87_g;
    const bool fine_bore = code == 76_g;
    const Stroke stroke = stroke_of(code, rs274);
    const double unit = in.state_.unit_mm;
    const int c = in.state_.plane_axis;  // the drilling axis
    read_cycle_words(in, block, stroke);
    in.state_.place(1u << in.state_.plane_axis, false);
    // Heights and holes are in the program's own frame.
    const Vec3 here = in.state_.programmed();
    const Vec3 position = here.array().isNaN().select(0.0, here);
    // Increments of R count from the level before the first cycle, whatever the present level.
    if (std::isnan(in.cycle_.initial)) in.cycle_.initial = position[c];
    // Increments under G91. Fanuc keeps the heights as they were programmed, even if G90 or G91 has
    // changed at the next hole.
    if (rs274 || block.words.given('R') || std::isnan(in.cycle_.r_height))
        in.cycle_.r_height = in.cycle_.r * unit + (in.state_.incremental ? in.cycle_.initial : 0.0);
    const double r = in.cycle_.r_height;
    if (rs274 || block.words.given("XYZ"[c]) || std::isnan(in.cycle_.bottom))
        in.cycle_.bottom = in.cycle_.z * unit + (in.state_.incremental ? r : 0.0);
    const double bottom = in.cycle_.bottom;
    if (r < bottom && (rs274 || !from_below))
        in.fail(fmt::format("the cycle's R ({:g}) is below its bottom ({:g})", r, bottom));
    const int repeats = cycle_repeats(block, in.rules_->cycles.repeats_by_k && !from_below);
    const Vec3 rotary = rotary_target(in, block);
    // Moves up to R first if the cycles began below it, even if the tool has been raised since.
    if (rs274 && in.cycle_.initial < r) go_to_level(in, MotionKind::rapid, r, rotary);
    const double clear = in.state_.retract_to_r && !(from_below && !rs274) ? r : std::max(r, in.cycle_.initial);
    const std::vector<double> depths = stroke.pecks ? peck_depths(in, r, bottom) : std::vector<double>();
    for (int k = 0; k < repeats; ++k) {
        Vec3 hole = in.this_block_.machine_coordinates ? in.state_.frame.to_programmed(target_of(in, block, true))
                                                       : read_axes(in, block, false);
        const double now = in.state_.programmed()[c];
        // RS274 rises before it moves across; Fanuc moves across at the present level.
        hole[c] = now < clear && rs274 ? clear : now;
        in.straight(MotionKind::rapid, in.state_.frame.to_work(hole), rotary);
        if (from_below && !rs274) {
            bore_back_shifted(in, r, bottom, clear, rotary);
            continue;
        }
        go_to_level(in, MotionKind::rapid, r, rotary);
        if (from_below) {
            bore_back(in, r, bottom, clear, rotary);
            continue;
        }
        if (fine_bore) {
            bore_fine(in, bottom, clear, rotary);
            continue;
        }
        drill(in, stroke, r, bottom, clear, depths, rotary);
    }
}

void go_to_level(Interpreter& in, MotionKind kind, double height, const Vec3& rotary) {
    const Vec3 now = in.state_.programmed();
    Vec3 end = now.array().isNaN().select(0.0, now);
    end[in.state_.plane_axis] = height;
    in.straight(kind, in.state_.frame.to_work(end), rotary);
}

void step_aside(Interpreter& in, const Vec3& by, const Vec3& rotary) {
    in.straight(MotionKind::rapid, in.state_.frame.to_work(in.state_.programmed() + by), rotary);
}

}  // namespace clsurf
