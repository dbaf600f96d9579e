#pragma once
// Lists of words that the program knows (fields, formats, dialects, colour maps) as JSON.

#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

struct ListingRow {
    std::string name;
    std::string unit;  ///< as shown; empty: none
    std::string summary;
};

/// {"KEY": [{"name": …, "unit": …, "summary": …}, …]} and a line end; no "unit" where no row has
/// one.
[[nodiscard]] std::string listing_json(std::string_view key, std::span<const ListingRow> rows);

}  // namespace clsurf::io
