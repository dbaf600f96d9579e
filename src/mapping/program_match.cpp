#include "mapping/program_match.h"

#include <fmt/format.h>

namespace clsurf {

std::vector<std::string> ProgramMatch::doubts() const {
    // As in docs/design/predictor.md#6-decide-whether-the-data-allow-a-verdict, A partial log.
    constexpr double most_missing = 0.5;
    std::vector<std::string> sentences;
    if (!foreign.empty()) sentences.push_back("The log does not belong to this program: " + foreign + ".");
    if (missing > most_missing)
        sentences.push_back(fmt::format("The log lacks {:.0f} % of the program's motions.", 100 * missing));
    return sentences;
}

}  // namespace clsurf
