#pragma once
// The meaning of G codes that several dialects share, and words that are refused.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "program/interpret/dialect_rules.h"
#include "program/text/block.h"

namespace clsurf {

class Interpreter;

/// Handlers shared by several dialects: all numbers are inches, or millimetres.
bool count_in_inches(Interpreter& in, const CodeWord& w);
bool count_in_mm(Interpreter& in, const CodeWord& w);

/// The rows of a dialect, sorted by code.
[[nodiscard]] std::vector<CodeRule> by_code(std::span<const CodeRule> rules);

/// Refuses a word whose motion would be misread or ignored.
[[noreturn]] void refuse_motion(const Interpreter& in, const std::string& word, const Block& block, std::size_t column,
                                const std::string& hint = {});

}  // namespace clsurf
