#pragma once
// Printable cards of a page's strongest defects: picture, finding and program lines. Used inside io only.

#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// A picture with its title and text.
[[nodiscard]] std::string picture_html(const PagePicture& picture);

/// "1178–1334"; without a line "–".
[[nodiscard]] std::string lines_text(const DefectSection& section);

/// The card of a defect that has a picture, as HTML. O(lines shown).
[[nodiscard]] std::string defect_card_html(const ReportPage& page, std::size_t defect);

}  // namespace clsurf::io
