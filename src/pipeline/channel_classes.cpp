#include "pipeline/channel_classes.h"

#include <string>

#include "simulation/path/path_stream.h"

namespace clsurf {
namespace {

ChannelClasses limiting_factors() {
    ChannelClasses limits{"limit", "What limits the speed", {}};
    for (auto value = 0; value <= static_cast<int>(LimitingFactor::block_time); ++value) {
        const auto factor = static_cast<LimitingFactor>(value);
        limits.classes.push_back(
            {static_cast<float>(value), std::string(name_of(factor)), factor == LimitingFactor::feed});
    }
    return limits;
}

}  // namespace

std::vector<ChannelClasses> channel_classes() {
    return {limiting_factors(),
            // As motion.motion-type of LinuxCNC's motion controller.
            {"motion",
             "Kind of motion",
             {{0, "none"},
              {1, "rapid"},
              {2, "feed"},
              {3, "arc"},
              {4, "tool change"},
              {5, "probing"},
              {6, "rotary indexing"}}},
            {"line", "Line of the program", {}, "line"}};
}

}  // namespace clsurf
