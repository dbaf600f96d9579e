#include "core/place.h"

#include <fmt/format.h>

#include <utility>

namespace clsurf {

Place Place::of_file(std::string file) { return {.file = std::move(file), .kind = Kind::file, .source = {}}; }
Place Place::of_line(std::string file, std::uint64_t line, std::uint32_t column) {
    return {.file = std::move(file), .kind = Kind::line, .number = line, .column = column, .source = {}};
}
Place Place::of_point(std::string file, PointIndex point) {
    return {.file = std::move(file), .kind = Kind::point, .number = static_cast<std::uint64_t>(point), .source = {}};
}
Place Place::of_byte(std::string file, std::uint64_t byte) {
    return {.file = std::move(file), .kind = Kind::byte, .number = byte, .source = {}};
}

std::string Place::text() const {
    switch (kind) {
        case Kind::none:
        case Kind::file: return file;
        case Kind::line:
            return column > 0 ? fmt::format("{}:{}:{}", file, number, column) : fmt::format("{}:{}", file, number);
        case Kind::point: return fmt::format("{}: point {}", file, number);
        case Kind::byte: return fmt::format("{}: byte {}", file, number);
    }
    return file;
}

}  // namespace clsurf
