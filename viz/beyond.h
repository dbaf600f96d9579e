#pragma once
// Beyond: what the colours of a map cannot show: values clearly beyond the range, and missing ones.

namespace clsurf::viz {

struct Beyond {
    bool below = false, above = false, missing = false;

    void widen(const Beyond& other) {
        below = below || other.below;
        above = above || other.above;
        missing = missing || other.missing;
    }
};

}  // namespace clsurf::viz
