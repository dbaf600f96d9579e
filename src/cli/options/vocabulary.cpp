#include "cli/options/vocabulary.h"

#include <algorithm>
#include <array>

#include "cli/options/fields.h"
#include "history/history_quantity.h"
#include "io/formats/log_format.h"
#include "log/channel.h"
#include "program/dialect.h"
#include "viz/colour_map.h"

namespace clsurf::cli {
namespace {

std::vector<io::ListingRow> dialect_rows() {
    std::vector<io::ListingRow> rows;
    for (const Dialect& dialect : dialects()) {
        rows.push_back({std::string(dialect.name), "", std::string(dialect.summary)});
    }
    return rows;
}

std::vector<io::ListingRow> field_rows() {
    std::vector<io::ListingRow> rows;
    for (const FieldInfo& field : known_fields())
        rows.push_back({field.name, std::string(field.unit.name), field.label});
    return rows;
}

std::vector<io::ListingRow> format_rows() {
    std::vector<io::ListingRow> rows;
    for (const io::LogFormat& format : io::log_formats()) {
        rows.push_back({std::string(format.name), "", std::string(format.summary)});
    }
    return rows;
}

std::vector<io::ListingRow> channel_rows() {
    std::vector<io::ListingRow> rows;
    for (const ChannelInfo& channel : known_channels()) {
        const bool of_axis = channel.name.ends_with('.');
        std::string unit(channel.unit);
        if (!channel.rotary_unit.empty()) unit += ", " + std::string(channel.rotary_unit);
        rows.push_back({std::string(channel.name) + (of_axis ? "x" : ""), unit,
                        std::string(channel.meaning) + (of_axis ? "; likewise y, z, u, v, w, a, b, c" : "")});
    }
    return rows;
}

std::vector<io::ListingRow> colour_map_rows() {
    std::vector<io::ListingRow> rows;
    for (const viz::ColourMapInfo& map : viz::colour_maps()) {
        rows.push_back({std::string(map.name), "", std::string(map.summary)});
    }
    return rows;
}

std::vector<io::ListingRow> quantity_rows() {
    std::vector<io::ListingRow> rows;
    for (const HistoryQuantity& quantity : history_quantities()) {
        const bool of_defects = quantity.of_defects != nullptr;
        rows.push_back({std::string(quantity.name), std::string(quantity.unit),
                        std::string(quantity.label) + (of_defects ? "; also of a pass, of lines or of a cause" : "")});
    }
    return rows;
}

bool is_word(std::string_view text) {
    return !text.empty() &&
           std::none_of(text.begin(), text.end(), [](char c) { return (c >= 'A' && c <= 'Z') || c == ','; });
}

std::vector<std::string_view> alternatives_of(std::string_view value_name) {
    std::vector<std::string_view> alternatives;
    for (;;) {
        const std::size_t bar = value_name.find('|');
        alternatives.push_back(value_name.substr(0, bar));
        if (bar == std::string_view::npos) return alternatives;
        value_name.remove_prefix(bar + 1);
    }
}

}  // namespace

std::span<const Vocabulary> vocabularies() {
    static constexpr std::array table{
        Vocabulary{"fields", "FIELD",
                   "fields for colouring, plotting and export; every channel of a log is a field, too", field_rows},
        Vocabulary{"channels", "CHANNEL", "channel names that have a meaning; all other channels are kept, too",
                   channel_rows},
        Vocabulary{"formats", "FORMAT", "log formats that are recognised", format_rows},
        Vocabulary{"dialects", "DIALECT", "languages of NC programs", dialect_rows},
        Vocabulary{"colormaps", "COLORMAP", "named colour maps", colour_map_rows},
        Vocabulary{"quantities", "QUANTITY", "quantities of a run that a history can show", quantity_rows},
    };
    return table;
}

std::vector<std::string> words_of(std::string_view value_name) {
    std::vector<std::string> words;
    for (const std::string_view alternative : alternatives_of(value_name)) {
        if (value_name.find('|') != std::string_view::npos && is_word(alternative)) { words.emplace_back(alternative); }
        for (const Vocabulary& vocabulary : vocabularies()) {
            // "FIELD,…" is a list of fields.
            const std::string_view first = alternative.substr(0, alternative.find(','));
            if (vocabulary.value_name != first) continue;
            for (const io::ListingRow& row : vocabulary.rows()) words.push_back(row.name);
        }
    }
    return words;
}

bool lists_all_words(std::string_view value_name) {
    const std::vector<std::string_view> alternatives = alternatives_of(value_name);
    return alternatives.size() > 1 && std::all_of(alternatives.begin(), alternatives.end(), is_word);
}

}  // namespace clsurf::cli
