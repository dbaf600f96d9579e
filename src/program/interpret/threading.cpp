// Threads: G76 as motions. Rules: LinuxCNC, "G76 Threading Cycle".

#include "program/interpret/threading.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "program/interpret/axis_words.h"
#include "program/interpret/feeds.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr int most_passes = 100'000;
constexpr double steepest_slide = 80;  ///< compound angle [deg]

struct Thread {
    Vec3 begin, end;   ///< start of the drive line, and its end along z [mm]
    double crest = 0;  ///< from the drive line to the crest, signed [mm]
    double depth = 0;  ///< of the whole thread, positive [mm]
    double slide = 0;  ///< shift of a pass along z per unit of depth
    double taper = 0;  ///< length of the tapers [mm]
    bool entry_taper = false, exit_taper = false;
};

/// The turning points of the tool in one pass: the first and the last are on the drive line.
struct Pass {
    std::vector<std::pair<MotionKind, Vec3>> moves;
};

Pass pass_at(const Thread& thread, double depth) {
    const double inwards = thread.crest < 0 ? -1.0 : 1.0;
    const double along = thread.end.z() < thread.begin.z() ? -1.0 : 1.0;
    const double cut = thread.begin.x() + thread.crest + inwards * depth;
    const double crest = cut - inwards * thread.depth;  // the tapers rise by the whole depth
    const double clear = crest - thread.crest;
    const double first = thread.begin.z() + along * depth * thread.slide;
    const double last = thread.end.z() - along * (thread.depth - depth) * thread.slide;
    const double y = thread.begin.y();
    const double taper = along * thread.taper;
    Pass pass;
    const auto to = [&](MotionKind kind, double x, double z) { pass.moves.emplace_back(kind, Vec3(x, y, z)); };
    to(MotionKind::rapid, clear, first);
    if (thread.entry_taper) {
        to(MotionKind::feed, crest, first);
        to(MotionKind::feed, cut, first + taper);
    } else {
        to(MotionKind::rapid, cut, first);
    }
    to(MotionKind::feed, cut, thread.exit_taper ? last - taper : last);
    if (thread.exit_taper) to(MotionKind::feed, crest, last);
    to(MotionKind::rapid, clear, last);
    return pass;
}

}  // namespace

void thread_cycle(Interpreter& in, const Block& block) {
    const Words& w = block.words;
    if (in.state_.plane_axis != 1) in.fail("G76 needs the XZ plane (G18)");
    for (const char letter : {'P', 'Z', 'I', 'J', 'K'}) {
        if (!w.given(letter)) in.fail(fmt::format("G76 needs P, Z, I, J and K: {} is missing", letter));
    }
    const double across = in.state_.unit_mm * (in.state_.diameter ? 0.5 : 1.0);  // I, J, K are diameters under G7
    const auto word = [&](char letter, double otherwise) { return w.given(letter) ? w.of(letter) : otherwise; };
    Thread thread;
    thread.begin = in.state_.position;
    thread.end = target_of(in, block, false);
    thread.crest = w.of('I') * across;
    thread.depth = w.of('K') * across;
    const double first_cut = w.of('J') * across;
    const double degression = word('R', 1);
    const double angle = word('Q', 0);
    const double springs = word('H', 0);
    const int tapers = static_cast<int>(std::clamp(word('L', 0), -1.0, 4.0));
    thread.taper = word('E', 0) * in.state_.unit_mm;
    if (!(w.of('P') > 0)) in.fail("the pitch (P) of G76 must be greater than 0");
    if (thread.crest == 0) in.fail("I of G76 must not be 0");
    if (!(first_cut > 0 && first_cut <= thread.depth)) in.fail("J of G76 must be greater than 0 and at most K");
    if (!(degression >= 1)) in.fail("R of G76 must be at least 1");
    if (!(std::abs(angle) <= steepest_slide)) in.fail("Q of G76 must be between -80 and 80");
    if (!(springs >= 0 && springs <= most_passes)) in.fail("H of G76 counts spring passes");
    if (tapers < 0 || tapers > 3) in.fail("L of G76 is 0 … 3");
    const double both = tapers == 3 ? 2 : 1;
    if (tapers != 0 && both * thread.taper > std::abs(thread.end.z() - thread.begin.z()))
        in.fail("the tapers (E) of G76 are longer than the thread");
    thread.entry_taper = (tapers & 1) != 0;
    thread.exit_taper = (tapers & 2) != 0;
    thread.slide = std::tan(angle * rad_per_deg);

    const FeedMode feed_mode = in.state_.feed_mode;
    const double feed = in.state_.feed, feed_unit = in.state_.feed_unit_mm;
    in.state_.feed_mode = FeedMode::per_revolution;
    take_feed(in.state_, in.rules_->motion, w.of('P'));
    const auto carry_out = [&](double depth) {
        for (const auto& [kind, end] : pass_at(thread, depth).moves) in.straight(kind, end, in.state_.rotary);
    };
    int passes = 0;
    for (double depth = first_cut; depth < thread.depth; depth = first_cut * std::pow(passes + 1, 1 / degression)) {
        if (++passes > most_passes) in.fail("G76 has too many passes: J is too small");
        carry_out(depth);
    }
    for (int k = 0; k <= static_cast<int>(springs); ++k) carry_out(thread.depth);
    in.straight(MotionKind::rapid, Vec3(thread.begin.x(), thread.begin.y(), thread.end.z()), in.state_.rotary);
    in.state_.feed_mode = feed_mode;
    in.state_.feed = feed;
    in.state_.feed_unit_mm = feed_unit;
}

void tap(Interpreter& in, const Vec3& end, const Vec3& rotary) {
    const Vec3 begin = in.state_.position;
    in.straight(MotionKind::feed, end, rotary);
    in.straight(MotionKind::feed, begin, rotary);
}

}  // namespace clsurf
