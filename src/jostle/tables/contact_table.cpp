#include "jostle/tables/contact_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/tables/whole_number.hpp"

namespace jostle {

namespace {

KnownColumns contact_columns() {
    KnownColumns known{{"body_1", "body_2"}, {}};
    for (const char* name : {"force", "contact", "point_1", "point_2", "separation", "image"})
        for (const std::string& column : vector_columns(name)) known.numbers.push_back(column);
    return known;
}

/// Which of the optional columns a table has.
struct ContactForm {
    bool contact, points, separation, image;
};

ContactForm contact_form_of(const Table& table, bool with_box) {
    const ContactForm form = {table.has_all(vector_columns("contact")),
                              table.has_all(vector_columns("point_1")) || table.has_all(vector_columns("point_2")),
                              table.has_all(vector_columns("separation")), table.has_all(vector_columns("image"))};
    if (form.points) {
        table.require(vector_columns("point_1"));
        table.require(vector_columns("point_2"));
    }
    const auto refuse = [&](const char* problem, const char* suggestion) {
        throw refused_file(table.path, problem, suggestion);
    };
    if (form.contact == form.points)
        refuse(
            form.contact ? "says twice where the forces act" : "nothing says where the forces act",
            "Give contact_x, contact_y, contact_z, one place for both bodies, or point_1_x ... point_2_z, a place on "
            "each relative to its centre");
    if (form.separation && form.image)
        refuse("says twice which images meet", "Give separation_x ... or image_x ..., not both");
    if (form.image && !with_box) refuse("the columns image_x, image_y, image_z count box edges", "Give --box");
    return form;
}

std::vector<std::string> columns_of(const ContactForm& form) {
    std::vector<std::string> columns = {"body_1", "body_2"};
    const auto add = [&](bool there, const char* name) {
        if (!there) return;
        for (const std::string& column : vector_columns(name)) columns.push_back(column);
    };
    add(true, "force");
    add(form.contact, "contact");
    add(form.points, "point_1");
    add(form.points, "point_2");
    add(form.separation, "separation");
    add(form.image, "image");
    return columns;
}

/// The image of a distance that is nearest to 0 along periodic directions.
Vec3 nearest_image(Vec3 distance, const std::optional<Box>& box, const char* of) {
    if (!box) return distance;
    for (int k = 0; k < 3; ++k) {
        if (!box->periodic()[static_cast<std::size_t>(k)]) continue;
        const double edge = box->edges()[k];
        distance[k] -= edge * std::round(distance[k] / edge);
        if (std::fabs(distance[k]) > (0.5 - 1e-9) * edge)
            throw InputError(
                {.problem = fmt::format("{} is half a box edge: which image is meant cannot be told", of),
                 .suggestion = "Give image_x, image_y, image_z, or separation_x, separation_y, separation_z"});
    }
    return distance;
}

/// Turns rows into contacts.
class ContactReader {
public:
    ContactReader(const Table& table, const ContactForm& form, const BodyTable& bodies, const std::optional<Box>& box)
        : bodies_(bodies),
          box_(box),
          form_(form),
          body_1_(table.numbers.at("body_1")),
          body_2_(table.numbers.at("body_2")),
          force_(table, vector_columns("force")),
          contact_(table, vector_columns("contact")),
          point_1_(table, vector_columns("point_1")),
          point_2_(table, vector_columns("point_2")),
          separation_(table, vector_columns("separation")),
          image_(table, vector_columns("image")) {}

    /// Throws InputError, without a place, if the row cannot be taken.
    BodyContact operator[](std::size_t row) const {
        BodyContact contact;
        contact.body_1 = body(row, "body_1", body_1_);
        contact.body_2 = body(row, "body_2", body_2_);
        contact.force = force_[row];
        const Vec3 &centre_1 = bodies_.bodies[contact.body_1].centre, &centre_2 = bodies_.bodies[contact.body_2].centre;
        const bool known = form_.separation || form_.image;
        if (form_.separation) contact.separation = separation_[row];
        if (form_.image) contact.separation = centre_2 - centre_1 + displacement(row);
        if (contact.body_1 == contact.body_2 && (!known || contact.separation == Vec3{}))
            throw InputError({.problem = "a body touches itself",
                              .suggestion = "Where it meets its own periodic image, give image_x, image_y, image_z, or "
                                            "separation_x, separation_y, separation_z"});
        if (form_.points) {
            contact.point_1 = point_1_[row];
            contact.point_2 = point_2_[row];
            if (!known) contact.separation = nearest_image(centre_2 - centre_1, box_, "the distance of the centres");
            return contact;
        }
        contact.point_1 = nearest_image(contact_[row] - centre_1, box_, "the distance from body 1 to the contact");
        if (known) {
            contact.point_2 = contact.point_1 - contact.separation;
            return contact;
        }
        contact.point_2 = nearest_image(contact_[row] - centre_2, box_, "the distance from body 2 to the contact");
        contact.separation = contact.point_1 - contact.point_2;
        return contact;
    }

private:
    std::uint32_t body(std::size_t row, const char* name, const std::vector<double>& ids) const {
        const std::int64_t id = whole_number(name, ids[row]);
        const auto found = bodies_.row_of.find(id);
        if (found == bodies_.row_of.end())
            throw InputError({.key = name, .value = fmt::format("{}", id), .problem = "no body has that id"});
        return found->second;
    }

    Vec3 displacement(std::size_t row) const {
        Vec3 displacement;
        for (int k = 0; k < 3; ++k) {
            const std::int64_t count = whole_number("image", image_[row][k]);
            if (count != 0 && !box_->periodic()[static_cast<std::size_t>(k)])
                throw InputError({.problem = "an image along a direction in which the box is open"});
            displacement[k] = static_cast<double>(count) * box_->edges()[k];
        }
        return displacement;
    }

    const BodyTable& bodies_;
    const std::optional<Box>& box_;
    ContactForm form_;
    const std::vector<double>&body_1_, &body_2_;
    VectorColumn force_, contact_, point_1_, point_2_, separation_, image_;
};

}  // namespace

ContactTable read_contacts(const std::string& path, const BodyTable& bodies, const std::optional<Box>& box) {
    const KnownColumns known = contact_columns();
    Table table = read_table(path, known);
    std::vector<std::string> required = {"body_1", "body_2"};
    for (const std::string& column : vector_columns("force")) required.push_back(column);
    table.require(required);
    const ContactForm form = contact_form_of(table, box.has_value());
    table.require_filled(columns_of(form));
    ContactTable result;
    result.one_point = form.contact;
    result.units = table.units;
    result.passed_over = table.passed_over(known);
    const ContactReader reader(table, form, bodies, box);
    for (std::size_t row = 0; row < table.rows; ++row) {
        if (table.problems.has(row)) continue;
        try {
            result.contacts.push_back(reader[row]);
        } catch (const InputError& error) {
            table.problems.add(row, error.what());
        }
    }
    table.problems.throw_if_any();
    return result;
}

}  // namespace jostle
