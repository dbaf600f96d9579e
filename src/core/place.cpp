#include "core/place.h"

#include <utility>

namespace clsurf {

Place Place::of_file(std::string file) {
    return {.file = std::move(file), .kind = Kind::file, .source = {}};
}
Place Place::of_line(std::string file, std::uint64_t line, std::uint32_t column) {
    return {.file = std::move(file), .kind = Kind::line, .number = line, .column = column, .source = {}};
}
Place Place::of_point(std::string file, PointIndex point) {
    return {.file = std::move(file),
            .kind = Kind::point,
            .number = static_cast<std::uint64_t>(point),
            .source = {}};
}
Place Place::of_byte(std::string file, std::uint64_t byte) {
    return {.file = std::move(file), .kind = Kind::byte, .number = byte, .source = {}};
}

std::string Place::text() const {
    switch (kind) {
        case Kind::none:
        case Kind::file: return file;
        case Kind::line: {
            std::string text = file + ":" + std::to_string(number);
            if (column > 0) text += ":" + std::to_string(column);
            return text;
        }
        case Kind::point: return file + ": point " + std::to_string(number);
        case Kind::byte: return file + ": byte " + std::to_string(number);
    }
    return file;
}

}  // namespace clsurf
