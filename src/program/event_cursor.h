#pragma once
// EventCursor: goes through the events of a program in parallel with its motions.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "program/program.h"

namespace clsurf {

class EventCursor {
public:
    /// Calls take(event) for the events up to a motion, except those passed before; motions must be in ascending
    /// order.
    template <typename Take>
    void pass(const std::vector<ProgramEvent>& events, std::int64_t motion, const Take& take) {
        for (; next_ < events.size() && events[next_].motion <= motion; ++next_) take(events[next_]);
    }

private:
    std::size_t next_ = 0;
};

}  // namespace clsurf
