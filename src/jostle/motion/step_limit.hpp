#pragma once

#include <cmath>
#include <limits>
#include <string>

namespace jostle {

/// A reason why a time step must not be long: something that happens in it must stay small.
///
/// As much of it happens in a step dt as `amount` says: rate dt/scale, or of a diffusion sqrt(rate dt)/scale.
struct StepLimit {
    std::string key;      ///< of the scene, that sets how fast it is
    std::string value;    ///< of that key, for messages
    double number = 0.0;  ///< the same, if the amount is proportional to it, or inversely; 0: neither
    bool inverse = false;
    std::string harm;    ///< what a step does that is too long: "takes a rod through others"
    std::string what;    ///< what has the amount: "the fastest swimmer covers"
    std::string unit;    ///< of the amount, "D" for diameters; may be empty
    std::string remedy;  ///< beside a shorter step: "slower swimmers"

    double rate = 0.0, scale = 1.0;
    bool diffusive = false;

    static constexpr double none = std::numeric_limits<double>::infinity();
    double automatic = none;  ///< the amount in an automatic step, at most
    double advised = none;    ///< `jostle check` warns beyond
    double largest = none;    ///< a run is refused beyond

    double amount(double step) const { return (diffusive ? std::sqrt(rate * step) : rate * step) / scale; }

    /// The step in which so much happens.
    double step_of(double amount) const {
        const double way = amount * scale;
        return (diffusive ? way * way : way) / rate;
    }
};

}  // namespace jostle
