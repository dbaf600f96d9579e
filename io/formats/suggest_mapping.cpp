// Guesses what the columns of a table mean, from their titles: "Xcmd", "PosX_soll", "Time[ms]", "act.y (mm)".
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/letter_case.h"
#include "io/formats/foreign_content.h"
#include "io/formats/text_table.h"

namespace clsurf::io {
namespace {

using Words = std::vector<std::string>;

constexpr std::string_view commanded[] = {"cmd",      "com",    "command", "commanded", "soll", "set",
                                          "setpoint", "setp",   "des",     "desired",   "ref",  "reference",
                                          "nominal",  "target", "dem",     "sw"};
constexpr std::string_view feedback[] = {"fb", "fbk", "feedback", "enc", "encoder", "motor"};
constexpr std::string_view actual[] = {"act", "actual", "ist", "meas", "measured", "scale", "real", "iw"};
constexpr std::string_view position[] = {"pos", "position", "lage", "coord"};
constexpr std::string_view time_words[] = {"time", "timestamp", "t", "zeit", "clock"};
constexpr std::string_view line_words[] = {"line", "lineno", "linenumber", "zeile", "ln"};
constexpr std::string_view speed_words[] = {"f",        "feed", "feedrate", "speed",          "vel",
                                            "velocity", "v",    "vorschub", "geschwindigkeit"};
constexpr std::string_view acceleration_words[] = {"acc", "accel", "acceleration", "beschleunigung"};
constexpr std::string_view current_words[] = {"current", "strom", "amps", "cur"};
constexpr std::string_view load_words[] = {"load", "auslastung", "util"};
constexpr std::string_view torque_words[] = {"torque", "moment", "drehmoment", "trq"};
constexpr std::string_view spindle_words[] = {"spindle", "spindel", "s", "rpm", "drehzahl"};
constexpr std::string_view override_words[] = {"override", "ovr", "ovrd"};

template <std::size_t n>
bool has_any(const Words& words, const std::string_view (&list)[n]) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return std::find(std::begin(list), std::end(list), word) != std::end(list);
    });
}

bool is_axis(std::string_view word) {
    return word.size() == 1 && std::string_view("xyzabcuvw").find(word[0]) != std::string_view::npos;
}

/// "PosX_soll1" → pos, x, soll, 1: split at capitals, digits and separators.
Words words_of_title(std::string_view title) {
    Words words;
    char before = ' ';
    for (const char c : title) {
        const auto byte = static_cast<unsigned char>(c);
        const bool letter = std::isalpha(byte) != 0, digit = std::isdigit(byte) != 0;
        const bool was_lower = std::islower(static_cast<unsigned char>(before)) != 0;
        const bool was_digit = std::isdigit(static_cast<unsigned char>(before)) != 0;
        const bool was_letter = std::isalpha(static_cast<unsigned char>(before)) != 0;
        if (letter || digit) {
            const bool begins = words.empty() || !(was_letter || was_digit) || digit != was_digit ||
                                (was_lower && std::isupper(byte) != 0);
            if (begins) words.emplace_back();
            words.back() += lower_case(c);
        }
        before = c;
    }
    return words;
}

/// "xcmd" and "posx" → x and cmd, pos and x.
Words with_axes_apart(const Words& glued) {
    const auto known = [](const std::string& word) {
        const Words one{word};
        return has_any(one, commanded) || has_any(one, feedback) || has_any(one, actual) || has_any(one, position) ||
               has_any(one, speed_words) || has_any(one, acceleration_words) || has_any(one, current_words) ||
               has_any(one, load_words) || has_any(one, torque_words);
    };
    Words apart;
    for (const std::string& word : glued) {
        const std::string front = word.substr(0, 1), rest = word.substr(1);
        const std::string back = word.substr(word.size() - 1), begin = word.substr(0, word.size() - 1);
        if (word.size() > 2 && !known(word) && is_axis(front) && known(rest)) {
            apart.insert(apart.end(), {front, rest});
        } else if (word.size() > 2 && !known(word) && is_axis(back) && known(begin)) {
            apart.insert(apart.end(), {begin, back});
        } else {
            apart.push_back(word);
        }
    }
    return apart;
}

struct Guess {
    std::string name, unit, remark;
};

/// The axis of a title; '\0': none.
char axis_of(const Words& words) {
    for (const std::string& word : words) {
        if (is_axis(word)) return word[0];
    }
    // "DES_POS|1": axes by number.
    const bool numbered = has_any(words, position) || has_any(words, commanded) || has_any(words, actual);
    if (numbered && words.back().size() == 1 && words.back()[0] >= '1' && words.back()[0] <= '3')
        return static_cast<char>('x' + (words.back()[0] - '1'));
    return '\0';
}

/// Seconds or milliseconds, judged by the difference between two records.
std::string time_unit(const ForeignTable& table, std::size_t column) {
    bool bad = false;
    if (table.second.empty()) return "s";
    const double step = parse_number(table.second[column], false, bad) - parse_number(table.first[column], false, bad);
    return step > 0.1 ? "ms" : "s";
}

Guess guess_of_axis(const Words& words, char axis) {
    const bool rotary = axis >= 'a' && axis <= 'c';
    const auto of_axis = [&](std::string_view what) { return fmt::format("{}.{}", what, axis); };
    if (has_any(words, current_words)) return {of_axis("current"), "A", ""};
    if (has_any(words, torque_words)) return {of_axis("torque"), "", ""};
    if (has_any(words, load_words)) return {of_axis("load"), "%", ""};
    if (has_any(words, acceleration_words)) return {of_axis("acceleration"), "mm/s²", ""};
    if (has_any(words, speed_words)) return {of_axis("speed"), rotary ? "deg/min" : "mm/min", ""};
    const std::string unit = rotary ? "deg" : "mm";
    if (has_any(words, commanded)) return {of_axis("cmd"), unit, ""};
    if (has_any(words, feedback)) return {of_axis("fb"), unit, ""};
    if (has_any(words, actual)) return {of_axis("act"), unit, ""};
    return {of_axis("cmd"), unit, "commanded (cmd), motor encoder (fb) or scale (act)?"};
}

Guess guess_of(const ForeignTable& table, std::size_t column, const Words& words) {
    if (words.empty()) return {};
    const bool clock = !looks_like_number(table.first[column]);
    if (has_any(words, time_words) && axis_of(words) == '\0')
        return {"time", clock ? "" : time_unit(table, column), clock ? "" : "s or ms?"};
    if (has_any(words, line_words)) return {"line", "", "the line in the program file, from 1"};
    if (has_any(words, override_words)) return {"override", "%", ""};
    if (const char axis = axis_of(words); axis != '\0') return guess_of_axis(words, axis);
    if (has_any(words, spindle_words))
        return has_any(words, load_words) ? Guess{"spindle.load", "%", ""} : Guess{"spindle.speed", "1/min", ""};
    if (has_any(words, speed_words)) return {"speed", "mm/min", "mm/min or mm/s?"};
    return {};
}

std::string toml_text(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (static_cast<unsigned char>(c) >= 0x20) quoted += c;
    }
    return quoted + "\"";
}

/// A name that no other column has.
std::string own_name(const Words& words, std::size_t column, const std::set<std::string>& taken) {
    std::string name;
    for (const std::string& word : words) name += (name.empty() ? "" : "_") + word;
    if (name.empty() || taken.count(name) > 0) name += fmt::format("{}column_{}", name.empty() ? "" : "_", column);
    return name;
}

}  // namespace

std::string suggest_mapping(const ForeignTable& table, std::string_view file_name) {
    std::string text =
        fmt::format("# How to read {}: guessed from the names of its columns. Look at every line.\n[log]\n", file_name);
    text += "format = \"delimited\"\n";
    if (table.separator != ' ')
        text += fmt::format("separator = {}\n",
                            table.separator == '\t' ? "\"\\t\"" : toml_text(std::string(1, table.separator)));
    std::set<std::string> taken;
    std::string columns, left_out;
    for (std::size_t i = 0; i < table.titles.size(); ++i) {
        const std::string& title = table.titles[i];
        const ColumnPlan plan = plan_from_header(title);
        const Words words = with_axes_apart(words_of_title(plan.name.empty() ? title : plan.name));
        if (!is_value(table.first[i])) {
            left_out += fmt::format("# column {}, {}, holds words: left out\n", i, toml_text(title));
            continue;
        }
        Guess guess = guess_of(table, i, words);
        if (!plan.unit.empty()) guess.unit = plan.unit;
        if (!plan.unit.empty() && (guess.name == "time" || guess.name == "speed")) guess.remark.clear();
        const bool known = !guess.name.empty() && taken.count(guess.name) == 0;
        if (!known) guess = {own_name(words, i, taken), plan.unit, guess.name.empty() ? "" : "another " + guess.name};
        taken.insert(guess.name);
        columns += fmt::format("\n[[column]]\nfrom = {}\n", title.empty() ? std::to_string(i) : toml_text(title));
        columns +=
            fmt::format("name = {}{}\n", toml_text(guess.name), guess.remark.empty() ? "" : "  # " + guess.remark);
        if (!guess.unit.empty()) columns += fmt::format("unit = {}\n", toml_text(guess.unit));
    }
    if (taken.count("time") == 0)
        text += "period_s = 0.001  # no column of time was found: is this the sampling period?\n";
    if (taken.count("cmd.x") + taken.count("fb.x") + taken.count("act.x") == 0)
        text += "# no column of X positions was found: call it cmd.x, fb.x or act.x\n";
    return text + columns + (left_out.empty() ? "" : "\n" + left_out);
}

}  // namespace clsurf::io
