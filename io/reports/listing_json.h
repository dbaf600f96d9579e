#pragma once
// Lists of names in the program (fields, formats, dialects, colour maps) as JSON.

#include <span>
#include <string>
#include <string_view>

namespace clsurf::io {

struct ListingRow {
    std::string name;
    std::string unit;  ///< as shown; empty: none
    std::string summary;
};

/// {"KEY": [{"name": …, "unit": …, "summary": …}, …]} and a line end; without "unit" if no row has
/// one.
[[nodiscard]] std::string listing_json(std::string_view key, std::span<const ListingRow> rows);

}  // namespace clsurf::io
