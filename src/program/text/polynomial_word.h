#pragma once
// PO[X]=(end, a2, a3): a polynomial of siemens.

#include <vector>

#include "program/text/cursor.h"
#include "program/text/text_rules.h"
#include "program/text/variables.h"

namespace clsurf {

struct PolynomialWord {
    char axis = 0;               ///< 0: PO[], the denominator
    std::vector<double> values;  ///< as written, at least one
    std::size_t column = 0;
};

/// At the bracket after PO. Throws ReadError.
[[nodiscard]] PolynomialWord read_polynomial(Cursor& cursor, const Variables& variables, const TextRules& rules,
                                             std::size_t column);

}  // namespace clsurf
