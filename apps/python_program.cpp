#include "python_program.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "jostle/disk/durable_file.hpp"

using namespace jostle;

namespace {

/// Beside an installed command, else where jostle was built.
std::string path_of(const std::string& program) {
    const std::string name = program + ".py";
    const std::filesystem::path prefix = std::filesystem::path(path_of_command()).parent_path().parent_path();
    const std::filesystem::path installed = prefix / JOSTLE_INSTALLED_PROGRAMS / name;
    if (file_exists(installed)) return installed;
    const std::filesystem::path source = std::filesystem::path(JOSTLE_PROGRAMS) / name;
    if (file_exists(source)) return source;
    throw refused_file(source, "this part of jostle is not there", "Build or install jostle again");
}

constexpr const char* advice =
    "Run: apt-get install python3, or name Python 3.11 or later by JOSTLE_PYTHON: its path, or what PATH finds";

/// The first program of this name in the folders of PATH that are absolute, or an empty text.
std::string on_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string file = folder + "/" + name;
        std::error_code unknown;
        if (folder.starts_with('/') && access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file, unknown))
            return file;
    }
    return {};
}

/// What JOSTLE_PYTHON names; else the python3 of PATH, which hands over to another where it lacks what a program needs
/// (presentation/other_python.py); else Debian's.
std::string python_to_start() {
    const char* chosen = std::getenv("JOSTLE_PYTHON");
    if (!chosen || !*chosen) {
        const std::string found = on_path("python3");
        return found.empty() ? "/usr/bin/python3" : found;
    }
    if (std::strchr(chosen, '/')) return chosen;
    const std::string found = on_path(chosen);
    if (found.empty()) throw refused_file(chosen, "PATH has no such program", advice);
    return found;
}

}  // namespace

ExitCode python_program(const std::string& program, const std::vector<std::string>& arguments) {
    const std::string python = python_to_start();
    // -B: nothing is written next to the programs, which may be installed for everyone.
    std::vector<std::string> words = {python, "-B", path_of("presentation/start"), path_of(program)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::fflush(nullptr);
    execv(python.c_str(), pointers.data());
    throw refused_file(python, std::string("this Python does not start: ") + std::strerror(errno), advice);
}

std::string path_of_command() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
}
