#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "jostle/contact_problem/delassus_operator.hpp"

namespace jostle {

/// A = D^T M D, applied among the rods with contacts alone, with the whole of M or its near part. Compliance included.
/// Holds a reference to the DelassusOperator, as it is when this is made.
class ContactsAmong {
public:
    explicit ContactsAmong(const DelassusOperator& matrix);
    ContactsAmong(const ContactsAmong&) = delete;
    ContactsAmong& operator=(const ContactsAmong&) = delete;

    const LinearOperator& whole() const { return whole_; }
    const LinearOperator& near() const { return near_; }

private:
    class Part final : public LinearOperator {
    public:
        Part(const ContactsAmong& among, bool near) : among_(among), near_(near) {}
        std::size_t size() const override { return among_.matrix_.size(); }
        std::span<const double> diagonal() const override { return among_.matrix_.diagonal(); }
        void apply(std::span<const double> gamma, std::span<double> rates) const override {
            among_.apply(near_, gamma, rates);
        }

    private:
        const ContactsAmong& among_;
        bool near_;
    };
    void apply(bool near, std::span<const double> gamma, std::span<double> rates) const;

    const DelassusOperator& matrix_;
    std::vector<std::uint32_t> locals_;  ///< (n) of the rods with contacts, as the contact matrix numbers them
    std::unique_ptr<const MobilityAmong> mobility_;
    Part whole_, near_;
    mutable std::vector<ContactForce> forces_;
    mutable std::vector<ContactVelocity> velocities_;
    mutable Forces rod_forces_;          ///< (n)
    mutable Velocities rod_velocities_;  ///< (n)
};

}  // namespace jostle
