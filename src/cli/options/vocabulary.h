#pragma once
// Vocabulary: the words of one kind that options take as values, read from the table that defines
// them. `clsurf help fields` prints one; completion and docs/reference are made from them.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/reports/listing_json.h"

namespace clsurf::cli {

struct Vocabulary {
    std::string_view name;        ///< "dialects", the word of `clsurf help`
    std::string_view value_name;  ///< "DIALECT": options whose value has this name take these words
    std::string_view summary;     ///< one line
    std::vector<io::ListingRow> (*rows)();
};

/// All of them, in the order of the help text.
[[nodiscard]] std::span<const Vocabulary> vocabularies();

/// The words that a value name stands for: those of a vocabulary ("DIALECT"), or the lower-case
/// ones of "iso|top|AZ,EL". Empty: any text.
[[nodiscard]] std::vector<std::string> words_of(std::string_view value_name);

/// The value name lists every word that may be given: "auto|always|never".
[[nodiscard]] bool lists_all_words(std::string_view value_name);

}  // namespace clsurf::cli
