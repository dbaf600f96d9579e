#include "io/reports/listing_json.h"

#include <algorithm>

#include "io/files/json_value.h"

namespace clsurf::io {

std::string listing_json(std::string_view key, std::span<const ListingRow> rows) {
    const bool has_units =
        std::any_of(rows.begin(), rows.end(), [](const ListingRow& row) { return !row.unit.empty(); });
    Json list = Json::array();
    for (const ListingRow& row : rows) {
        Json entry;
        entry["name"] = row.name;
        if (has_units) entry["unit"] = row.unit;
        entry["summary"] = row.summary;
        list.push_back(std::move(entry));
    }
    Json object;
    object[std::string(key)] = std::move(list);
    return dump(object);
}

}  // namespace clsurf::io
