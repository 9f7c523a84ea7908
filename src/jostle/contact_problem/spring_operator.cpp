#include "jostle/contact_problem/spring_operator.hpp"

#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Contacts that rest on one spring alone have a second one, which would push only if the gap closed this many times as
/// fast as any does without forces.
constexpr double never = 1e6;

}  // namespace

SpringOperator::SpringOperator(const DelassusOperator& matrix, std::span<const double> b)
    : matrix_(matrix),
      contacts_(matrix.size()),
      constant_(2 * contacts_),
      diagonal_(2 * contacts_),
      rest_(contacts_),
      both_(contacts_),
      rates_(contacts_) {
    const double fastest = parallel_max(b.size(), 0.0, [&](std::size_t l) { return std::fabs(b[l]); });
    parallel_for(contacts_, [&](std::size_t l) {
        const auto [soft, stiff, knee] = matrix.compliance(l);
        const bool has_second = soft > stiff;
        const double part =
            has_second ? soft / (soft - stiff) : 1.0;  // springs side by side: 1/stiff = 1/soft + 1/rest
        rest_[l] = part * stiff;
        diagonal_[l] = matrix.diagonal()[l] + soft;
        diagonal_[contacts_ + l] = matrix.diagonal()[l] + rest_[l];
        constant_[l] = b[l];
        constant_[contacts_ + l] = b[l] + (has_second ? part * knee : never * fastest);
    });
}

void SpringOperator::apply(std::span<const double> forces, std::span<double> result) const {
    const auto soft = forces.first(contacts_), stiff = forces.last(contacts_);
    parallel_for(contacts_, [&](std::size_t l) { both_[l] = soft[l] + stiff[l]; });
    matrix_.apply(both_, rates_);
    parallel_for(contacts_, [&](std::size_t l) {
        result[l] = rates_[l] + matrix_.compliance(l).soft * soft[l];
        result[contacts_ + l] = rates_[l] + rest_[l] * stiff[l];
    });
}

std::vector<double> SpringOperator::split(std::span<const double> gamma) const {
    std::vector<double> forces(2 * contacts_);
    parallel_for(contacts_, [&](std::size_t l) {
        const ContactCompliance compliance = matrix_.compliance(l);
        forces[l] = compliance.soft > compliance.stiff ? compliance.at(gamma[l]) / compliance.soft : gamma[l];
        forces[contacts_ + l] = gamma[l] - forces[l];
    });
    return forces;
}

std::vector<double> SpringOperator::joined(std::span<const double> forces) const {
    std::vector<double> gamma(contacts_);
    parallel_for(contacts_, [&](std::size_t l) { gamma[l] = forces[l] + forces[contacts_ + l]; });
    return gamma;
}

}  // namespace jostle
