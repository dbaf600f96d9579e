#pragma once
// The pictures of a report: maps as `render` draws them.

#include <string>
#include <vector>

#include "cli/options/part.h"
#include "field/range.h"
#include "io/page/report_page.h"
#include "viz/scene.h"

namespace clsurf::cli {

/// A part as the pictures show it. All that is pointed at must outlive it.
struct PicturedPart {
    const Part* part = nullptr;
    const ClSurface* surface = nullptr;
    std::span<const Field> fields;
    std::span<const ShownRange> ranges;              ///< per field
    std::span<const std::vector<PointRange>> ramps;  ///< per field, of all points
    const QualityReport* report = nullptr;
    std::vector<viz::OutlineMark> outlines;  ///< one per defect of the report
    std::string gl;
    int shards = 0;  ///< that the map is drawn in, with the memory of one; 0: at once
};

/// The same map as `render --defects`: defects in colour on a grey surface, with their names beside it.
[[nodiscard]] io::PagePicture picture_of_defects(const PicturedPart& shown);

/// The whole part in a field, with what was found outlined.
[[nodiscard]] io::PagePicture picture_of_part(const PicturedPart& shown, const std::string& name);

/// The card of a defect.
[[nodiscard]] io::PagePicture picture_of_defect(const PicturedPart& shown, const Signals& signals, std::size_t defect);

/// A height map as the whole picture.
[[nodiscard]] io::PagePicture picture_of_relief(const PicturedPart& shown, const viz::Relief& relief,
                                                const Field& field, const ShownRange& range);

}  // namespace clsurf::cli
