#pragma once
// Vocabulary: the values that options of one kind accept, from the table that defines
// them. `clsurf help fields` prints one; completion and docs/reference are generated from them.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/reports/listing_json.h"

namespace clsurf::cli {

struct Vocabulary {
    std::string_view name;        ///< "dialects", the argument of `clsurf help`
    std::string_view value_name;  ///< "DIALECT": options with this value name accept these words
    std::string_view summary;     ///< one line
    std::vector<io::ListingRow> (*rows)();
};

/// All vocabularies, in the order of the help text.
[[nodiscard]] std::span<const Vocabulary> vocabularies();

/// The words for a value name: those of a vocabulary ("DIALECT"), or the lower-case
/// ones of "iso|top|AZ,EL". Empty: any text.
[[nodiscard]] std::vector<std::string> words_of(std::string_view value_name);

/// Whether the value name lists every allowed word: "auto|always|never".
[[nodiscard]] bool lists_all_words(std::string_view value_name);

}  // namespace clsurf::cli
