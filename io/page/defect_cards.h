#pragma once
// Printable cards of a page's strongest defects: picture, finding and program lines. Used inside io only.

#include <cstddef>
#include <span>
#include <string>

#include "io/page/page_content.h"

namespace clsurf::io {

/// A picture with its title and text.
[[nodiscard]] std::string picture_html(const PagePicture& picture);

/// "1178–1334"; without a line "–".
[[nodiscard]] std::string lines_text(const DefectSection& section);

/// At most `most` of the sections, as `text_of` describes them, and the number of the others: "12–20, 31–40 and 3 more".
[[nodiscard]] std::string list_of_sections(std::span<const DefectSection> sections, std::size_t most,
                                           std::string (*text_of)(const DefectSection&));

/// The card of a defect that has a picture, as HTML. O(lines shown).
[[nodiscard]] std::string defect_card_html(const ReportPage& page, std::size_t defect);

}  // namespace clsurf::io
