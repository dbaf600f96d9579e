#include "intervals/interval_feeds.h"

#include "intervals/program_intervals.h"

namespace clsurf {

std::vector<float> interval_feeds(const Program& program, const Machine& machine) {
    const ProgramIntervals planned = plan_intervals(program, build_programmed_surface(program), {}, machine);
    std::vector<float> feeds(planned.speed_of_motion.size(), 0);
    for (std::size_t i = 0; i < feeds.size(); ++i) {
        const auto feed = static_cast<float>(planned.speed_of_motion[i] / machine.controller.feed_override);
        if (feed < program.motions.feed[i]) feeds[i] = feed;  // NaN: not on a cut pass
    }
    return feeds;
}

void hold_interval_speeds(Program& program, const Machine& machine) {
    const std::vector<float> feeds = interval_feeds(program, machine);
    for (std::size_t i = 0; i < feeds.size(); ++i) {
        if (feeds[i] > 0) program.motions.feed[i] = feeds[i];
    }
}

}  // namespace clsurf
