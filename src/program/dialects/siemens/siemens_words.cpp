// Facts: Siemens, SINUMERIK 840D sl, Programming Manual "Fundamentals" and "Job Planning".

#include "program/dialects/siemens/siemens_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program/interpret/codes.h"
#include "program/interpret/flow.h"
#include "program/interpret/path_modes.h"
#include "program/interpret/tangential_arc.h"
#include "program/interpret/tool_axis.h"

namespace clsurf {
namespace siemens {
namespace {

constexpr auto noted_words = std::to_array<std::string_view>({
    "MSG",     "FNORM",  "FLIN",      "FCUB",    "STOPRE",   "ORIWKS",    "ORIMKS",   "ORIAXES",    "ORIVECT",
    "ORISON",  "OTOL",   "CTOL",      "UPATH",   "SPATH",    "CDOF",      "CDOF2",    "CDON",       "CUT2D",
    "CUT2DF",  "ORISOF", "WORKPIECE", "FGROUP",  "FIFOCTRL", "STARTFIFO", "STOPFIFO", "NORM",       "KONT",
    "KONTT",   "KONTC",  "DISPLOF",   "DISPLON", "SAVE",     "SBLOF",     "SBLON",    "FFWON",      "FFWOF",
    "SOFT",    "BRISK",  "DRIVE",     "SOFTA",   "BRISKA",   "ACC",       "RTLION",   "RTLIOF",     "TOFFOF",
    "PAROTOF", "CFC",    "CFTCP",     "CFIN",    "FENDNORM", "FFWOFF",    "VELOLIM",  "GETT",       "TLPREP",
    "TOWSTD",  "TCOABS", "WALIMOF",   "WALIMON", "SPOS",     "SPCON",     "SPCOF",    "SPLINEPATH",
});
constexpr auto curve_words = std::to_array<std::string_view>({"OEMIPO1", "OEMIPO2", "INVCW", "INVCCW"});
constexpr auto spline_words = std::to_array<std::pair<std::string_view, MotionMode>>({
    {"ASPLINE", MotionMode::akima_spline},
    {"BSPLINE", MotionMode::basis_spline},
    {"CSPLINE", MotionMode::point_spline},
    {"POLY", MotionMode::polynomial},
});

std::string text_of(const Keyword& keyword) {
    return keyword.has_arguments ? keyword.name + "(" + keyword.arguments + ")" : keyword.name;
}

template <typename List, typename Value>
bool contains(const List& list, const Value& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

/// CYCLE832(tolerance, kind of machining, …): kind 0 (_OFF), or no tolerance, restores the machine's own.
void high_speed_settings(Interpreter& in, const Keyword& keyword) {
    std::vector<std::optional<double>> values;
    try {
        values = arguments_of(in.variables_, in.rules_->text, keyword);
    } catch (const ReadError& error) {
        // A variable known only to the control: no axis position depends on it.
        in.note(Severity::warning, "program.variable", error.what + ": the machine's own tolerance is used",
                error.column);
    }
    const double tolerance = values.empty() ? 0 : values[0].value_or(0) * in.state_.unit_mm;
    const double kind = values.size() > 1 ? values[1].value_or(1) : 1;
    const bool off = !(tolerance > 0) || std::fmod(std::round(kind), 10) == 0;
    state_of(in).contour_tolerance = off ? std::numeric_limits<double>::quiet_NaN() : tolerance;
    set_path_mode(in, "high-speed", "CYCLE832(" + keyword.arguments + ")",
                  {BlockEnd::rounded, state_of(in).contour_tolerance});
}

/// TRANS, ROT, SCALE and MIRROR replace the frame; with a leading A they add to it.
bool frame_keyword(Interpreter& in, const Keyword& keyword, Block& block) {
    const bool adds =
        keyword.name == "ATRANS" || keyword.name == "AROT" || keyword.name == "ASCALE" || keyword.name == "AMIRROR";
    const std::string kind = adds ? keyword.name.substr(1) : keyword.name;
    const Words& w = block.words;
    ProgramFrame frame;
    if (kind == "TRANS") {
        Vec3 by = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            if (w.given("XYZ"[k]))
                by[k] = w.of("XYZ"[k]) * in.state_.unit_mm * (k == 0 && in.state_.diameter ? 0.5 : 1.0);
        }
        frame = ProgramFrame::moved(by);
    } else if (kind == "ROT") {
        if (const std::optional<double> in_plane = block.value_of("RPL")) {
            frame = ProgramFrame::turned(Vec3::Unit(in.state_.plane_axis), *in_plane, Vec3::Zero());
        }
        // About Z, then the new Y, then the new X.
        for (const int k : {2, 1, 0}) {
            if (w.given("XYZ"[k]))
                frame = frame.around(ProgramFrame::turned(Vec3::Unit(k), w.of("XYZ"[k]), Vec3::Zero()));
        }
    } else if (kind == "SCALE" || kind == "MIRROR") {
        Vec3 factors = Vec3::Ones();
        for (int k = 0; k < 3; ++k) {
            if (w.given("XYZ"[k])) factors[k] = kind == "MIRROR" ? -1.0 : w.of("XYZ"[k]);
        }
        if ((factors.array() == 0).any()) in.fail(keyword.name + ": a factor of 0", keyword.column);
        frame = ProgramFrame::scaled(factors, Vec3::Zero());
    } else {
        return false;
    }
    in.state_.frame = adds ? in.state_.frame.around(frame) : state_of(in).swivel.around(frame);
    const std::optional<double> turned = block.value_of("RPL");
    in.event("frame",
             keyword.name + words_text(block, "XYZ") + (turned ? fmt::format(" RPL={:g}", *turned) : std::string()));
    // The words belong to the frame, not to a motion.
    in.this_block_.motion_suppressed = true;
    block.words.has &= ~Words::xyz;
    return true;
}

void start_modal_call(Interpreter& in, const Keyword& called) {
    in.modal_call_ = {.active = true,
                      .name = called.name,
                      .repeats = 1,
                      .arguments = {},
                      .level = in.calls_.frames.size(),
                      .column = called.column};
    for (const std::optional<double>& value : arguments_of(in.variables_, in.rules_->text, called)) {
        in.modal_call_.arguments.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    in.event("modal-call",
             "MCALL " + called.name + (called.has_arguments ? "(" + called.arguments + ")" : std::string()));
}

/// MCALL: what follows it in the block is called after every block that moves. True: the keyword was it, or follows it.
bool modal_keyword(Interpreter& in, const Keyword& keyword, const Block& block) {
    const auto at =
        std::find_if(block.keywords.begin(), block.keywords.end(), [](const Keyword& k) { return k.name == "MCALL"; });
    if (at == block.keywords.end()) return false;
    if (keyword.name != "MCALL") return true;
    if (at + 1 == block.keywords.end()) {
        in.modal_call_ = {};
        in.event("modal-call", "MCALL");
    } else {
        start_modal_call(in, *(at + 1));
    }
    return true;
}

/// EXTCALL "DIR/NAME.SPF"
void call_by_path(Interpreter& in, const Keyword& keyword) {
    std::string called = keyword.arguments;
    std::erase(called, '"');
    called = called.substr(called.find_last_of('/') + 1);
    if (called.starts_with("_N_")) called = called.substr(3);
    for (const std::string_view ending : {".SPF", ".spf", ".MPF", ".mpf", "_SPF", "_MPF"}) {
        if (called.ends_with(ending)) called.resize(called.size() - ending.size());
    }
    if (called.empty() || !call_by_name(in, called, Keyword{keyword.name, {}, false, keyword.column}, 1))
        in.fail(fmt::format("subprogram '{}' is neither in the program nor in its folder", called), keyword.column);
}

/// Words that set a mode. True: the keyword was one.
bool mode_keyword(Interpreter& in, const Keyword& keyword) {
    const std::string& name = keyword.name;
    if (name == "SUPA" || name == "G153") {
        in.this_block_.machine_coordinates = true;
    } else if (name == "TRAORI" || name == "TRAFOOF") {
        control_tool_centre_point(in, name == "TRAORI", text_of(keyword));
    } else if (name == "CYCLE800") {
        swivel(in, keyword);
    } else if (name == "CYCLE832") {
        high_speed_settings(in, keyword);
    } else if (name == "T=") {
        in.event("tool", "T=\"" + keyword.arguments + "\"", ToolWord{{}, keyword.arguments});
    } else if (name == "DIAMON" || name == "DIAMOF" || name == "DIAM90") {
        in.state_.diameter = name == "DIAMON";
        if (name == "DIAM90")
            in.note(Severity::warning, "program.unknown-word", "DIAM90 is read as DIAMOF", keyword.column);
        in.event("lathe", name);
    } else if (name == "CIP" || name == "CT") {
        in.state_.motion = MotionMode::cw;  // the point between or the tangent determines the direction
        in.arcs_.kind = name == "CIP" ? ArcKind::by_points : ArcKind::tangential;
    } else {
        return false;
    }
    return true;
}

/// Splines, and what holds at their ends.
bool spline_keyword(Interpreter& in, const Keyword& keyword, const Block& block) {
    const std::string& name = keyword.name;
    for (const auto& [word, mode] : spline_words) {
        if (name != word) continue;
        for (const int code : {0_g, 1_g, 2_g, 3_g}) {
            if (block.words.has_g(code))
                in.fail(fmt::format("{} and {} in one block", name, code_text(code)), keyword.column);
        }
        in.state_.motion = mode;
        in.arcs_.kind = ArcKind::usual;
        return true;
    }
    static constexpr auto ends = std::to_array<std::pair<std::string_view, SplineEnd>>(
        {{"AUTO", SplineEnd::free}, {"NAT", SplineEnd::natural}, {"TAN", SplineEnd::tangent}});
    for (const auto& [word, end] : ends) {
        if (name == "B" + std::string(word))
            in.curves_.begin = end;
        else if (name == "E" + std::string(word))
            in.curves_.end = end;
        else
            continue;
        return true;
    }
    return false;
}

/// The values in brackets of DEF REAL A[2,3]=SET(1,2,3,…): the last index runs fastest. `sizes` stands behind "[".
void set_elements(Interpreter& in, const std::string& name, Cursor sizes, Cursor& c) {
    std::vector<std::int64_t> size, index;
    do { size.push_back(std::lround(evaluate(sizes, in.variables_, in.rules_->text))); } while (sizes.take(','));
    index.resize(size.size());
    if (!c.take('(')) throw ReadError{"expected '(' after SET", c.column(), {}};
    do {
        if (index[0] >= size[0]) throw ReadError{"'" + name + "' has fewer elements", c.column(), {}};
        in.variables_.set(fmt::format("{}[{}]", name, fmt::join(index, ",")),
                          evaluate(c, in.variables_, in.rules_->text));
        std::size_t k = index.size();
        while (--k > 0 && ++index[k] >= size[k]) index[k] = 0;
        if (k == 0) ++index[0];
    } while (c.take(','));
    if (!c.take(')')) throw ReadError{"SET is not closed", c.column(), {}};
}

}  // namespace

/// G110 from the present position, G111 from the zero, G112 from the last pole.
void move_pole(Interpreter& in, int code, const Block& block) {
    in.this_block_.motion_suppressed = true;
    const Vec3 here = in.state_.programmed();
    Vec3 pole = code == 110_g   ? Vec3(here.array().isNaN().select(0.0, here))
                : code == 111_g ? Vec3(Vec3::Zero())
                                : in.polar_.pole;
    if (block.polar_radius || block.polar_angle) {
        const double radius = block.polar_radius.value_or(0) * in.state_.unit_mm;
        const double angle = block.polar_angle.value_or(0) * rad_per_deg;
        pole[(in.state_.plane_axis + 1) % 3] += radius * std::cos(angle);
        pole[(in.state_.plane_axis + 2) % 3] += radius * std::sin(angle);
    }
    for (int k = 0; k < 3; ++k) {
        if (block.words.given("XYZ"[k])) pole[k] += block.words.of("XYZ"[k]) * in.state_.unit_mm;
    }
    in.polar_.pole = pole;
    in.event("pole", fmt::format("{} {:g} {:g} {:g}", code_text(code), pole.x(), pole.y(), pole.z()));
}

/// A subprogram by its name, with arguments for the names after its PROC; false: there is none.
bool call_by_name(Interpreter& in, const std::string& name, const Keyword& keyword, int repeats) {
    const bool here = control_index(in, in.place_.file).find(ControlKind::label, name) >= 0;
    if (!here && !load_text(in, name)) return false;
    // Evaluated before the call, in the caller's variables.
    const std::vector<std::optional<double>> values = arguments_of(in.variables_, in.rules_->text, keyword);
    call_subprogram(in, name, repeats, true, {});
    in.this_block_.motion_suppressed = true;
    const SourceText& text = in.program_.files[in.place_.file];
    const LineNumber first = in.calls_.frames.back().start_line;
    for (const LineNumber line : {first, first - 1}) {
        const Statement statement = clean_line(text.line(line), in.rules_->text);
        Cursor c{statement.text, 0};
        if (!c.take_word("PROC")) continue;
        const std::string called = c.identifier();
        c.skip_blanks();
        c.at += called.size();
        std::size_t k = 0;
        if (!c.take('(')) break;
        while (c.peek() != ')' && c.peek() != '\0') {
            std::string parameter;
            for (std::string id = c.identifier(); !id.empty(); id = c.identifier()) {  // VAR REAL NAME
                parameter = id;
                c.skip_blanks();
                c.at += id.size();
            }
            double value = 0;
            if (c.take('=')) value = evaluate(c, in.variables_, in.rules_->text);
            if (k < values.size() && values[k]) value = *values[k];
            ++k;
            if (parameter.empty()) throw ReadError{"expected a name in PROC(…)", c.column(), {}};
            in.variables_.set(parameter, value);
            if (!c.take(',')) break;
        }
        break;
    }
    return true;
}

void apply_keyword(Interpreter& in, const Keyword& keyword, Block& block) {
    const std::string& name = keyword.name;
    if (spline_keyword(in, keyword, block) || mode_keyword(in, keyword) || modal_keyword(in, keyword, block)) return;
    if (frame_keyword(in, keyword, block) || cycle_keyword(in, keyword)) return;
    if (name == "EXTCALL" || name == "CALL" || name == "PCALL") return call_by_path(in, keyword);
    if (contains(curve_words, name)) {
        refuse_motion(in, name, block, keyword.column, "involutes are not supported: let the CAM system write lines");
    }
    if (contains(noted_words, name) || name.starts_with("COMP") || name.ends_with("=")) {
        in.event("mode", text_of(keyword));
        return;
    }
    const int repeats = block.words.given('P') ? static_cast<int>(std::clamp(block.words.of('P'), 1.0, 9999.0)) : 1;
    if (call_by_name(in, name, keyword, repeats)) return;
    if (name.size() == 1 && is_axis_letter(name[0])) in.fail(name + " has no value", keyword.column);
    in.note(Severity::warning, "program.unknown-word", "'" + name + "' is not known", keyword.column);
}

/// Arcs that are given by other words than I J K and R. `words` has begin, end and axis; true: centre and direction
/// are set.
bool arc_of_words(Interpreter& in, const Block& block, ArcWords& words) {
    const int u = (words.axis + 1) % 3;
    const int v = (words.axis + 2) % 3;
    if (in.arcs_.kind == ArcKind::tangential) {
        if (std::abs(words.end[words.axis] - words.begin[words.axis]) > 1e-6)
            in.fail("CT out of the plane (G17, G18, G19) is not supported");
        arc_along_tangent(in, words);
        return true;
    }
    if (in.arcs_.kind == ArcKind::by_points) {
        Vec3 between = words.begin;
        for (int k = 0; k < 3; ++k) {
            const NamedWord* word = block.find(std::string(1, "IJK"[k]) + "1");
            if (word != nullptr)
                between[k] = word->value * in.state_.unit_mm +
                             (word->increment.value_or(in.state_.incremental) ? words.begin[k] : 0.0);
        }
        const Vec2 b(between[u] - words.begin[u], between[v] - words.begin[v]);
        const Vec2 e(words.end[u] - words.begin[u], words.end[v] - words.begin[v]);
        const double area = b.x() * e.y() - b.y() * e.x();
        if (std::abs(between[words.axis] - words.begin[words.axis]) > 1e-6)
            in.fail("CIP out of the plane (G17, G18, G19) is not supported");
        if (std::abs(area) < 1e-12) in.fail("CIP: the three points lie on a line");
        const double bb = b.squaredNorm();
        const double ee = e.squaredNorm();
        words.centre = words.begin;
        words.centre[u] += (e.y() * bb - b.y() * ee) / (2 * area);
        words.centre[v] += (b.x() * ee - e.x() * bb) / (2 * area);
        words.clockwise = area < 0;
        return true;
    }
    const bool centre_given = block.words.given('I') || block.words.given('J') || block.words.given('K');
    if (const std::optional<double> opening = block.value_of("AR")) {
        const double angle = *opening * rad_per_deg;
        if (!(*opening > 0 && *opening < 360)) in.fail("AR= must be between 0 and 360 degrees");
        if (!centre_given) {  // by its ends
            const double chord = std::hypot(words.end[u] - words.begin[u], words.end[v] - words.begin[v]);
            words.has_radius = true;
            words.radius = chord / (2 * std::sin(angle / 2)) * (*opening > 180 ? -1 : 1);
            return true;
        }
        words.centre = words.begin;
        for (const int k : {u, v}) {
            if (!block.words.given("IJK"[k])) continue;
            const double value = block.words.of("IJK"[k]) * in.state_.unit_mm;
            words.centre[k] = (block.absolute & Words::bit("IJK"[k])) != 0 ? value : words.begin[k] + value;
        }
        const double sweep = words.clockwise ? -angle : angle;
        const double from_u = words.begin[u] - words.centre[u];
        const double from_v = words.begin[v] - words.centre[v];
        words.end[u] = words.centre[u] + std::cos(sweep) * from_u - std::sin(sweep) * from_v;
        words.end[v] = words.centre[v] + std::sin(sweep) * from_u + std::cos(sweep) * from_v;
        return true;
    }
    const bool about_pole = (block.polar_radius || block.polar_angle) && !centre_given && !block.words.given('R');
    if (about_pole) words.centre = in.polar_.pole;
    return about_pole;
}

/// CTOL=: of compressors and of G642 … G645; less than 0 gives the machine its own back.
void set_contour_tolerance(Interpreter& in, const Block& block) {
    const std::optional<double> value = block.value_of("CTOL");
    if (!value) return;
    state_of(in).contour_tolerance =
        *value >= 0 ? *value * in.state_.unit_mm : std::numeric_limits<double>::quiet_NaN();
    if (in.state_.path_mode.block_end == BlockEnd::rounded)
        set_path_mode(in, "path-mode", fmt::format("CTOL={:g}", *value),
                      {BlockEnd::rounded, state_of(in).contour_tolerance});
}

/// DEF REAL a, b=5: names that exist from here on.
void define_variables(Interpreter& in, const std::string& definition) {
    Cursor c{definition, 0};
    const std::string type = c.identifier();
    c.at += type.size();
    if (type == "STRING" && c.take('[')) {
        while (!c.done() && !c.take(']')) ++c.at;
    }
    while (c.peek() != '\0') {
        const std::string name = c.identifier();
        if (name.empty()) throw ReadError{"expected a name after DEF", c.column(), {}};
        c.skip_blanks();
        c.at += name.size();
        double value = 0;
        Cursor sizes = c;
        const bool array = c.take('[');  // its elements are 0
        while (array && !c.done() && !c.take(']')) ++c.at;
        if (c.take('=')) {
            if (array && (c.take_word("SET") || c.peek() == '(')) {
                sizes.take('[');
                set_elements(in, name, sizes, c);
            } else if (c.peek() == '"') {
                const std::size_t end = definition.find('"', c.at + 1);
                c.at = end == std::string::npos ? definition.size() : end + 1;
            } else {
                value = evaluate(c, in.variables_, in.rules_->text);
            }
        }
        in.variables_.set(name, value);
        if (!c.take(',')) break;
    }
}

/// Values between parentheses; nullopt: left out, or a text.
std::vector<std::optional<double>> arguments_of(const Variables& variables, const TextRules& rules,
                                                const Keyword& keyword) {
    std::vector<std::optional<double>> values;
    Cursor c{keyword.arguments, 0};
    while (keyword.has_arguments) {
        const char next = c.peek();
        if (next == '"') {
            const std::size_t end = keyword.arguments.find('"', c.at + 1);
            c.at = end == std::string::npos ? keyword.arguments.size() : end + 1;
            values.emplace_back();
        } else if (next == ',' || next == '\0') {
            values.emplace_back();
        } else {
            try {
                values.emplace_back(evaluate(c, variables, rules));
            } catch (const ReadError& error) {
                throw ReadError{keyword.name + ": " + error.what, keyword.column, error.hint};
            }
        }
        if (!c.take(',')) break;
    }
    return values;
}

}  // namespace siemens

}  // namespace clsurf
