#pragma once
// FeedModeCursor: whether F counts lengths per minute (G94), or the inverse of a time (G93) or lengths per revolution (G95).

#include <cstdint>
#include <variant>

#include "program/event_cursor.h"
#include "program/program.h"

namespace clsurf {

/// Goes through the events of a program and gives the active feed mode. Programs begin with feeds per minute.
class FeedModeCursor {
public:
    explicit FeedModeCursor(const Program& program) : program_(&program) {}

    /// Whether F counts lengths per minute at a motion; motions must be in ascending order.
    [[nodiscard]] bool per_minute(std::int64_t motion) { return mode_at(motion) == FeedMode::per_minute; }

    /// Whether F is the inverse of the duration of a motion; motions must be in ascending order.
    [[nodiscard]] bool inverse_time(std::int64_t motion) { return mode_at(motion) == FeedMode::inverse_time; }

private:
    FeedMode mode_at(std::int64_t motion) {
        cursor_.pass(program_->events, motion, [&](const ProgramEvent& event) {
            if (const auto* mode = std::get_if<FeedMode>(&event.meaning)) mode_ = *mode;
        });
        return mode_;
    }

    const Program* program_;
    EventCursor cursor_;
    FeedMode mode_ = FeedMode::per_minute;
};

}  // namespace clsurf
