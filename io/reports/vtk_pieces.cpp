#include "io/reports/vtk_pieces.h"

#include <filesystem>
#include <memory>
#include <string_view>

#include <expat.h>
#include <fmt/format.h>

#include "core/error.h"
#include "io/files/mapped_file.h"
#include "io/files/xml_text.h"

namespace clsurf::io {
namespace {

/// The columns of a piece, as elements of a .pvtp file.
class PieceHead {
public:
    explicit PieceHead(const Source& source) : parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        if (!parser_) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), begin, end);
        // The head is at the beginning; megabytes of data follow.
        constexpr std::size_t part = 4096;
        const std::string_view text = source.text();
        for (std::size_t at = 0; at < text.size() && !done_; at += part) {
            const std::string_view some = text.substr(at, part);
            if (XML_Parse(parser_.get(), some.data(), static_cast<int>(some.size()), 0) == XML_STATUS_ERROR && !done_)
                break;
        }
        if (!is_poly_ || !done_)
            throw InputError(Place::of_file(source.name), "is not a piece that clsurf export --shard writes");
    }

    [[nodiscard]] const std::string& columns() const { return columns_; }
    [[nodiscard]] const std::string& points() const { return points_; }

private:
    static std::string attribute(const char** attributes, std::string_view name) {
        for (; attributes[0] != nullptr; attributes += 2) {
            if (attributes[0] == name) return attributes[1];
        }
        return {};
    }

    static void begin(void* self, const char* element, const char** attributes) {
        auto& head = *static_cast<PieceHead*>(self);
        const std::string_view name = element;
        if (name == "PolyData") head.is_poly_ = true;
        if (name == "PointData" || name == "Points") head.inside_ = name;
        if (name == "AppendedData") {
            head.done_ = true;
            XML_StopParser(head.parser_.get(), XML_FALSE);
        }
        if (name != "DataArray" || head.inside_.empty()) return;
        const std::string components = attribute(attributes, "NumberOfComponents");
        (head.inside_ == "Points" ? head.points_ : head.columns_) +=
            fmt::format("      <PDataArray type=\"{}\" Name=\"{}\"{}/>\n", xml_escaped(attribute(attributes, "type")),
                        xml_escaped(attribute(attributes, "Name")),
                        components.empty() ? "" : fmt::format(" NumberOfComponents=\"{}\"", xml_escaped(components)));
    }
    static void end(void* self, const char* element) {
        auto& head = *static_cast<PieceHead*>(self);
        if (head.inside_ == element) head.inside_.clear();
    }

    std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
    std::string inside_, columns_, points_;
    bool is_poly_ = false, done_ = false;
};

/// The path of a piece, relative to the folder of the file that names it.
std::string named_from(const std::string& piece, const std::string& folder) {
    namespace fs = std::filesystem;
    const fs::path from = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
    return fs::absolute(piece).lexically_normal().lexically_relative(from).generic_string();
}

}  // namespace

std::string pvtp_text(const std::vector<std::string>& pieces, const std::string& folder) {
    std::string columns, points, sources;
    for (const std::string& piece : pieces) {
        const PieceHead head(map_file(piece));
        if (sources.empty()) {
            columns = head.columns();
            points = head.points();
        } else if (head.columns() != columns || head.points() != points) {
            throw InputError(Place::of_file(piece), "has different columns from " + pieces.front());
        }
        sources += fmt::format("    <Piece Source=\"{}\"/>\n", xml_escaped(named_from(piece, folder)));
    }
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n  <PPolyData GhostLevel=\"0\">\n    <PPointData>\n{}    </PPointData>\n"
        "    <PPoints>\n{}    </PPoints>\n{}  </PPolyData>\n</VTKFile>\n",
        columns, points, sources);
}

}  // namespace clsurf::io
