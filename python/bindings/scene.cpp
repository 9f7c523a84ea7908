#include "bindings/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings/bindings.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/scene_file/key_reader.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_writer.hpp"

namespace jostle::python {

namespace py = pybind11;

namespace {

// The member of a scene as Python sees it; one overload a type. Vectors have as many numbers as the box has dimensions.
template <class Member>
py::object shown(const Member& member, int /*dimensions*/ = 3) {
    return py::cast(member);
}
py::object shown(const Vec3& member, int dimensions) {
    if (dimensions == 2) return py::make_tuple(member.x, member.y);
    return py::make_tuple(member.x, member.y, member.z);
}
py::object shown(const std::array<bool, 3>& member, int dimensions) {
    if (dimensions == 2) return py::make_tuple(member[0], member[1]);
    return py::make_tuple(member[0], member[1], member[2]);
}
template <class Choice>
requires std::is_enum_v<Choice> py::object shown(const Choice& member, int /*dimensions*/) {
    return py::cast(std::string(word_of(member)));
}
template <class Number>
py::object shown(const std::optional<Number>& member, int dimensions) {
    return member ? shown(*member, dimensions) : py::none();
}
template <class Value>
py::object shown(const Ramp<Value>& member, int dimensions) {
    if (member.empty()) return py::none();
    py::list points;
    for (const auto& [time, value] : member) points.append(py::make_tuple(time, shown(value, dimensions)));
    return points;
}

/// (table, name) of every key.
std::vector<std::array<std::string, 2>> keys() {
    std::vector<std::array<std::string, 2>> keys;
    const Scene scene;
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto&, const auto&) {
        keys.push_back({std::string(table), std::string(name)});
    });
    return keys;
}

py::object value_of(const SceneInPython& self, const std::string& key) {
    py::object value;
    for_each_key(self.scene, [&](std::string_view table, std::string_view name, const auto& member, const auto&) {
        if (full_key(table, name) == key) value = shown(member, dimensions_of(self.scene));
    });
    return value;
}

/// Takes away a value that may be left out; false where the key needs one.
template <class Member>
bool taken_away(Member& member) {
    if constexpr (requires { member.reset(); }) {
        member.reset();
        return true;
    } else if constexpr (requires { member.back().time; }) {
        member.clear();
        return true;
    }
    return false;
}

/// Sets a key from TOML, through the reader of scene files: types, words and units are looked at there. Where these are
/// wrong, the scene stays as it was.
void set_value(SceneInPython& self, const std::string& key, const std::optional<std::string>& toml) {
    const TomlDocument document(toml ? "value = " + *toml : "", "");
    Scene scene = self.scene;
    for_each_key(scene, [&](std::string_view table, std::string_view name, auto& member, const auto& spec) {
        if (full_key(table, name) != key) return;
        if (toml)
            KeyReader(document, scene.units.system, dimensions_of(scene), key)
                .read(*document.find("", "value"), member, spec);
        else if (!taken_away(member))
            throw InputError({.key = key, .value = "None", .problem = "must have a value"});
    });
    leave_out_z(scene);
    self.scene = scene;
}

}  // namespace

void bind_scene(py::module_& module) {
    module.def("scene_keys", &keys);
    py::class_<SceneInPython>(module, "Scene")
        .def_static("read",
                    [](const std::filesystem::path& path) {
                        return SceneInPython{read_scene(path), path};
                    })
        .def_static("parse",
                    [](const std::string& text, const std::string& name) {
                        return SceneInPython{parse_scene(text, name), {}};
                    })
        .def("copy", [](const SceneInPython& self) { return self; })
        .def("same", [](const SceneInPython& self, const SceneInPython& other) { return self.scene == other.scene; })
        .def("get", &value_of)
        .def("set", &set_value)
        .def("to_toml", [](const SceneInPython& self) { return to_toml(self.scene); })
        .def("validate", [](const SceneInPython& self) { validate(self.scene); })
        .def_property_readonly("path", [](const SceneInPython& self) { return self.path.string(); });
}

}  // namespace jostle::python
