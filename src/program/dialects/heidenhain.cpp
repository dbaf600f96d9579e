// Heidenhain DIN/ISO: frames by cycle, pole and polar motions, arcs about the pole, Q functions.
// Facts: Heidenhain, TNC 426/430 and iTNC 530, User's Manual "DIN/ISO Programming".

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

#include "core/not_finite.h"
#include "program/interpret/interpreter_state.h"

namespace clsurf {
namespace {

constexpr int q_variables = 100'000;  ///< Q5 is variable 100005
constexpr std::uint32_t ijk = Words::bit('I') | Words::bit('J') | Words::bit('K');

enum FrameKind : std::size_t { datum, mirror, rotation, scaling };

}  // namespace

/// G54, G28, G73, G72: each replaces its own earlier one; the one that was first stays outermost.
void Interpreter::set_heidenhain_frame(std::size_t kind, const ProgramFrame& frame) {
    HeidenhainFrames& f = heidenhain_frames_;
    f.frame[kind] = frame;
    std::erase(f.order, kind);
    if (frame.active()) f.order.push_back(kind);
    ProgramFrame all;
    for (const std::size_t k : f.order) all = all.around(f.frame[k]);
    state_.frame = all;
    motion_suppressed_ = true;
}

/// `%NAME G71` begins a program with its unit of measure, and ends it; `%NAME` alone calls one.
void Interpreter::heidenhain_title(const std::string& title) {
    std::istringstream words(title);
    std::string name;
    std::string unit;
    words >> name >> unit;
    const std::string_view before = program_.files[file_].text().substr(
        0, static_cast<std::size_t>(current_.data() - program_.files[file_].text().data()));
    const bool begins = before.find_first_not_of(" \t\r\n\xef\xbb\xbf") == std::string_view::npos;
    if (begins) {
        count_in_inches(unit == "G70");
        event("program", title);
    } else if (unit == "G70" || unit == "G71") {
        leave(false);
    } else {
        call(name, 1, false, {});
    }
}

/// Inch programs give the feed in tenths of an inch.
void Interpreter::count_in_inches(bool inches) {
    state_.unit_mm = inches ? mm_per_inch : 1;
    state_.feed_unit_mm = inches ? 0.1 * mm_per_inch : 1;
}

bool Interpreter::apply_heidenhain(int code, Block& block, std::size_t column) {
    const Words& w = block.words;
    const auto not_carried_out = [&](const char* what) {
        note(Severity::warning, "program.unknown-word",
             fmt::format("{} ({}) is not carried out", code_text(code), what), column);
        motion_suppressed_ = true;
        return true;
    };
    switch (code) {
        case 700: count_in_inches(true); return true;
        case 710: count_in_inches(false); return true;
        case 50:
            arc_kind_ = ArcKind::by_radius;
            state_.motion = last_clockwise_ ? MotionMode::cw : MotionMode::ccw;
            return true;
        case 60:
            arc_kind_ = ArcKind::tangential;
            state_.motion = MotionMode::cw;
            return true;
        case 160:
            arc_kind_ = ArcKind::tangential;
            state_.motion = MotionMode::cw;
            polar_line_ = true;
            return true;
        case 70: state_.motion = MotionMode::feed; return true;  // parallel to an axis
        case 0:
        case 10:
        case 20:
        case 30:
            polar_line_ = false;
            arc_kind_ = ArcKind::usual;
            return false;
        case 100:
        case 110:
            polar_line_ = true;
            state_.motion = code == 100 ? MotionMode::rapid : MotionMode::feed;
            return true;
        case 120:
        case 130:
        case 150:
            polar_line_ = true;
            arc_kind_ = ArcKind::usual;
            if (code != 150) last_clockwise_ = code == 120;
            state_.motion = last_clockwise_ ? MotionMode::cw : MotionMode::ccw;
            return true;
        case 290: {
            const Vec3 here = state_.programmed();
            polar_.pole = here.array().isNaN().select(0.0, here);
            motion_suppressed_ = true;
            event("pole", "G29");
            return true;
        }
        case 240: return not_carried_out("chamfer");
        case 250: return not_carried_out("corner rounding");
        case 260: return not_carried_out("tangential approach");
        case 270: return not_carried_out("tangential departure");
        case 280: {
            Vec3 factors = Vec3::Ones();
            for (int k = 0; k < 3; ++k) {
                if (w.given("XYZ"[k]) || take_mention("XYZ"[k], block)) factors[k] = -1;
            }
            set_heidenhain_frame(mirror, ProgramFrame::scaled(factors, Vec3::Zero()));
            event("mirror", "G28");
            return true;
        }
        case 540: {
            for (int k = 0; k < 3; ++k) {
                if (!w.given("XYZ"[k])) continue;
                const double value = w.of("XYZ"[k]) * state_.unit_mm;
                datum_[k] = state_.incremental ? datum_[k] + value : value;
            }
            set_heidenhain_frame(datum, ProgramFrame::moved(datum_));
            event("datum-shift", "G54" + words_text(block, "XYZ"));
            return true;
        }
        case 720:
            if (!w.given('F') || w.of('F') == 0) fail("G72 needs its factor (F)", column);
            set_heidenhain_frame(scaling, ProgramFrame::scaled(Vec3::Constant(w.of('F')), Vec3::Zero()));
            event("scaling", "G72" + words_text(block, "F"));
            return true;
        case 730:
            if (!w.given('H')) fail("G73 needs its angle (H)", column);
            turned_by_ = state_.incremental ? turned_by_ + w.of('H') : w.of('H');
            set_heidenhain_frame(rotation,
                                 ProgramFrame::turned(Vec3::Unit(state_.plane_axis), turned_by_, Vec3::Zero()));
            event("rotation", "G73" + words_text(block, "H"));
            return true;
        case 200: return not_carried_out("fourth axis as tool axis");
        case 530: return not_carried_out("datum table");
        case 800:
            if ((w.has & (Words::bit('A') | Words::bit('B') | Words::bit('C'))) == 0) {
                motion_suppressed_ = true;
                return true;
            }
            return not_carried_out("tilted working plane");
        case 430:
        case 440: return not_carried_out("paraxial radius compensation");
        case 300:
        case 310:
        case 360:
        case 380:
        case 390:
        case 500:
        case 510:
        case 550:
        case 990:
        case 980:
            // Blank form, spindle angle, stop, tools, probing, tool definition, labels.
            if (code == 380)
                event("stop", "G38");
            else
                event("mode", code_text(code) + words_text(block, "TLR"));
            if (code == 990 && w.given('T')) {
                Tool tool{.number = static_cast<int>(std::clamp(w.of('T'), 0.0, 1e6))};
                if (w.given('L')) tool.offset.z() = w.of('L') * state_.unit_mm;
                if (w.given('R')) tool.diameter = 2 * w.of('R') * state_.unit_mm;
                tools_.tools[tool.number] = tool;
            }
            motion_suppressed_ = true;
            block.words.has &= ~(Words::bit('T') | Words::bit('L'));
            return true;
        default: break;
    }
    const bool cycle = code == 790 || (code >= 740 && code <= 860) || (code >= 2000 && code <= 4990) ||
                       (code >= 560 && code <= 590) || code == 370 || code == 1200;
    return cycle && not_carried_out("cycle");
}

/// An axis letter that stands without a number, as in G28 X Y.
bool Interpreter::take_mention(char letter, Block& block) {
    return std::erase_if(block.unknown, [&](const UnknownWord& word) {
               return word.text.size() == 1 && upper(word.text[0]) == letter;
           }) > 0;
}

/// I J K give the pole, which stays: in the block of the arc, or before it.
void Interpreter::take_pole(const Block& block) {
    if (dialect_ != DialectId::heidenhain_iso || (block.words.has & ijk) == 0) return;
    const Vec3 here = state_.programmed();
    for (int k = 0; k < 3; ++k) {
        if (!block.words.given("IJK"[k])) continue;
        const double value = block.words.of("IJK"[k]) * state_.unit_mm;
        polar_.pole[k] = state_.incremental ? (std::isnan(here[k]) ? 0.0 : here[k]) + value : value;
    }
    const bool alone =
        (block.words.has & (Words::xyz | Words::bit('H') | Words::bit('R'))) == 0 && block.words.g_count == 0;
    if (alone) motion_suppressed_ = true;
}

bool Interpreter::arc_of_heidenhain(const Block& block, ArcWords& words) {
    if (arc_kind_ == ArcKind::tangential) {
        arc_along_tangent(words);
        return true;
    }
    last_clockwise_ = words.clockwise;
    if (block.words.given('R') && !polar_line_) return false;
    words.centre = polar_.pole;
    words.centre[words.axis] = words.begin[words.axis];
    return true;
}

/// D00 … D12: `D01 Q5 P01 +Q2 P02 3` sets Q5, D09 … D12 jump to the label of the third. True: it was one.
bool Interpreter::q_function(std::string_view text) {
    Cursor c{text, 0};
    if (upper(c.peek()) != 'D') return false;
    ++c.at;
    double code = 0;
    const std::size_t next = read_decimal(c.text, c.at, code);
    if (next == c.at) return false;
    c.at = next;
    code = std::min(code, 1e4);
    int target = -1;
    if (upper(c.peek()) == 'Q') {
        double number = 0;
        const std::size_t end = read_decimal(c.text, c.at + 1, number);
        if (end == c.at + 1) throw ReadError{"expected the number of Q", c.column(), {}};
        c.at = end;
        target = q_variables + static_cast<int>(std::clamp(number, 0.0, 9999.0));
    }
    double p[3] = {0, 0, 0};
    while (upper(c.peek()) == 'P') {
        ++c.at;
        double place = 0;
        const std::size_t end = c.at + std::min<std::size_t>(2, c.text.size() - c.at);
        (void)read_decimal(c.text.substr(0, end), c.at, place);
        c.at = end;
        if (!(place >= 1 && place <= 3)) throw ReadError{"expected P01, P02 or P03", c.column(), {}};
        p[static_cast<int>(place) - 1] = evaluate(c, variables_, dialect_);
    }
    const auto set = [&](double value) {
        if (target < 0) throw ReadError{"expected Q and its number", c.column(), {}};
        if (!std::isfinite(value)) throw ReadError{"the value is not defined", c.column(), {}};
        variables_.set(target, value);
    };
    const auto jump = [&](bool taken) {
        if (!taken) return;
        count_jump();
        const std::string label = fmt::format("{}", std::lround(p[2]));
        const int at = index(file_).find(ControlKind::sub, label);
        if (at < 0) fail(fmt::format("there is no label to go to: '{}'", label));
        go_to(file_, index(file_).all()[static_cast<std::size_t>(at)].line);
    };
    switch (static_cast<int>(code)) {
        case 0: set(p[0]); return true;
        case 1: set(p[0] + p[1]); return true;
        case 2: set(p[0] - p[1]); return true;
        case 3: set(p[0] * p[1]); return true;
        case 4:
            if (p[1] == 0) throw ReadError{"division by zero", c.column(), {}};
            set(p[0] / p[1]);
            return true;
        case 5: set(std::sqrt(p[0])); return true;
        case 6: set(std::sin(p[0] * rad_per_deg)); return true;
        case 7: set(std::cos(p[0] * rad_per_deg)); return true;
        case 8: set(std::hypot(p[0], p[1])); return true;
        case 9: jump(std::abs(p[0] - p[1]) < 1e-9); return true;
        case 10: jump(std::abs(p[0] - p[1]) >= 1e-9); return true;
        case 11: jump(p[0] > p[1]); return true;
        case 12: jump(p[0] < p[1]); return true;
        case 13: set(std::atan2(p[0], p[1]) * deg_per_rad); return true;
        default:
            note(Severity::warning, "program.unknown-word",
                 fmt::format("D{:02} is not carried out", static_cast<int>(code)), 1);
            return true;
    }
}

/// `L5,3`: back to label 5 three times; `L5,0` and `L5` call it. True: it was one.
bool Interpreter::call_label(std::string_view text) {
    Cursor c{text, 0};
    if (upper(c.peek()) != 'L') return false;
    ++c.at;
    double label = 0;
    const std::size_t next = read_decimal(c.text, c.at, label);
    if (next == c.at) return false;
    c.at = next;
    double times = 0;
    if (c.take(',')) {
        const std::size_t end = read_decimal(c.text, c.at, times);
        if (end == c.at) throw ReadError{"expected how often the label is repeated", c.column(), {}};
        c.at = end;
    }
    if (c.peek() != '\0') return false;
    const std::string name = fmt::format("{}", std::lround(std::clamp(label, 0.0, 1e6)));
    if (times < 1) {
        call(name, 1, false, {});
        return true;
    }
    const int at = index(file_).find(ControlKind::sub, name);
    if (at < 0) fail(fmt::format("there is no label to repeat: '{}'", name));
    repeat_from(index(file_).all()[static_cast<std::size_t>(at)].line + 1, times);
    return true;
}

/// Polar words of Fanuc (G16), Siemens (RP= AP=) and Heidenhain (R H), about the pole.
void Interpreter::put_about_pole(const Block& block, Vec3& end) {
    const int u = (state_.plane_axis + 1) % 3;
    const int v = (state_.plane_axis + 2) % 3;
    const double unit = state_.unit_mm;
    const Vec3 from = end.array().isNaN().select(0.0, end);
    const auto straight_axis = [&](int k) {
        const char letter = "XYZ"[k];
        if (!block.words.given(letter)) return;
        const std::uint32_t bit = Words::bit(letter);
        const bool adds = state_.incremental ? (block.absolute & bit) == 0 : (block.incremental & bit) != 0;
        end[k] = (adds ? from[k] : 0.0) + block.words.of(letter) * unit;
    };
    straight_axis(state_.plane_axis);
    if (dialect_ == DialectId::fanuc) {
        const char radius = "XYZ"[u];
        const char angle = "XYZ"[v];
        if (!block.words.given(radius) && !block.words.given(angle)) return;
        if (block.words.given(radius)) polar_.radius = block.words.of(radius) * unit;
        if (block.words.given(angle)) polar_.angle = block.words.of(angle) + (state_.incremental ? polar_.angle : 0.0);
        polar_.pole = state_.incremental ? from : Vec3(Vec3::Zero());
    } else {
        const bool siemens = dialect_ == DialectId::siemens;
        // NaN: not given.
        const auto word = [&](const std::optional<double>& of_siemens, char letter) {
            if (siemens) return of_siemens.value_or(missing<double>);
            return block.words.given(letter) ? block.words.of(letter) : missing<double>;
        };
        const double angle = word(block.polar_angle, 'H');
        const double radius = word(block.polar_radius, 'R');
        const Vec2 now(from[u] - polar_.pole[u], from[v] - polar_.pole[v]);
        // What is not given stays as it is now.
        if (!std::isnan(radius))
            polar_.radius = radius * unit + (siemens && block.polar_radius_incremental ? now.norm() : 0.0);
        else
            polar_.radius = now.norm();
        const bool adds = siemens ? block.polar_angle_incremental : state_.incremental;
        const double angle_now = angle_of(now) * deg_per_rad;
        polar_.angle = std::isnan(angle) ? angle_now : angle + (adds ? angle_now : 0.0);
    }
    end[u] = polar_.pole[u] + polar_.radius * std::cos(polar_.angle * rad_per_deg);
    end[v] = polar_.pole[v] + polar_.radius * std::sin(polar_.angle * rad_per_deg);
}

}  // namespace clsurf
