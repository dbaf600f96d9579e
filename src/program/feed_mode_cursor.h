#pragma once
// FeedModeCursor: whether F counts lengths per minute (G94), or the inverse of a time (G93) or lengths per revolution (G95).

#include <cstdint>
#include <string>
#include <string_view>

#include "program/event_cursor.h"
#include "program/program.h"

namespace clsurf {

/// The event of a feed mode that another one takes the place of, and its values for G94 and G93.
inline constexpr std::string_view feed_mode_event = "feed-mode", feed_per_minute = "G94", feed_inverse_time = "G93";

/// Goes along the events of a program and says which feed mode holds. Programs begin with feeds per minute.
class FeedModeCursor {
public:
    explicit FeedModeCursor(const Program& program) : program_(&program) {}

    /// Whether F counts lengths per minute at a motion; motions must not go back.
    [[nodiscard]] bool per_minute(std::int64_t motion) { return mode_at(motion) == feed_per_minute; }

    /// Whether F is the inverse of the time that a motion takes; motions must not go back.
    [[nodiscard]] bool inverse_time(std::int64_t motion) { return mode_at(motion) == feed_inverse_time; }

private:
    const std::string& mode_at(std::int64_t motion) {
        cursor_.pass(program_->events, motion, [&](const ProgramEvent& event) {
            if (event.name == feed_mode_event) mode_ = event.value;
        });
        return mode_;
    }

    const Program* program_;
    EventCursor cursor_;
    std::string mode_{feed_per_minute};
};

}  // namespace clsurf
