#pragma once
// What a file is, if it is neither a program nor a readable log: a table with unnamed columns, a log instead
// of a program, binary data. Reported before a parser fails on it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/mapped_file.h"

namespace clsurf::io {

/// A text whose lines are records of numbers.
struct ForeignTable {
    char separator = ',';             ///< ' ': blanks
    std::vector<std::string> titles;  ///< as the file has them; empty strings where it has none
    std::vector<std::string> first;   ///< the first record
    std::vector<std::string> second;  ///< the one after it; empty: there is none
};

/// Nothing: it is no table. Looks at the head of the file only. Throws InputError: a table with control characters, which no
/// column name can help.
[[nodiscard]] std::optional<ForeignTable> recognise_table(const Source& source);

/// "8 columns: Timestamp, Xcmd, …": how messages speak of a table.
[[nodiscard]] std::string describe(const ForeignTable& table);

/// A mapping file (docs/formats/csv.md) to start from: roles and units guessed from the titles, with a comment where a
/// guess needs a look. Columns of words are left out. It can be read as it is.
[[nodiscard]] std::string suggest_mapping(const ForeignTable& table, std::string_view file_name);

/// Throws InputError where the content cannot be an NC program: a log, a table, binary data, UTF-16.
void require_program_text(const Source& source);

}  // namespace clsurf::io
