#pragma once
// Place: the input and the position in it that a finding refers to, in a form that people and editors can follow.

#include <cstdint>
#include <string>

#include "core/point.h"

namespace clsurf {

struct Place {
    enum class Kind : std::uint8_t { none, file, line, point, byte };

    std::string file;  ///< as the user named it; empty: no file
    Kind kind = Kind::none;
    std::uint64_t number = 0;  ///< line from 1, point from 0, byte from 0
    std::uint32_t column = 0;  ///< of a line, in bytes from 1; 0: the whole line
    std::string source;        ///< the source line, for the caret message; empty: none

    static Place of_file(std::string file);
    static Place of_line(std::string file, std::uint64_t line, std::uint32_t column = 0);
    static Place of_point(std::string file, PointIndex point);
    static Place of_byte(std::string file, std::uint64_t byte);

    /// "part.nc:2316:14", "run.biip: point 17", "run.biip: byte 48", "run.biip".
    [[nodiscard]] std::string text() const;
};

}  // namespace clsurf
