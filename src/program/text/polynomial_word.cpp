#include "program/text/polynomial_word.h"

#include "program/text/expression.h"

namespace clsurf {

PolynomialWord read_polynomial(Cursor& cursor, const Variables& variables, const TextRules& rules, std::size_t column) {
    PolynomialWord word{0, {}, column};
    cursor.take('[');
    const std::string axis = cursor.identifier();
    if (axis.size() > 1) throw ReadError{"expected an axis in PO[…]", cursor.column(), {}};
    if (!axis.empty()) {
        word.axis = axis[0];
        cursor.take_word(axis);
    }
    if (!cursor.take(']') || !cursor.take('=')) throw ReadError{"expected PO[axis]=(…)", cursor.column(), {}};
    const bool list = cursor.take('(');
    do { word.values.push_back(evaluate(cursor, variables, rules)); } while (list && cursor.take(','));
    if (list && !cursor.take(')')) throw ReadError{"'(' is not closed", cursor.column(), {}};
    return word;
}

}  // namespace clsurf
