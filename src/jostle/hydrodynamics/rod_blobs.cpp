#include "jostle/hydrodynamics/rod_blobs.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/hydrodynamics/blob_kernel.hpp"
#include "jostle/mobility/drag.hpp"

namespace jostle {

namespace {

/// Width of a blob over that of a sphere's, and how far beyond the cylinder's end the last one lies, in D/2: found so
/// that the line of blobs has the own mobility of a spherocylinder (decision 0044).
struct Shape {
    double aspect_ratio, width, beyond;
};
constexpr std::array<Shape, 17> shapes{{{0.0, 1.0, 0.0},
                                        {0.25, 1.02, 0.15},
                                        {0.5, 1.115, -0.025},
                                        {0.75, 0.965, 0.350},
                                        {1.0, 0.975, 0.325},
                                        {1.5, 1.025, 0.225},
                                        {2.0, 1.040, 0.175},
                                        {2.5, 1.060, 0.125},
                                        {3.0, 1.085, 0.075},
                                        {4.0, 1.100, 0.025},
                                        {5.0, 1.110, 0.0},
                                        {6.0, 1.125, -0.050},
                                        {8.0, 1.140, -0.100},
                                        {10.0, 1.155, -0.150},
                                        {12.0, 1.160, -0.175},
                                        {15.0, 1.170, -0.200},
                                        {20.0, 1.175, -0.200}}};

/// So far apart, in D, may blobs of a line lie.
constexpr double blob_distance = 1.3;

Shape shape_of(double aspect_ratio) {
    const auto above = std::find_if(shapes.begin() + 1, shapes.end() - 1,
                                    [&](const Shape& shape) { return shape.aspect_ratio >= aspect_ratio; });
    const Shape &a = *(above - 1), &b = *above;
    const double t = (aspect_ratio - a.aspect_ratio) / (b.aspect_ratio - a.aspect_ratio);
    return {aspect_ratio, a.width + t * (b.width - a.width), a.beyond + t * (b.beyond - a.beyond)};
}

/// A blob of a sphere has the variance D^2/12, so that its flow has the Faxen terms of the sphere.
double spread_of(double width, double diameter) {
    return width * width * diameter * diameter / 12.0;
}

void place_blobs(BlobLine& line, double diameter) {
    const double aspect_ratio = line.length / diameter;
    if (aspect_ratio == 0.0) {
        line.place = {0.0};
        return;
    }
    const auto blobs = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(aspect_ratio / blob_distance)) + 1);
    const double last = 0.5 * (line.length + shape_of(aspect_ratio).beyond * diameter);
    line.place.resize(blobs);
    for (std::size_t b = 0; b < blobs; ++b)
        line.place[b] = last * (2.0 * static_cast<double>(b) / static_cast<double>(blobs - 1) - 1.0);
}

/// The tractions of the isolated rod (theory, eq. 7.2): those that move all blobs alike, and that turn them.
void find_weights(BlobLine& line, double spread) {
    const auto blobs = static_cast<Eigen::Index>(line.place.size());
    const Eigen::Map<const Eigen::VectorXd> place(line.place.data(), blobs);
    Eigen::MatrixXd across(blobs, blobs), mean(blobs, blobs);
    for (Eigen::Index b = 0; b < blobs; ++b)
        for (Eigen::Index c = 0; c < blobs; ++c) {
            const double apart = place(b) - place(c);
            const BlobFlow flow = stokes_flow(spread, 1.0, apart * apart);
            across(b, c) = flow.isotropic;
            mean(b, c) = flow.isotropic + flow.radial * apart * apart / 3.0;
        }
    const Eigen::VectorXd pushed = mean.ldlt().solve(Eigen::VectorXd::Ones(blobs));
    Eigen::VectorXd turned = across.ldlt().solve(place);
    if (blobs > 1) turned /= turned.dot(place);
    line.force_weight.resize(line.place.size());
    line.moment_weight.resize(line.place.size());
    for (Eigen::Index b = 0; b < blobs; ++b) {  // exactly even, and odd, along the line
        const auto at = static_cast<std::size_t>(b);
        line.force_weight[at] = 0.5 * (pushed(b) + pushed(blobs - 1 - b)) / pushed.sum();
        line.moment_weight[at] = 0.5 * (turned(b) - turned(blobs - 1 - b));
    }
}

/// The largest of the three mobilities of the line of blobs over those of the rod.
double largest_share(const BlobLine& line, double spread, double viscosity) {
    const RodMobility blobs =
        mobility_of_blobs(line, [&](double squared) { return stokes_flow(spread, viscosity, squared); });
    return std::max({blobs.parallel / line.own.parallel, blobs.perpendicular / line.own.perpendicular,
                     blobs.rotational / line.own.rotational});
}

void find_remainder(BlobLine& line, double spread, double viscosity) {
    const RodMobility blobs =
        mobility_of_blobs(line, [&](double squared) { return stokes_flow(spread, viscosity, squared); });
    line.remainder = {std::max(0.0, line.own.parallel - blobs.parallel),
                      std::max(0.0, line.own.perpendicular - blobs.perpendicular),
                      std::max(0.0, line.own.rotational - blobs.rotational)};
}

[[noreturn]] void refuse_rods(const std::string& problem, const std::string& allowed) {
    refuse("mobility.model", "\"hydrodynamic\"", problem, allowed, "Use model = \"capsule\"");
}

void require_known(const Rods& rods) {
    for (std::size_t i = 0; i < rods.size(); ++i) {
        if (rods.diameter[i] != rods.diameter[0])
            refuse_rods("all blobs of force must have one width, and rods have different diameters", "one diameter");
        if (rods.length[i] > longest_line_of_blobs * rods.diameter[i])
            refuse_rods(fmt::format("a rod has L/D = {:.4g}", rods.length[i] / rods.diameter[i]),
                        fmt::format("L/D at most {}", longest_line_of_blobs));
    }
}

/// Widens the blobs until no line of them is more mobile than its rod: mobility falls as width grows.
void widen(BlobLines& blobs, double viscosity) {
    constexpr int rounds = 50;
    for (int round = 0; round < rounds; ++round) {
        double share = 0.0;
        for (BlobLine& line : blobs.lines) {
            find_weights(line, blobs.spread);
            share = std::max(share, largest_share(line, blobs.spread, viscosity));
        }
        if (share <= 1.0) return;
        blobs.spread *= share * share;
    }
}

std::shared_ptr<const BlobLines> lines_of(double diameter, const std::vector<double>& lengths, double viscosity) {
    auto blobs = std::make_shared<BlobLines>();
    blobs->diameter = diameter;
    for (const double length : lengths) {
        BlobLine line;
        line.length = length;
        line.own = capsule_drag(length, diameter, viscosity);
        place_blobs(line, diameter);
        blobs->spread = std::max(blobs->spread, spread_of(shape_of(length / diameter).width, diameter));
        blobs->lines.push_back(std::move(line));
    }
    widen(*blobs, viscosity);
    for (BlobLine& line : blobs->lines) find_remainder(line, blobs->spread, viscosity);
    return blobs;
}

}  // namespace

bool BlobLines::fit(double diameter_of_rods, const std::vector<double>& lengths) const {
    return diameter == diameter_of_rods &&
           std::equal(lines.begin(), lines.end(), lengths.begin(), lengths.end(),
                      [](const BlobLine& line, double length) { return line.length == length; });
}

std::size_t RodBlobs::max_blobs() const {
    std::size_t most = 0;
    for (const BlobLine& line : lines()) most = std::max(most, line.place.size());
    return most;
}

RodBlobs blobs_of(const Rods& rods, double viscosity, std::shared_ptr<const BlobLines> known) {
    require_known(rods);
    std::vector<double> lengths(rods.length);
    std::sort(lengths.begin(), lengths.end());
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    const double diameter = rods.size() == 0 ? 1.0 : rods.diameter[0];
    if (!known || !known->fit(diameter, lengths)) known = lines_of(diameter, lengths, viscosity);
    RodBlobs blobs{std::move(known), std::vector<std::uint32_t>(rods.size())};
    for (std::size_t i = 0; i < rods.size(); ++i)
        blobs.line_of[i] = static_cast<std::uint32_t>(std::lower_bound(lengths.begin(), lengths.end(), rods.length[i]) -
                                                      lengths.begin());
    return blobs;
}

}  // namespace jostle
