#include "jostle/contact/own_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jostle {

double inclination_between_images(double apart, double length, double diameter) {
    if (apart <= diameter) return 0.0;
    if (apart >= length + diameter) return 0.5 * std::numbers::pi;
    // Side by side the axes are apart cos(inclination) from each other; beyond, it is ends that touch.
    const double offset = std::sqrt((apart - diameter) * (apart + diameter));
    if (offset <= length) return std::asin(offset / apart);
    return std::asin((apart * apart + length * length - diameter * diameter) / (2.0 * apart * length));
}

double distance_between_images(double inclination, double length, double diameter) {
    if (inclination >= 0.5 * std::numbers::pi) return length + diameter;
    const double sine = std::sin(inclination), cosine = std::cos(inclination);
    if (diameter * sine <= length * cosine) return diameter / cosine;
    return length * sine + std::sqrt((diameter - length * cosine) * (diameter + length * cosine));
}

std::optional<OwnImageTouch> touch_of_own_image(const PairGeometry& pair) {
    const double apart = norm(pair.centre_separation), diameter = pair.radii, length = 2.0 * pair.half_i;
    if (!(apart > diameter) || apart >= length + diameter) return std::nullopt;
    const double inclination = inclination_between_images(apart, length, diameter);
    const Vec3 towards = pair.centre_separation / apart;
    const double along = std::clamp(dot(pair.axis_i, towards), -1.0, 1.0);
    const Vec3 across = pair.axis_i - along * towards;
    const double cosine = norm(across);
    const Vec3 sideways = cosine > 1e-9 ? across / cosine : any_perpendicular(towards);
    OwnImageTouch touch = {pair, inclination - std::atan2(std::fabs(along), cosine)};
    touch.at_touching.axis_i = touch.at_touching.axis_j =
        std::copysign(std::sin(inclination), along) * towards + std::cos(inclination) * sideways;
    return touch;
}

std::optional<Contact> contact_with_own_image(const PairKey& key, const PairGeometry& pair) {
    const auto touch = touch_of_own_image(pair);
    if (!touch) return std::nullopt;
    const NearestPoints points = nearest_points(touch->at_touching);
    Contact contact;
    contact.i = key.i;
    contact.j = key.j;
    contact.normal = normalised(points.separation);
    contact.arm_i = points.s_i;
    contact.arm_j = points.s_j;
    const double along = dot(contact.normal, touch->at_touching.axis_i);
    const double gradient = std::fabs(points.s_j - points.s_i) * std::sqrt(std::max(0.0, 1.0 - along * along));
    contact.gap_after = gradient * touch->turn;
    return contact;
}

}  // namespace jostle
