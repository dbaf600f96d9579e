#include "core/error.h"

#include <utility>

namespace clsurf {

InputError::InputError(Diagnostic diagnostic)
    : std::runtime_error(to_text(diagnostic)), diagnostic_(std::move(diagnostic)) {}

InputError::InputError(Place where, std::string what, std::string hint)
    : InputError(Diagnostic{Severity::error, "input", std::move(where), std::move(what), std::move(hint)}) {}

}  // namespace clsurf
