// Drilling cycles and hole patterns of SINUMERIK as motions, and CYCLE800.
// Facts: Siemens, SINUMERIK 840D/840Di/810D, Programming Guide "Cycles", chapters 2 and 3; SINUMERIK 840D sl, Programming
// Manual "Job Planning", CYCLE800.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "program/dialects/siemens/siemens_words.h"
#include "program/interpret/cycles.h"
#include "program/interpret/threading.h"
#include "program/interpret/tilted_plane.h"

namespace clsurf::siemens {
namespace {

constexpr double chip_break_mm = 1;  ///< back between pecks
constexpr double shallow_mm = 30;    ///< up to this depth the lead distance is the next value
constexpr double shallow_lead_mm = 0.6;
constexpr double lead_share = 50;  ///< for deeper holes: depth / 50, at most 7 mm
constexpr double most_lead_mm = 7;
constexpr int most_holes = 100'000;
constexpr std::size_t most_drill_pecks = 1'000'000;
constexpr double whole_depth = 1e-9;  ///< [mm] above the bottom, at most

/// Indices of a cycle's parameters.
constexpr std::size_t rtp = 0, rfp = 1, sdis = 2, dp = 3, dpr = 4, dtb = 5;

/// Indices of the parameters of a tapping cycle: pitch by metric size, pitch, its unit, speeds in and out.
struct TappingPlaces {
    std::size_t mpit, pit, ptab;
    std::optional<std::size_t> sst, sst1;
};
constexpr TappingPlaces rigid_tapping{.mpit = 7, .pit = 8, .ptab = 13, .sst = 10, .sst1 = 11};      ///< CYCLE84
constexpr TappingPlaces floating_tapping{.mpit = 9, .pit = 10, .ptab = 12, .sst = {}, .sst1 = {}};  ///< CYCLE840

/// Pitch of ISO metric coarse threads (ISO 261), M3 … M48 [mm]; 0: none of them.
double coarse_pitch(double size) {
    static constexpr std::pair<int, double> pitches[] = {
        {3, 0.5},  {4, 0.7},  {5, 0.8},  {6, 1},    {8, 1.25}, {10, 1.5}, {12, 1.75},
        {14, 2},   {16, 2},   {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3},   {27, 3},
        {30, 3.5}, {33, 3.5}, {36, 4},   {39, 4},   {42, 4.5}, {45, 4.5}, {48, 5}};
    const auto* found = std::find_if(std::begin(pitches), std::end(pitches),
                                     [&](const auto& row) { return row.first == std::abs(size); });
    return found == std::end(pitches) ? 0 : found->second;
}

/// The pitch as travel per revolution [mm], from the unit in _PTAB. `unit`: of the program [mm].
double pitch_in_mm(double pitch, int given_in, double unit) {
    constexpr int in_mm = 1, per_inch = 2, in_inches = 3;
    switch (given_in) {
        case in_mm: return pitch;
        case per_inch: return mm_per_inch / pitch;
        case in_inches: return pitch * mm_per_inch;
        default: return pitch * unit;
    }
}

bool drills(const std::string& name) {
    static constexpr std::string_view names[] = {"CYCLE81", "CYCLE82", "CYCLE83", "CYCLE84", "CYCLE840",
                                                 "CYCLE85", "CYCLE86", "CYCLE87", "CYCLE88", "CYCLE89"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool is_cycle(const std::string& name) {
    // Only with a number: SLOT_A is a user's own program.
    for (const std::string_view begin : {"CYCLE", "HOLES", "POCKET", "SLOT"}) {
        if (name.starts_with(begin) && name.size() > begin.size() && is_digit(name[begin.size()])) return true;
    }
    return name == "LONGHOLE";
}

/// The strokes of deep-hole drilling: the first, then each shorter by `damp`, then `damp` itself; the last two are
/// equal. If `damp` is 0, all are equal; if it is negative, each is the previous one times its magnitude.
std::vector<double> strokes(double whole, double first, double damp) {
    std::vector<double> depths;  // of each stroke's end
    double left = whole;
    double step = std::min(first, whole);
    while (left > whole_depth && depths.size() < most_drill_pecks) {
        if (damp > 0 && !depths.empty()) {
            step = step - damp > damp ? step - damp : damp;
            if (step == damp && left > damp && left <= 2 * damp) step = left / 2;
        } else if (damp < 0 && !depths.empty()) {
            step *= -damp;
            if (step < whole * 1e-3) step = left;
        }
        step = std::min(step, left);
        left -= step;
        depths.push_back(whole - left);
    }
    return depths;
}

/// Deep holes: chips are broken by short retracts, or removed by retracts to the reference plane.
void peck(Interpreter& in, double reference, double r, const std::vector<double>& depths, bool breaks_chips,
          double dwell_above, const Vec3& rotary) {
    const double whole = depths.empty() ? 0 : depths.back();
    const double lead = whole <= shallow_mm ? shallow_lead_mm : std::min(whole / lead_share, most_lead_mm);
    for (std::size_t k = 0; k < depths.size(); ++k) {
        go_to_level(in, MotionKind::feed, reference - depths[k], rotary);
        if (in.cycle_.p > 0) in.dwell(in.cycle_.p);
        if (k + 1 == depths.size()) return;
        if (breaks_chips) {
            go_to_level(in, MotionKind::feed, reference - depths[k] + chip_break_mm, rotary);
            continue;
        }
        go_to_level(in, MotionKind::rapid, r, rotary);
        if (dwell_above > 0) in.dwell(dwell_above);
        go_to_level(in, MotionKind::rapid, reference - depths[k] + lead, rotary);
    }
}

/// Down to the bottom and back to `r`, one pitch per revolution; without a pitch or a speed with the active feed.
void tap(Interpreter& in, bool rigid, const std::vector<double>& values, double bottom, double r, const Vec3& rotary) {
    const TappingPlaces& places = rigid ? rigid_tapping : floating_tapping;
    const auto value = [&](std::optional<std::size_t> k) {
        return k && *k < values.size() && !std::isnan(values[*k]) ? std::abs(values[*k]) : 0.0;
    };
    const double given = value(places.pit);
    const double pitch = given > 0 ? pitch_in_mm(given, static_cast<int>(value(places.ptab)), in.state_.unit_mm)
                                   : coarse_pitch(value(places.mpit));
    const auto or_else = [](double speed, double otherwise) { return speed > 0 ? speed : otherwise; };
    const double speed_in = or_else(value(places.sst), in.state_.spindle);
    const double speed_out = or_else(value(places.sst1), speed_in);
    const FeedMode mode = in.state_.feed_mode;
    const double feed = in.state_.feed;
    const auto go = [&](double height, double speed) {
        if (pitch > 0 && speed > 0) {
            in.state_.feed_mode = FeedMode::per_minute;
            in.state_.feed = pitch * speed / in.state_.feed_unit_mm;
        }
        go_to_level(in, MotionKind::feed, height, rotary);
    };
    go(bottom, speed_in);
    if (in.cycle_.p > 0) in.dwell(in.cycle_.p);
    go(r, speed_out);
    in.state_.feed_mode = mode;
    in.state_.feed = feed;
}

/// CYCLE81 … CYCLE89, CYCLE840: to the reference plane, down to the bottom, out and to the return plane.
void drill(Interpreter& in, const std::string& name, const std::vector<double>& values) {
    const auto value = [&](std::size_t k, double otherwise) {
        return k < values.size() && !std::isnan(values[k]) ? values[k] : otherwise;
    };
    const double unit = in.state_.unit_mm;
    const double reference = value(rfp, 0) * unit, clear = value(rtp, 0) * unit;
    const double r = reference + value(sdis, 0) * unit;
    const double relative = value(dpr, 0) * unit;
    if (relative == 0 && std::isnan(value(dp, std::numeric_limits<double>::quiet_NaN())))
        in.fail(name + " needs its depth (DP or DPR)");
    const double bottom = relative != 0 ? reference - std::abs(relative) : value(dp, 0) * unit;
    if (r < bottom) in.fail(fmt::format("{}: the reference plane ({:g}) is below the bottom ({:g})", name, r, bottom));
    const Vec3 rotary = in.state_.rotary;
    const auto seconds = [&](double dwell) {
        return dwell >= 0 || in.state_.spindle <= 0 ? std::abs(dwell) : -dwell * seconds_per_minute / in.state_.spindle;
    };
    in.cycle_.p =
        name == "CYCLE81" || name == "CYCLE87" ? 0 : seconds(value(name == "CYCLE83" ? std::size_t{8} : dtb, 0));
    const double feed = in.state_.feed;
    go_to_level(in, MotionKind::rapid, r, rotary);
    if (name == "CYCLE84" || name == "CYCLE840") {
        tap(in, name == "CYCLE84", values, bottom, r, rotary);
        go_to_level(in, MotionKind::rapid, clear, rotary);
        return;
    }
    if (name == "CYCLE83") {
        const double whole = reference - bottom;
        const double first_absolute = value(5, std::numeric_limits<double>::quiet_NaN());
        const double first = value(6, 0) != 0             ? std::abs(value(6, 0)) * unit
                             : std::isnan(first_absolute) ? whole
                                                          : reference - first_absolute * unit;
        if (!(first > 0)) in.fail("CYCLE83: the first depth (FDEP, FDPR) lies above the reference plane");
        const double damp = value(7, 0) < 0 ? value(7, 0) : value(7, 0) * unit;
        const std::vector<double> depths = strokes(whole, first, damp);
        if (depths.size() == most_drill_pecks && whole - depths.back() > whole_depth)
            in.fail("CYCLE83: too many pecks: FDEP, FDPR or DAM is too small");
        peck(in, reference, r, depths, value(11, 0) == 0, seconds(value(9, 0)), rotary);
        go_to_level(in, MotionKind::rapid, clear, rotary);
        return;
    }
    const bool feeds_out = name == "CYCLE85" || name == "CYCLE89";
    if (name == "CYCLE85" && value(6, 0) > 0) in.state_.feed = value(6, 0);
    go_to_level(in, MotionKind::feed, bottom, rotary);
    if (in.cycle_.p > 0) in.dwell(in.cycle_.p);
    if (name == "CYCLE85" && value(7, 0) > 0) in.state_.feed = value(7, 0);
    if (name == "CYCLE86") {
        Vec3 aside = Vec3::Zero();
        const int c = in.state_.plane_axis;
        aside[(c + 1) % 3] = value(7, 0) * unit;
        aside[(c + 2) % 3] = value(8, 0) * unit;
        if (!aside.isZero()) step_aside(in, aside, rotary);
        go_to_level(in, MotionKind::rapid, r, rotary);
        go_to_level(in, MotionKind::rapid, clear, rotary);
        if (!aside.isZero()) step_aside(in, -aside, rotary);
        return;
    }
    if (feeds_out) go_to_level(in, MotionKind::feed, r, rotary);
    in.state_.feed = feed;
    go_to_level(in, MotionKind::rapid, clear, rotary);
}

/// HOLES1 (row), HOLES2 (circle), CYCLE801 (grid): the modal cycle at every position.
void hole_pattern(Interpreter& in, const std::string& name, const std::vector<double>& values, std::size_t column) {
    const auto value = [&](std::size_t k) { return k < values.size() && !std::isnan(values[k]) ? values[k] : 0.0; };
    const double unit = in.state_.unit_mm;
    const Vec2 origin = Vec2(value(0), value(1)) * unit;
    const auto turned = [](double angle) { return Vec2(std::cos(angle * rad_per_deg), std::sin(angle * rad_per_deg)); };
    const auto count = [&](std::size_t k) {
        return static_cast<int>(std::clamp(value(k), 0.0, static_cast<double>(most_holes)));
    };
    std::vector<Vec2> holes;
    if (name == "HOLES1") {
        const Vec2 along = turned(value(2));
        for (int k = 0; k < count(5); ++k) holes.push_back(origin + (value(3) + k * value(4)) * unit * along);
    } else if (name == "HOLES2") {
        const int number = count(5);
        const double between = value(4) != 0 ? value(4) : 360.0 / std::max(1, number);
        for (int k = 0; k < number; ++k) holes.push_back(origin + value(2) * unit * turned(value(3) + k * between));
    } else {
        const Vec2 along = turned(value(2));
        const Vec2 across(-along.y(), along.x());
        if (static_cast<double>(count(5)) * count(6) > most_holes)
            in.fail(fmt::format("{}: more than {} holes", name, most_holes), column);
        for (int j = 0; j < count(6); ++j) {  // back and forth
            for (int i = 0; i < count(5); ++i)
                holes.push_back(origin + (j % 2 == 0 ? i : count(5) - 1 - i) * value(3) * unit * along +
                                j * value(4) * unit * across);
        }
    }
    if (holes.empty()) in.note(Severity::warning, "program.cycle", name + " has no holes", column);
    if (in.modal_call_.active && !drills(in.modal_call_.name)) {
        in.note(Severity::warning, "program.cycle", name + ": " + in.modal_call_.name + " is not called at its places",
                column);
    }
    const int c = in.state_.plane_axis;
    const Vec3 here = in.state_.programmed();
    for (const Vec2& hole : holes) {
        Vec3 end = in.state_.programmed();
        end = end.array().isNaN().select(0.0, end);
        end[(c + 1) % 3] = hole.x();
        end[(c + 2) % 3] = hole.y();
        if (std::isnan(here[c]) && !in.modal_call_.active) end[c] = here[c];
        in.straight(MotionKind::rapid, in.state_.frame.to_work(end), in.state_.rotary);
        if (in.modal_call_.active && drills(in.modal_call_.name))
            drill(in, in.modal_call_.name, in.modal_call_.arguments);
    }
}

}  // namespace

/// Returns whether the word was a cycle; it is then executed or reported.
bool cycle_keyword(Interpreter& in, const Keyword& keyword) {
    const std::string& name = keyword.name;
    if (!is_cycle(name) || name == "CYCLE800" || name == "CYCLE832") return false;
    const std::vector<std::optional<double>> given = arguments_of(in.variables_, in.rules_->text, keyword);
    std::vector<double> values;
    for (const std::optional<double>& value : given)
        values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (drills(name)) {
        drill(in, name, values);
        return true;
    }
    if (name == "HOLES1" || name == "HOLES2" || name == "CYCLE801") {
        hole_pattern(in, name, values, keyword.column);
        return true;
    }
    in.note(Severity::warning, "program.cycle", name + " is not carried out", keyword.column);
    return true;
}

/// The modal cycle or subprogram after a block that moved.
bool repeat_modal_call(Interpreter& in) {
    const ModalCall called = in.modal_call_;
    if (drills(called.name)) {
        drill(in, called.name, called.arguments);
        return true;
    }
    if (is_cycle(called.name)) {
        in.note(Severity::warning, "program.cycle", "MCALL " + called.name + ": the cycle is not carried out");
        return true;
    }
    if (!call_by_name(in, called.name, Keyword{called.name, {}, false, called.column}, 1)) {
        in.fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", called.name));
    }
    return true;
}

/// CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, …): shifts by X0 Y0 Z0, rotates by A, B and C in
/// succession about the rotated axes in the order given by MODE, shifts by X1 Y1 Z1.
void swivel(Interpreter& in, const Keyword& keyword) {
    const std::string text = "CYCLE800(" + keyword.arguments + ")";
    in.event("swivel", text);
    const std::vector<std::optional<double>> values = arguments_of(in.variables_, in.rules_->text, keyword);
    const auto value = [&](std::size_t k) { return k < values.size() ? values[k].value_or(0.0) : 0.0; };
    const bool given = keyword.arguments.find_first_not_of(" \t") != std::string::npos;
    const bool deselects = keyword.arguments.find("\"0\"") != std::string::npos;
    if (!given || deselects) {
        state_of(in).swivel = {};
        in.state_.frame = {};
        end_tilted_plane(in, text);
        return;
    }
    const auto refuse = [&](std::string_view why) {
        in.note(Severity::warning, "program.rotation",
                fmt::format("CYCLE800: {} is not carried out, the path is read as programmed", why), keyword.column);
    };
    // MODE: two bits per axis (1 X, 2 Y, 3 Z), the first one lowest, and two for the kind of angles.
    const int mode = static_cast<int>(std::clamp(value(3), 0.0, 255.0));
    if (const int kind = mode >> 6; kind != 0) {
        constexpr std::array<std::string_view, 4> kinds{"", "a solid angle", "a projection angle",
                                                        "direct positioning of the rotary axes"};
        return refuse(kinds[static_cast<std::size_t>(kind)]);
    }
    if (in.state_.plane_axis != 2) return refuse("a plane of G18 or G19");
    if (in.compensation_.path.on()) in.fail("CYCLE800 while cutter compensation is on", keyword.column);
    const auto vector = [&](std::size_t k) { return Vec3(value(k), value(k + 1), value(k + 2)); };
    ProgramFrame frame = ProgramFrame::moved(in.state_.unit_mm * vector(4));
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = (mode >> (2 * k)) & 3;
        if (axis == 0 && value(7 + k) != 0)
            in.fail(fmt::format("CYCLE800: mode {} has no axis for the angle {:g}", mode, value(7 + k)),
                    keyword.column);
        if (axis != 0) frame = frame.around(ProgramFrame::turned(Vec3::Unit(axis - 1), value(7 + k)));
    }
    frame = frame.around(ProgramFrame::moved(in.state_.unit_mm * vector(10)));
    const bool additive = std::fmod(value(2), 10) >= 1;
    state_of(in).swivel = additive ? in.state_.frame.around(frame) : frame;
    in.state_.frame = state_of(in).swivel;
    begin_tilted_plane(in, text);
    // DIR 0: the plane is set without motion, and the program turns the axes itself.
    const bool tracks_tip = std::fmod(std::floor(value(2) / 10), 10) >= 1;
    if (value(13) != 0)
        turn_to_plane(in, state_of(in).swivel.direction_to_work(Vec3::UnitZ()).normalized(), tracks_tip, text);
}

}  // namespace clsurf::siemens
