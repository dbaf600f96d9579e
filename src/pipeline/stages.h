#pragma once
// Stages: the names of the steps of a longer computation, for progress displays and time measurements.

#include <functional>
#include <string_view>

namespace clsurf {

/// Called in the caller's thread when a stage begins. May be empty.
using Stages = std::function<void(std::string_view stage)>;

inline void begin_stage(const Stages& stages, std::string_view stage) {
    if (stages) stages(stage);
}

}  // namespace clsurf
