#pragma once
// Recognises files that are neither programs nor readable logs: a table with unnamed columns, a log instead
// of a program, binary data. They are reported before a parser fails on them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/mapped_file.h"

namespace clsurf::io {

/// A text whose lines are records of numbers.
struct ForeignTable {
    char separator = ',';             ///< ' ': blanks
    std::vector<std::string> titles;  ///< as in the file; empty strings if it has none
    std::vector<std::string> first;   ///< the first record
    std::vector<std::string> second;  ///< the second record; empty: there is none
};

/// Returns nothing if it is not a table. Reads the head of the file only. Throws InputError: a table with control characters,
/// which cannot be read with any mapping.
[[nodiscard]] std::optional<ForeignTable> recognise_table(const Source& source);

/// "8 columns: Timestamp, Xcmd, …": the description of a table in messages.
[[nodiscard]] std::string describe(const ForeignTable& table);

/// A mapping file (docs/formats/csv.md) to start from. Roles and units are guessed from the titles; uncertain guesses
/// have a comment. Columns of words are left out. The mapping is valid as it is.
[[nodiscard]] std::string suggest_mapping(const ForeignTable& table, std::string_view file_name);

/// Throws InputError if the content cannot be an NC program: a log, a table, binary data, UTF-16.
void require_program_text(const Source& source);

}  // namespace clsurf::io
