#pragma once
// ServoLoop: where an axis is when it is told to be somewhere: a discrete position loop with velocity
// feed-forward round a first-order velocity loop.
//
//     v_ref = Kv (cmd − x) + c_ff · cmd′,    T_v v′ + v = v_ref,    x′ = v
//
// At constant speed v the lag is v (1 − c_ff)/Kv. Coulomb friction takes f from v_ref in the direction of
// motion, and holds an axis at rest while |v_ref| ≤ f: the lag grows by f/Kv, and after a reversal
// the axis stands until the loop has wound up. The loop closes over the drive; the encoder is at the
// table, which follows with the play of the backlash.

#include <cstdint>

#include "machine/machine.h"

namespace clsurf {

class ServoLoop {
public:
    /// `seed` tells axes apart: the noise of a run is the same each time.
    ServoLoop(const ServoModel& model, double period, double start, std::uint64_t seed);

    /// The commanded position of the next period [mm] → the encoder's position at its end [mm].
    double follow(double commanded);

private:
    [[nodiscard]] double less_friction(double reference) const;

    double gain_, feedforward_, velocity_step_, quantum_, noise_, period_, play_, friction_;
    double commanded_, position_, table_, velocity_ = 0;
    std::uint64_t random_;
};

}  // namespace clsurf
