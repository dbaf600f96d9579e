#pragma once
// The nearest known word, for options, subcommands, fields, dialects, channels and file keys.

#include <span>
#include <string>
#include <string_view>

namespace clsurf {

/// The candidate with the smallest edit distance to `word` (case folded, a transposition counts one), or empty if
/// none is near enough to be meant (distance > 1/3 of the length, at least 1).
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

/// "did you mean 'speed'?", or empty.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace clsurf
