#include "stress_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "jostle/disk/output_file.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/error/nearest_word.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/stress/contact_stress.hpp"
#include "jostle/stress/stress.hpp"
#include "jostle/tables/contact_table.hpp"

using namespace jostle;

using Json = nlohmann::ordered_json;

namespace {

constexpr std::array<const char*, 9> elements = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};

/// The tables, and what the options say about them.
struct Question {
    BodyTable bodies;
    ContactTable contacts;
    StressConvention convention;
    std::optional<double> volume;
    TableUnits units;
};

StressConvention convention_of(const std::string& word) {
    const std::vector<std::string> words = {"rigid_body", "centre_of_mass_virial", "centre_line"};
    if (word == words[0]) return StressConvention::rigid_body;
    if (word == words[1]) return StressConvention::centre_of_mass_virial;
    if (word == words[2]) return StressConvention::centre_line;
    throw InputError({.key = "--convention",
                      .value = word,
                      .problem = "is no convention",
                      .allowed = quoted_list(words),
                      .suggestion = did_you_mean(word, words)});
}

std::optional<Box> box_of(const StressOptions& options) {
    if (options.box.empty()) return std::nullopt;
    for (const double edge : options.box)
        if (!(edge >= Range::smallest && edge <= Range::largest))
            throw InputError({.key = "--box",
                              .value = fmt::format("{}", fmt::join(options.box, " ")),
                              .problem = "has an edge that is no such length",
                              .allowed = "three lengths from 1e-30 to 1e30"});
    const Vec3 edges{options.box[0], options.box[1], options.box[2]};
    std::array<bool, 3> periodic{};
    if (options.periodic == "none") return Box(edges, periodic);
    if (options.periodic.empty() || options.periodic.find_first_not_of("xyz") != std::string::npos)
        throw InputError({.key = "--periodic",
                          .value = options.periodic,
                          .problem = "names no directions",
                          .allowed = "letters of xyz, or none"});
    for (const char direction : options.periodic) periodic[static_cast<std::size_t>(direction - 'x')] = true;
    return Box(edges, periodic);
}

std::optional<double> volume_of(const StressOptions& options, const std::optional<Box>& box) {
    if (box) return box->volume();
    constexpr double smallest = 1e-90, largest = 1e90;  // those of boxes
    if (options.volume && !(*options.volume >= smallest && *options.volume <= largest))
        throw InputError({.key = "--volume",
                          .value = fmt::format("{}", *options.volume),
                          .problem = "is no such volume",
                          .allowed = "1e-90 to 1e90"});
    return options.volume;
}

/// The unit on the command line, else the one of the tables, which must agree.
std::string unit_of_both(const std::string& option, const std::string& contacts, const std::string& bodies,
                         const char* name) {
    if (!option.empty()) return option;
    if (!contacts.empty() && !bodies.empty() && contacts != bodies)
        throw InputError({.key = name,
                          .value = contacts,
                          .problem = fmt::format("the contacts are in {}, the bodies in {}", contacts, bodies),
                          .suggestion = "Bring both to the same units"});
    return contacts.empty() ? bodies : contacts;
}

Question read_question(const StressOptions& options) {
    Question question;
    question.convention = convention_of(options.convention);
    const std::optional<Box> box = box_of(options);
    question.volume = volume_of(options, box);
    for (const std::string& input : {options.contacts, options.bodies}) {
        std::error_code none;
        if (!options.per_body.empty() && std::filesystem::equivalent(options.per_body, input, none))
            throw InputError({.key = "--per-body", .value = input, .problem = "would overwrite a table that is read"});
    }
    question.bodies = read_bodies(options.bodies);
    question.contacts = read_contacts(options.contacts, question.bodies, box);
    if (question.convention == StressConvention::centre_line && question.contacts.one_point)
        throw InputError(
            {.key = "--convention",
             .value = "centre_line",
             .problem = "needs a point on the centre line of each body, and the contacts give one point for both",
             .suggestion = "Give point_1_x ... point_2_z, relative to the centres"});
    const TableUnits &of_contacts = question.contacts.units, &of_bodies = question.bodies.units;
    question.units = {unit_of_both(options.length_unit, of_contacts.length, of_bodies.length, "length_unit"),
                      unit_of_both(options.force_unit, of_contacts.force, of_bodies.force, "force_unit")};
    return question;
}

/// "pN um-2", or without a volume "pN um"; empty where a unit is not known.
std::string stress_unit(const Question& question) {
    const auto& [length, force] = question.units;
    if (length.empty() || force.empty()) return "";
    return force + " " + length + (question.volume ? "-2" : "");
}

/// By the volume, if it is known.
Mat3 divided(const Mat3& stress, const Question& question) {
    return (1.0 / question.volume.value_or(1.0)) * stress;
}

/// Second moments near the ends of the range of doubles can take the stress beyond them.
void require_finite(const ContactStress& stress, const Question& question) {
    const auto is_finite = [&](const Mat3& of) {
        const Mat3 a = divided(of, question);
        return std::all_of(a.m.begin(), a.m.end(), [](double element) { return std::isfinite(element); });
    };
    if (!is_finite(stress.total()) || !std::all_of(stress.per_body.begin(), stress.per_body.end(), is_finite))
        throw InputError({.key = "stress",
                          .problem = "is beyond the numbers that a computer can hold",
                          .suggestion = "Choose units in which second moments, lengths and forces are nearer to 1"});
}

Json rows_of(const Mat3& a) {
    return {{a(0, 0), a(0, 1), a(0, 2)}, {a(1, 0), a(1, 1), a(1, 2)}, {a(2, 0), a(2, 1), a(2, 2)}};
}

Json null_if_empty(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json in_json(const Question& question, const ContactStress& stress, const std::string& convention) {
    const Mat3 total = divided(stress.total(), question);
    const Vec3 axial = axial_vector(total);
    Json passed_over = {{"contacts", question.contacts.passed_over}, {"bodies", question.bodies.passed_over}};
    return {{"convention", convention},
            {"contacts", question.contacts.contacts.size()},
            {"bodies", question.bodies.bodies.size()},
            {"volume", question.volume ? Json(*question.volume) : Json(nullptr)},
            {"divided_by_volume", question.volume.has_value()},
            {"units",
             {{"length", null_if_empty(question.units.length)},
              {"force", null_if_empty(question.units.force)},
              {"stress", null_if_empty(stress_unit(question))}}},
            {"stress", rows_of(total)},
            {"pressure", trace(total) / 3.0},
            {"antisymmetric_part", {{"vector", {axial.x, axial.y, axial.z}}, {"relative", relative_asymmetry(total)}}},
            {"virial", rows_of(divided(stress.virial, question))},
            {"geometric", rows_of(divided(stress.geometric, question))},
            {"columns_passed_over", passed_over}};
}

std::string row_text(const Mat3& a, int row) {
    return fmt::format("{:>14.6g} {:>14.6g} {:>14.6g}", a(row, 0), a(row, 1), a(row, 2));
}

void print_text(const Question& question, const ContactStress& stress, const std::string& convention) {
    const Mat3 total = divided(stress.total(), question), geometric = divided(stress.geometric, question);
    const Vec3 axial = axial_vector(total);
    const std::string unit = stress_unit(question), in = unit.empty() ? "" : " in " + unit;
    std::printf("%zu contacts of %zu bodies, convention %s\n", question.contacts.contacts.size(),
                question.bodies.bodies.size(), convention.c_str());
    if (question.volume)
        std::printf("volume      %.9g%s\n", *question.volume,
                    question.units.length.empty() ? "" : (" " + question.units.length + "3").c_str());
    std::printf("%s%s, row: position, column: force\n",
                question.volume ? "stress" : "stress times volume (no --volume or --box)", in.c_str());
    for (int row = 0; row < 3; ++row) std::printf("%s\n", row_text(total, row).c_str());
    std::printf("of it the geometric part of the bodies\n");
    for (int row = 0; row < 3; ++row) std::printf("%s\n", row_text(geometric, row).c_str());
    std::printf("pressure%s    %.9g\n", question.volume ? "" : " times volume", trace(total) / 3.0);
    std::printf("asymmetry   eps:stress = %.6g %.6g %.6g, relative %.3g\n", axial.x, axial.y, axial.z,
                relative_asymmetry(total));
    for (const auto& [path, names] :
         {std::pair{"contacts", question.contacts.passed_over}, std::pair{"bodies", question.bodies.passed_over}})
        if (!names.empty()) std::printf("columns of the %s not read: %s\n", path, quoted_list(names).c_str());
}

/// id, stress_xx ... stress_zz of each body, in the order of the table of bodies; digits enough to give the same
/// double.
std::string per_body_csv(const Question& question, const ContactStress& stress) {
    std::string text;
    if (!question.units.length.empty()) text += fmt::format("# length_unit: {}\n", question.units.length);
    if (!question.units.force.empty()) text += fmt::format("# force_unit: {}\n", question.units.force);
    text += "id";
    for (const char* element : elements) text += fmt::format(",stress_{}", element);
    text += '\n';
    for (std::size_t k = 0; k < stress.per_body.size(); ++k)
        text += fmt::format("{},{}\n", question.bodies.id[k], fmt::join(divided(stress.per_body[k], question).m, ","));
    return text;
}

ExitCode answer(const StressOptions& options) {
    const Question question = read_question(options);
    std::vector<Mat3> second_moments;
    for (const RigidBody& body : question.bodies.bodies) second_moments.push_back(body.second_moment);
    const ContactStress stress = contact_stress(second_moments, question.contacts.contacts, question.convention);
    require_finite(stress, question);
    if (!options.per_body.empty()) write_output(options.per_body, per_body_csv(question, stress));
    if (options.json)
        std::printf(
            "%s\n",
            in_json(question, stress, options.convention).dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    else
        print_text(question, stress, options.convention);
    return ExitCode::done;
}

}  // namespace

ExitCode stress_command(const StressOptions& options) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of the write, like a full disk
    try {
        return answer(options);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error("out of memory: the tables hold more than there is room for");
    }
}
