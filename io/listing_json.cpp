#include "io/listing_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace clsurf::io {

std::string listing_json(std::string_view key, std::span<const ListingRow> rows) {
    const bool has_units =
        std::any_of(rows.begin(), rows.end(), [](const ListingRow& row) { return !row.unit.empty(); });
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ListingRow& row : rows) {
        nlohmann::ordered_json entry;
        entry["name"] = row.name;
        if (has_units) entry["unit"] = row.unit;
        entry["summary"] = row.summary;
        list.push_back(std::move(entry));
    }
    nlohmann::ordered_json object;
    object[std::string(key)] = std::move(list);
    return object.dump(2) + "\n";
}

}  // namespace clsurf::io
