#pragma once
// Converts programs in tests to rows of motions, or to their error.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "program/interpreter.h"

namespace clsurf {

inline Program parse(const std::string& text, const char* dialect) {
    const auto kept = std::make_shared<std::string>(text);
    InterpreterOptions options;
    options.dialect = find_dialect(dialect);
    return parse_program(SourceText("test.nc", *kept, kept), options);
}

/// "kind x y z" of every motion.
inline std::vector<std::string> motions(const Program& program) {
    std::vector<std::string> all;
    static constexpr const char* kinds[] = {"rapid", "feed", "cw", "ccw", "dwell", "spline"};
    const auto number = [](double v) {
        std::string text = std::to_string(std::round(v * 1e4) / 1e4 + 0.0);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) text.pop_back();
        return text == "-0" ? std::string("0") : text;
    };
    const Motions& m = program.motions;
    for (std::size_t i = 0; i < m.kind.size(); ++i) {
        all.push_back(std::string(kinds[static_cast<int>(m.kind[i])]) + " " + number(m.end[i].x) + " " +
                      number(m.end[i].y) + " " + number(m.end[i].z));
    }
    return all;
}

using Rows = std::vector<std::string>;

inline std::string error_of(const std::string& text, const char* dialect) {
    try {
        (void)parse(text, dialect);
    } catch (const InputError& error) { return error.what(); }
    return "";
}

}  // namespace clsurf
