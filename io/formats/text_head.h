#pragma once
// The head of a text log: comments, the line that names the columns, the line of their units.
// Used inside io only.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/text_table.h"

namespace clsurf::io {

struct TextHead {
    char separator = ',';
    bool named = false;               ///< a line names the columns
    std::vector<std::string> titles;  ///< column titles as in the text; empty strings if there are none
    std::vector<ColumnPlan> columns;  ///< names and units from the titles and the line of units
    std::vector<std::string> first;   ///< fields of the first record; empty: there is none
    std::size_t data_begin = 0;       ///< byte of the first record
    std::uint64_t first_data_line = 1;
    std::uint64_t line =
        1;  ///< number of the line that names the columns, otherwise of the first line that is not a comment
};

/// `separator` '\0': detected. The names are in the first line that is not a comment. If that line is a record,
/// they are in the comment above it (`# time x y z`, as NumPy writes it).
[[nodiscard]] TextHead read_head(std::string_view text, char separator = '\0');

}  // namespace clsurf::io
