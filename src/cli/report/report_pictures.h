#pragma once
// The pictures of a report: maps like those of `render`.

#include <string>
#include <vector>

#include "cli/options/part.h"
#include "field/range.h"
#include "io/page/report_page.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// A part for the pictures. Everything that it points to must outlive it.
struct PicturedPart {
    const Part* part = nullptr;
    const ClSurface* surface = nullptr;
    std::span<const Field> fields;
    std::span<const ShownRange> ranges;              ///< per field
    std::span<const std::vector<PointRange>> ramps;  ///< per field, of all points
    const QualityReport* report = nullptr;
    std::vector<viz::OutlineMark> outlines;  ///< one per defect of the report
    std::string gl;
    int shards = 0;  ///< number of shards for drawing, in the memory of one; 0: undivided
};

/// The map of `render --defects`: defects in colour on a grey surface, with their names next to it.
[[nodiscard]] io::PagePicture picture_of_defects(const PicturedPart& shown);

/// The whole part coloured by a field, with outlines of the findings.
[[nodiscard]] io::PagePicture picture_of_part(const PicturedPart& shown, const std::string& name);

/// The card of a defect.
[[nodiscard]] io::PagePicture picture_of_defect(const PicturedPart& shown, const Signals& signals, std::size_t defect);

/// A height map that fills the picture.
[[nodiscard]] io::PagePicture picture_of_height_map(const PicturedPart& shown, const viz::HeightMap& height_map,
                                                    const Field& field, const ShownRange& range);

}  // namespace clsurf::cli
