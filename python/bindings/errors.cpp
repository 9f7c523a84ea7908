#include <string_view>

#include "bindings/bindings.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"

namespace jostle::python {

namespace py = pybind11;

namespace {

/// The exception types live as long as the interpreter.
PyObject* input_error = nullptr;
PyObject* disk_error = nullptr;

constexpr const char* input_error_text =
    "Input that jostle refuses; its text is that of the command.\n\n"
    "Attributes: key, value, problem, allowed, suggestion (texts, \"\" where there is nothing to say), file, line, "
    "column\n"
    "(where the value stands, \"\" and 0 if it comes from no file), others (list of InputError: further mistakes of "
    "the\n"
    "same scene, whose texts follow below).";
constexpr const char* disk_error_text = "A file could not be read or written.";

/// What users write, and names of files, need not be UTF-8.
py::str text(std::string_view bytes) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

py::object exception_of(const InputError& error) {
    const InputError::Parts& parts = error.parts();
    py::object exception = py::handle(input_error)(text(error.what()));
    exception.attr("key") = text(parts.key);
    exception.attr("value") = text(parts.value);
    exception.attr("problem") = text(parts.problem);
    exception.attr("allowed") = text(parts.allowed);
    exception.attr("suggestion") = text(parts.suggestion);
    exception.attr("file") = text(parts.place.file);
    exception.attr("line") = parts.place.file.empty() ? 0 : parts.place.line;
    exception.attr("column") = parts.place.file.empty() ? 0 : parts.place.column;
    py::list others;
    for (const InputError::Parts& other : parts.others) others.append(exception_of(InputError(other)));
    exception.attr("others") = others;
    return exception;
}

void raise(const InputError& error) {
    PyErr_SetObject(input_error, exception_of(error).ptr());
}

void translate(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const InputError& error) {
        raise(error);
    } catch (const DiskError& error) {
        PyErr_SetObject(disk_error, text(error.what()).ptr());
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    input_error = PyErr_NewExceptionWithDoc("jostle.InputError", input_error_text, PyExc_ValueError, nullptr);
    disk_error = PyErr_NewExceptionWithDoc("jostle.DiskError", disk_error_text, PyExc_OSError, nullptr);
    module.attr("InputError") = py::handle(input_error);
    module.attr("DiskError") = py::handle(disk_error);
    py::register_exception_translator(translate);
    module.def(
        "refuse",
        [](std::string key, std::string value, std::string problem, std::string allowed, std::string suggestion,
           std::string file) {
            throw InputError({std::move(key),
                              std::move(value),
                              std::move(problem),
                              std::move(allowed),
                              std::move(suggestion),
                              {std::move(file), 0, 0}});
        },
        py::arg("key"), py::arg("value"), py::arg("problem"), py::arg("allowed") = "", py::arg("suggestion") = "",
        py::arg("file") = "");
}

}  // namespace jostle::python
