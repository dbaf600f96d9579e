// Cycles of Klartext that change settings (datum, rotation, mirror, scale, tolerance), tilted planes, tool centre
// point. Facts: HEIDENHAIN, TNC 620, "Cycle Programming": cycles 7 … 11, 26, 32, 247; "Multiple-Axis Machining":
// PLANE.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "program/dialects/heidenhain/heidenhain_codes.h"
#include "program/dialects/klartext/klartext.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tilted_plane.h"
#include "program/interpret/tool_axis.h"

namespace clsurf::klartext {
namespace {

using Part = OrderedFrames::Part;

constexpr double least_vector = 1e-9;  ///< of the base vector, across the normal

/// "X", "IX" and similar words at the cursor: the axis, −1: none, and whether it is an increment.
int axis_at(Cursor& c, bool& incremental) {
    c.skip_blanks();
    const auto letter = [&](std::size_t ahead) {
        return c.at + ahead < c.text.size() ? upper(c.text[c.at + ahead]) : '\0';
    };
    incremental = letter(0) == 'I';
    const char name = letter(incremental ? 1 : 0);
    if (name < 'X' || name > 'Z') return -1;
    c.at += incremental ? 2 : 1;
    return name - 'X';
}

void expect_end(Line& line) {
    if (line.c.peek() != '\0')
        throw ReadError{std::string("found '") + line.c.peek() + "' after the words of the cycle", line.c.column(), {}};
}

/// CYCL DEF 7.1 X+60, 7.2 IY+5; 7.1 #5 is a row of a table that is not available.
void shift_datum(Line& line) {
    Interpreter& in = line.in;
    if (line.c.peek() == '#') {
        in.note(Severity::warning, "program.frame", "a datum table is not supported: positions are read as programmed",
                line.c.column());
        return;
    }
    bool any = false;
    while (line.c.peek() != '\0') {
        bool adds = false;
        const int k = axis_at(line.c, adds);
        if (k < 0) throw ReadError{"expected X, Y or Z of the datum", line.c.column(), {}};
        const double value = line.value() * in.state_.unit_mm;
        heidenhain_state(in).datum[k] = adds ? heidenhain_state(in).datum[k] + value : value;
        any = true;
    }
    if (!any) return;
    set_frame_part(in, Part::datum, ProgramFrame::moved(heidenhain_state(in).datum));
    in.event("datum-shift", fmt::format("CYCL DEF 7 X{:g} Y{:g} Z{:g}", heidenhain_state(in).datum.x(),
                                        heidenhain_state(in).datum.y(), heidenhain_state(in).datum.z()));
}

void mirror(Line& line) {
    Vec3 factors = Vec3::Ones();
    while (line.c.peek() != '\0') {
        bool adds = false;
        const int k = axis_at(line.c, adds);
        if (k < 0) throw ReadError{"expected the axes to mirror", line.c.column(), {}};
        factors[k] = -1;
    }
    set_frame_part(line.in, Part::mirror, ProgramFrame::scaled(factors, Vec3::Zero()));
    line.in.event("mirror", "CYCL DEF 8");
}

/// CYCL DEF 10.1 ROT+30; IROT+30 is added to the rotation that is active.
void rotate(Line& line) {
    Interpreter& in = line.in;
    const bool adds = line.c.peek() == 'I';
    if (adds) ++line.c.at;
    if (!line.c.text.substr(line.c.at).starts_with("ROT"))
        throw ReadError{"expected ROT or IROT and the angle", line.c.column(), {}};
    line.c.at += 3;
    const double angle = line.value();
    expect_end(line);
    heidenhain_state(in).turned_by = adds ? heidenhain_state(in).turned_by + angle : angle;
    set_frame_part(
        in, Part::rotation,
        ProgramFrame::turned(Vec3::Unit(in.state_.plane_axis), heidenhain_state(in).turned_by, Vec3::Zero()));
    in.event("rotation", fmt::format("CYCL DEF 10 ROT{:+g}", heidenhain_state(in).turned_by));
}

void scale(Line& line) {
    const std::size_t column = line.c.column();
    if (!line.c.text.substr(line.c.at).starts_with("SCL")) throw ReadError{"expected SCL and the factor", column, {}};
    line.c.at += 3;
    const double factor = line.value();
    expect_end(line);
    if (factor == 0) throw ReadError{"a factor of 0", column, {}};
    set_frame_part(line.in, Part::scaling, ProgramFrame::scaled(Vec3::Constant(factor), Vec3::Zero()));
    line.in.event("scaling", fmt::format("CYCL DEF 11 SCL{:g}", factor));
}

/// CYCL DEF 26.1 X1.4 Y0.6 CCX+15 CCY+20
void scale_by_axis(Line& line) {
    Vec3 factors = Vec3::Ones();
    Vec3 centre = Vec3::Zero();
    while (line.c.peek() != '\0') {
        const std::size_t column = line.c.column();
        const bool of_centre = line.c.text.substr(line.c.at).starts_with("CC");
        if (of_centre) line.c.at += 2;
        bool adds = false;
        const int k = axis_at(line.c, adds);
        if (k < 0) throw ReadError{"expected X, Y, Z, CCX, CCY or CCZ", column, {}};
        const double value = line.value();
        if (!of_centre && value == 0) throw ReadError{"a factor of 0", column, {}};
        (of_centre ? centre : factors)[k] = of_centre ? value * line.in.state_.unit_mm : value;
    }
    set_frame_part(line.in, Part::scaling, ProgramFrame::scaled(factors, centre));
    line.in.event("scaling", fmt::format("CYCL DEF 26 X{:g} Y{:g} Z{:g}", factors.x(), factors.y(), factors.z()));
}

/// CYCL DEF 9.1 DWELL 1.5, V.ZEIT 1.5: the word is in the control's language.
void dwell(Line& line) {
    Cursor& c = line.c;
    if (is_letter(c.peek()) && upper(c.peek()) != 'Q')
        c.at = std::min(c.text.find_first_of(" +0123456789", c.at), c.text.size());
    line.in.dwell(line.value());
}

/// 32.1 T0.05, 32.2 HSC-MODE:1 TA3: without T the machine's own tolerance is active again.
void set_tolerance(Line& line, int step) {
    Interpreter& in = line.in;
    const std::string words(line.c.text.substr(line.c.at));
    if (step == 1) {
        heidenhain_state(in).contour_tolerance = std::numeric_limits<double>::quiet_NaN();
        if (line.c.peek() == 'T' || line.c.peek() == 't') {
            const std::size_t column = line.c.column();
            ++line.c.at;
            const double tolerance = line.value() * in.state_.unit_mm;
            if (tolerance < 0) throw ReadError{"a tolerance below 0", column, {}};
            if (tolerance > 0) heidenhain_state(in).contour_tolerance = tolerance;
        }
        expect_end(line);
    } else if (!line.c.text.substr(line.c.at).starts_with("HSC-MODE") && line.c.peek() != 'T') {
        throw ReadError{"expected HSC-MODE or TA", line.c.column(), {}};
    }
    set_path_mode(in, "path-mode", fmt::format("CYCL DEF 32.{} {}", step, words),
                  {BlockEnd::rounded, heidenhain_state(in).contour_tolerance});
}

void refuse_working_plane(Line& line) {
    bool turned = false;
    while (line.c.peek() != '\0') {
        ++line.c.at;
        turned = line.value() != 0 || turned;
    }
    if (turned)
        line.in.fail("CYCL DEF 19 (working plane) is not supported", line.start + 1,
                     "let the CAM system write PLANE SPATIAL");
}

/// The value of a word like "SPA+45", anywhere after the name of the PLANE function; 0 if there is none.
double plane_value(Line& line, std::string_view name, bool needed) {
    const auto begins_value = [](char c) { return is_digit(c) || c == '+' || c == '-' || c == 'Q'; };
    const std::string word = " " + std::string(name);
    std::size_t at = line.c.text.find(word, line.c.at);
    // PLANE SPATIAL also begins with SPA.
    while (at < line.c.text.size() &&
           !(at + word.size() < line.c.text.size() && begins_value(line.c.text[at + word.size()])))
        at = line.c.text.find(word, at + 1);
    if (at == std::string_view::npos) {
        if (needed) throw ReadError{"expected " + std::string(name), line.c.column(), {}};
        return 0;
    }
    Cursor value{line.c.text, at + 1 + name.size()};
    return read_klartext_value(value, line.in.variables_, line.in.rules_->text);
}

ProgramFrame turned_about(int axis, double degrees) {
    return ProgramFrame::turned(Vec3::Unit(axis), degrees, Vec3::Zero());
}

/// The plane's X and Z as given; Z is made perpendicular to X.
ProgramFrame plane_of_vectors(Line& line) {
    const auto vector = [&](std::array<std::string_view, 3> names) {
        return Vec3(plane_value(line, names[0], true), plane_value(line, names[1], true),
                    plane_value(line, names[2], true));
    };
    const Vec3 normal = vector({"NX", "NY", "NZ"});
    const Vec3 base = vector({"BX", "BY", "BZ"});
    const Vec3 across = base - base.dot(normal) / normal.squaredNorm() * normal;
    if (!(normal.norm() > 0 && across.norm() > least_vector * base.norm()))
        line.in.fail("PLANE VECTOR: normal and base vector give no plane", line.start + 1);
    Eigen::Matrix3d turn;
    turn.col(0) = across.normalized();
    turn.col(2) = normal.normalized();
    turn.col(1) = turn.col(2).cross(turn.col(0));
    const Eigen::AngleAxisd rotation(turn);
    return ProgramFrame::turned(rotation.axis(), rotation.angle() * deg_per_rad, Vec3::Zero());
}

void reset_plane(Line& line) {
    set_frame_part(line.in, Part::tilt, {});
    end_tilted_plane(line.in, "PLANE RESET");
}

}  // namespace

void define_cycle(Line& line) {
    Interpreter& in = line.in;
    line.c.skip_blanks();
    const std::size_t column = line.c.column();
    double number = 0;
    const std::size_t next = read_decimal(line.c.text, line.c.at, number);
    if (next == line.c.at) throw ReadError{"expected the number of the cycle", column, {}};
    line.c.at = next;
    const int cycle = static_cast<int>(std::min(number, 1e4));
    const int step = static_cast<int>(std::lround(std::min(number - cycle, 1.0) * 10));
    const bool of_steps = cycle < 200;
    line.c.skip_blanks();
    if (of_steps && step == 0) return;  // its name
    if (of_steps && in.compensation_.path.on() && cycle != 9 && cycle != 32)
        in.fail("a frame cannot change under RL or RR", column);
    switch (cycle) {
        case 7: return shift_datum(line);
        case 8: return mirror(line);
        case 9: return dwell(line);
        case 10: return rotate(line);
        case 11: return scale(line);
        case 19: return refuse_working_plane(line);
        case 26: return scale_by_axis(line);
        case 32: return set_tolerance(line, step);
        case 247: in.event("work-system", "CYCL DEF 247"); return;
        default: in.event("mode", fmt::format("CYCL DEF {:g}", number)); return;
    }
}

void note_cycle(Interpreter& in, const std::string& what, std::size_t column) {
    in.note(Severity::warning, "program.cycle", what + ": the cycle is not carried out", column);
}

void call_cycle(Line& line) { note_cycle(line.in, "CYCL CALL", line.start + 1); }

/// PLANE SPATIAL rotates about the fixed axes X, Y and Z, in this order.
void tilt_plane(Line& line) {
    Interpreter& in = line.in;
    const std::string form = line.c.identifier();
    if (in.compensation_.path.on()) in.fail("PLANE under RL or RR", line.start + 1);
    if (form == "RESET") return reset_plane(line);
    if (in.state_.plane_axis != 2) in.fail("PLANE is read with the tool axis Z", line.start + 1);
    ProgramFrame frame;
    if (form == "SPATIAL") {
        frame = turned_about(2, plane_value(line, "SPC", true))
                    .around(turned_about(1, plane_value(line, "SPB", true)))
                    .around(turned_about(0, plane_value(line, "SPA", true)));
    } else if (form == "EULER") {
        frame = turned_about(2, plane_value(line, "EULPR", true))
                    .around(turned_about(0, plane_value(line, "EULNUT", true)))
                    .around(turned_about(2, plane_value(line, "EULROT", true)));
    } else if (form == "VECTOR") {
        frame = plane_of_vectors(line);
    } else {
        in.fail("PLANE " + form + " is not supported", line.start + 1, "SPATIAL, VECTOR, EULER and RESET are");
    }
    const std::string text(line.c.text.substr(line.start));
    set_frame_part(in, Part::tilt, frame);
    in.event("rotation", text);
    begin_tilted_plane(in, text);
    const bool moves = text.find(" MOVE") != std::string::npos;
    const bool turns = text.find(" TURN") != std::string::npos;
    if (moves || turns) turn_to_plane(in, in.state_.frame.direction_to_work(Vec3::UnitZ()).normalized(), moves, text);
}

void start_tool_centre_point(Line& line) {
    control_tool_centre_point(line.in, true, "M128 by " + std::string(line.c.text.substr(line.start)));
}

void end_tool_centre_point(Line& line) { control_tool_centre_point(line.in, false, "FUNCTION RESET TCPM"); }

/// TRANS DATUM AXIS X+10 Y+5, TRANS DATUM RESET
void shift_datum_by_axis(Line& line) {
    if (line.c.take_word("AXIS")) return shift_datum(line);
    Interpreter& in = line.in;
    if (!line.c.take_word("RESET")) {
        in.note(Severity::warning, "program.frame", "a datum table is not supported: positions are read as programmed",
                line.c.column());
        return;
    }
    heidenhain_state(in).datum = Vec3::Zero();
    set_frame_part(in, Part::datum, {});
    in.event("datum-shift", "TRANS DATUM RESET");
}

}  // namespace clsurf::klartext
