#pragma once
// Progress: the algorithms report how far a long stage is; the command line draws it, or not.

#include <functional>
#include <string_view>

namespace clsurf {

/// Called with a stage's name and its done fraction (0 … 1). Must be cheap and thread-safe.
using Progress = std::function<void(std::string_view stage, double fraction)>;

}  // namespace clsurf
