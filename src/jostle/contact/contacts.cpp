#include "jostle/contact/contacts.hpp"

#include <tuple>

namespace jostle {

std::vector<std::size_t> order_of_ids(const Contacts& contacts, std::span<const std::uint64_t> ids,
                                      std::optional<std::span<const double>> gamma) {
    std::vector<std::size_t> order;
    for (std::size_t l = 0; l < contacts.size(); ++l)
        if (!gamma || (*gamma)[l] > 0.0) order.push_back(l);
    const auto key = [&](std::size_t l) {
        const Contact& contact = contacts.contact[l];
        return std::tuple(id_of_body(contact.i, ids), ids[contact.j], contacts.image[l], l);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return order;
}

}  // namespace jostle
