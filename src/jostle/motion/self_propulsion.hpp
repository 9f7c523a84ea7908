#pragma once

#include "jostle/motion/motion.hpp"

namespace jostle {

/// Every rod swims along its axis n with the same speed: U = U_0 n (theory, eq. 2.1).
class SelfPropulsion final : public Motion {
public:
    /// speed U_0 (length/time), of either sign; not finite: InputError (key "motion.self_propulsion").
    explicit SelfPropulsion(double speed);

    void add_to(Velocities& known, const Rods& rods, const StepContext& context) const override;

private:
    double speed_;
};

}  // namespace jostle
