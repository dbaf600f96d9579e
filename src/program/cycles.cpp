// Canned cycles G73, G81 … G89 as motions. Rules: RS274/NGC, section 3.5.16; LinuxCNC, "Canned cycles".

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "program/interpreter_state.h"

namespace clsurf {
namespace {

constexpr double peck_clearance_mm = 0.254;  ///< 0.010 inch, as RS274/NGC has it
constexpr int most_pecks = 1'000'000;

struct Stroke {
    bool dwells, feeds_out, pecks, breaks_chips;
};

/// What a cycle does between R and Z.
Stroke stroke_of(int code) {
    switch (code) {
        case 730: return {false, false, true, true};
        case 820: return {true, false, false, false};
        case 830: return {false, false, true, false};
        case 740: case 840: return {false, true, false, false};
        case 850: return {false, true, false, false};
        case 860: case 880: return {true, false, false, false};
        case 890: return {true, true, false, false};
        default: return {false, false, false, false};
    }
}

}  // namespace

void Interpreter::cycle(const Block& block) {
    const int code = state_.cycle;
    if (code == 760 && dialect_ == DialectId::linuxcnc) {
        thread_cycle(block);
        return;
    }
    const bool from_below = code == 870 && dialect_ == DialectId::linuxcnc;
    if (code == 760 || (code == 870 && !from_below)) {
        note(Severity::warning, "program.cycle", fmt::format("G{} is not carried out", code / 10));
        return;
    }
    const Stroke stroke = stroke_of(code);
    const double unit = state_.unit_mm;
    const int c = state_.plane_axis;  // the drilling axis
    const char depth_letter = "XYZ"[c];
    const auto word = [&](char letter, double& kept) {
        if (block.words.given(letter)) kept = block.words.of(letter);
    };
    word('R', cycle_.r);
    word(depth_letter, cycle_.z);
    word('Q', cycle_.q);
    if (block.words.given('P')) cycle_.p = block.words.of('P') * (dialect_ == DialectId::fanuc ? 0.001 : 1.0);
    for (int k = 0; k < 3; ++k) word("IJK"[k], cycle_.ijk[k]);
    if (stroke.pecks && !(cycle_.q > 0)) fail(fmt::format("G{} needs Q greater than 0", code / 10));

    const Vec3 position = state_.position.array().isNaN().select(0.0, state_.position);
    // Increments of R count from where the first cycle began, whichever level the tool is at now.
    if (std::isnan(cycle_.initial)) cycle_.initial = position[c];
    const double r = cycle_.r * unit + (state_.incremental ? cycle_.initial : 0.0);
    const double bottom = cycle_.z * unit + (state_.incremental ? r : 0.0);
    const double peck = cycle_.q * unit;
    if (r < bottom) fail(fmt::format("the cycle's R ({:g}) is below its bottom ({:g})", r, bottom));
    int repeats = 1;
    for (const char letter : {'L', 'K'}) {
        if (letter == 'K' && (dialect_ != DialectId::fanuc)) continue;
        if (block.words.given(letter)) repeats = static_cast<int>(std::clamp(block.words.of(letter), 0.0, 1e6));
    }
    const Vec3 rotary = rotary_target(block);
    const auto to = [&](MotionKind kind, double height) {
        Vec3 end = state_.position.array().isNaN().select(position, state_.position);
        end[c] = height;
        straight(kind, end, rotary);
    };
    // Up to R at once where the cycles began below it, even if the tool has come up since.
    if (cycle_.initial < r) to(MotionKind::rapid, r);
    const double clear = state_.retract_to_r ? r : std::max(r, cycle_.initial);
    for (int k = 0; k < repeats; ++k) {
        Vec3 hole = target(block, machine_coordinates_);
        const double now = state_.position[c];
        hole[c] = now < clear ? clear : now;
        straight(MotionKind::rapid, hole, rotary);
        to(MotionKind::rapid, r);
        if (from_below) {
            bore_back(r, bottom, clear, rotary);
            continue;
        }
        if (stroke.pecks) {
            if ((r - bottom) / peck > most_pecks) fail("too many pecks: Q is too small");
            for (double depth = r - peck; depth > bottom; depth -= peck) {
                to(MotionKind::feed, depth);
                if (!stroke.breaks_chips) to(MotionKind::rapid, r);
                to(MotionKind::rapid, depth + peck_clearance_mm);
            }
        }
        to(MotionKind::feed, bottom);
        if (stroke.dwells) push(MotionKind::dwell, state_.position, state_.rotary, static_cast<float>(cycle_.p));
        if (code == 880 && dialect_ == DialectId::linuxcnc) {
            // The operator takes the tool out by hand: no motion of the program.
            event("stop", "G88");
            state_.position[c] = clear;
            continue;
        }
        if (stroke.feeds_out) {
            // Feeds end at R; but LinuxCNC runs at feed all the way, except in G85.
            const bool all_the_way = dialect_ == DialectId::linuxcnc && code != 850;
            to(MotionKind::feed, all_the_way ? clear : r);
            if (state_.position[c] == clear) continue;
        }
        to(MotionKind::rapid, clear);
    }
}

/// G87, back boring: in beside the hole, below it to its middle, up to K with feed, and out the same way.
void Interpreter::bore_back(double r, double bottom, double clear, const Vec3& rotary) {
    const int c = state_.plane_axis;
    Vec3 aside = cycle_.ijk * state_.unit_mm;
    const double top = aside[c] + (state_.incremental ? bottom : 0.0);
    aside[c] = 0;
    const Vec3 hole = state_.position;
    const auto to = [&](MotionKind kind, const Vec3& beside, double height) {
        Vec3 end = hole + beside;
        end[c] = height;
        straight(kind, end, rotary);
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

}  // namespace clsurf
