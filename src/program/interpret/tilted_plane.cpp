// Tilted planes: CYCLE800 of Siemens, G68.2 with G53.1 of Fanuc. The program then counts in a plane of the
// workpiece that the tool stands on upright: a frame turns its positions, they are those of the tip, and the tool
// axis is a vector, the plane's normal. Which angles give that is for the machine's kinematics to say.
//
// Facts: Siemens, SINUMERIK 840D sl, programming manual "Job Planning", CYCLE800; Fanuc, operator's manual of the
// series 30i (B-63944EN), "Tilted working plane indexing".

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "program/interpret/interpreter_state.h"
#include "program/tool_centre_point.h"

namespace clsurf {
namespace {

ProgramFrame turned_about(int axis, double degrees) {
    return ProgramFrame::turned(Vec3::Unit(axis), degrees, Vec3::Zero());
}

}  // namespace

void Interpreter::begin_tilted_plane(const std::string& text) {
    five_axis_.tilted = true;
    state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
    event("tool-centre-point", std::string(tilted_plane) + text);
}

void Interpreter::end_tilted_plane(const std::string& text) {
    if (!five_axis_.tilted) return;
    five_axis_.tilted = false;
    state_.tool_axis.setConstant(std::numeric_limits<double>::quiet_NaN());
    event("tool-centre-point", five_axis_.tool_centre_point ? five_axis_.switched_on_by : text);
}

/// The rotary axes turn until the tool stands upright on the plane; the others stand still meanwhile, or
/// keep the tip where it is.
void Interpreter::turn_to_plane(const Vec3& axis, bool keeps_tip, const std::string& text) {
    state_.tool_axis = axis;
    if (state_.position.array().isNaN().any()) return;  // the first motion turns them
    if (!keeps_tip) event("tool-centre-point", text);
    push(MotionKind::rapid, tool_position(), state_.rotary, std::numeric_limits<float>::quiet_NaN());
    if (!keeps_tip) event("tool-centre-point", std::string(tilted_plane) + text);
}

/// CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, …): moved by X0 Y0 Z0, turned by A, B and C about
/// the axes that MODE names, one after the other, each about the axis where it is then, moved by X1 Y1 Z1.
void Interpreter::swivel(const Keyword& keyword) {
    const std::string text = "CYCLE800(" + keyword.arguments + ")";
    event("swivel", text);
    const std::vector<std::optional<double>> values = arguments_of(keyword);
    const auto value = [&](std::size_t k) { return k < values.size() ? values[k].value_or(0.0) : 0.0; };
    const bool given = keyword.arguments.find_first_not_of(" \t") != std::string::npos;
    const bool deselects = keyword.arguments.find("\"0\"") != std::string::npos;
    if (!given || deselects) {
        frames_.swivel = {};
        state_.frame = {};
        end_tilted_plane(text);
        return;
    }
    const auto refuse = [&](std::string_view why) {
        note(Severity::warning, "program.rotation",
             fmt::format("CYCLE800: {} is not carried out, the path is read as programmed", why), keyword.column);
    };
    // MODE: two bits an axis (1 X, 2 Y, 3 Z), the first one lowest, and two for the kind of angles.
    const int mode = static_cast<int>(std::clamp(value(3), 0.0, 255.0));
    if (const int kind = mode >> 6; kind != 0) {
        constexpr std::array<std::string_view, 4> kinds{"", "a solid angle", "a projection angle",
                                                        "direct positioning of the rotary axes"};
        return refuse(kinds[static_cast<std::size_t>(kind)]);
    }
    if (state_.plane_axis != 2) return refuse("a plane of G18 or G19");
    if (compensation_.path.on()) fail("CYCLE800 while cutter compensation is on", keyword.column);
    const auto vector = [&](std::size_t k) { return Vec3(value(k), value(k + 1), value(k + 2)); };
    ProgramFrame frame = ProgramFrame::moved(state_.unit_mm * vector(4));
    for (std::size_t k = 0; k < 3; ++k) {
        const int axis = (mode >> (2 * k)) & 3;
        if (axis == 0 && value(7 + k) != 0)
            fail(fmt::format("CYCLE800: mode {} has no axis for the angle {:g}", mode, value(7 + k)), keyword.column);
        if (axis != 0) frame = frame.around(turned_about(axis - 1, value(7 + k)));
    }
    frame = frame.around(ProgramFrame::moved(state_.unit_mm * vector(10)));
    const bool additive = std::fmod(value(2), 10) >= 1;
    frames_.swivel = additive ? state_.frame.around(frame) : frame;
    state_.frame = frames_.swivel;
    begin_tilted_plane(text);
    // DIR 0: the plane is set, and the program turns the axes itself.
    const bool tracks_tip = std::fmod(std::floor(value(2) / 10), 10) >= 1;
    if (value(13) != 0) turn_to_plane(frames_.swivel.direction_to_work(Vec3::UnitZ()).normalized(), tracks_tip, text);
}

/// G68.2 X Y Z I J K: the plane's zero and its Euler angles, about Z, the new X and the new Z; with P1 Q the angles
/// are those about X, Y and Z of the work system, in the order that Q tells.
void Interpreter::tilt_plane(const Block& block, std::size_t column) {
    this_block_.motion_suppressed = true;
    const Words& w = block.words;
    const auto refuse = [&](const std::string& what) {
        note(Severity::warning, "program.rotation",
             what + ": this tilted plane is not carried out, the path is read as programmed", column);
    };
    const int form = w.given('P') ? static_cast<int>(std::clamp(w.of('P'), 0.0, 99.0)) : 0;
    if (form > 1) return refuse(fmt::format("G68.2 P{}", form));
    if (state_.plane_axis != 2) return refuse("G68.2 in G18 or G19");
    if (compensation_.path.on()) fail("G68.2 while cutter compensation is on", column);
    const auto words = [&](const char* letters) {
        Vec3 v = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            if (w.given(letters[k])) v[k] = w.of(letters[k]);
        }
        return v;
    };
    const Vec3 angles = words("IJK");
    ProgramFrame turn;
    if (form == 0) {
        turn = turned_about(2, angles[0]).around(turned_about(0, angles[1])).around(turned_about(2, angles[2]));
    } else {
        const int order = w.given('Q') ? static_cast<int>(std::clamp(w.of('Q'), 0.0, 999.0)) : 123;
        const std::array<int, 3> axes{order / 100 - 1, order / 10 % 10 - 1, order % 10 - 1};
        std::array<bool, 3> named{};
        for (const int axis : axes) {
            if (axis >= 0 && axis < 3) named[static_cast<std::size_t>(axis)] = true;
        }
        if (!(named[0] && named[1] && named[2]))
            fail(fmt::format("G68.2 P1: Q{} is not a permutation of 1, 2 and 3", order), column);
        for (const int axis : axes) turn = turned_about(axis, angles[axis]).around(turn);
    }
    frames_.fanuc.rotation = ProgramFrame::moved(state_.unit_mm * words("XYZ")).around(turn);
    frames_.fanuc.angle = 0;
    state_.frame = frames_.fanuc.all();
    const std::string text = "G68.2" + words_text(block, "PQXYZIJK");
    event("rotation", text);
    begin_tilted_plane(text);
}

}  // namespace clsurf
