#pragma once
// The words of a Klartext block: "L X+10 IY-2.5 R0 FMAX M3". In Klartext a statement comes first, then words, some of
// several letters (DR+, PA+30, NX-0.5), with a decimal point or comma, or a Q parameter for a number.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program/text/cursor.h"
#include "program/text/text_rules.h"
#include "program/text/variables.h"

namespace clsurf {

struct Words;
enum class PlainResult : std::uint8_t;

struct KlartextValue {
    double value = 0;
    bool incremental = false;  ///< IX, IPA
    std::size_t column = 0;
};

/// Feed of a block: nothing, a number, FMAX, or that of TOOL CALL.
enum class KlartextFeed : std::uint8_t { none, number, rapid, automatic };

/// Radius compensation of a block.
enum class KlartextSide : std::uint8_t { unchanged, none, left, right };

struct KlartextWords {
    std::vector<std::pair<std::string, KlartextValue>> values;  ///< by name, without I: "X", "PA", "NX", "R"
    KlartextFeed feed = KlartextFeed::none;
    double feed_value = 0;
    KlartextSide side = KlartextSide::unchanged;
    std::optional<bool> clockwise;  ///< DR-; false: DR+
    std::vector<int> m;
    std::optional<KlartextValue> retract;  ///< M140 MB; infinite: MB MAX
    bool reads_plane_angles = false;       ///< A+Q120, B+Q121, C+Q122

    [[nodiscard]] const KlartextValue* find(std::string_view name) const;
};

/// Reads to the end of the block. `radius_word`: R is a value (CR, RND), not compensation. `variables` and `rules` give Q
/// parameters. Throws ReadError with the column of an unknown word.
[[nodiscard]] KlartextWords read_klartext_words(Cursor& cursor, const Variables& variables, const TextRules& rules,
                                                bool radius_word);

/// A value with its sign, as a number or a Q parameter: "+10.5", "-Q5". Throws ReadError.
[[nodiscard]] double read_klartext_value(Cursor& cursor, const Variables& variables, const TextRules& rules);

/// A straight block that has only X, Y, Z, F and R0 with numbers, as words of G1 (G0 under FMAX).
[[nodiscard]] PlainResult read_plain_klartext(std::string_view line, Words& words);

}  // namespace clsurf
