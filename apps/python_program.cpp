#include "python_program.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

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

}  // namespace

ExitCode python_program(const std::string& program, const std::vector<std::string>& arguments) {
    // -B: nothing is written next to the programs, which may be installed for everyone.
    std::vector<std::string> words = {JOSTLE_PYTHON, "-B", path_of(program)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::fflush(nullptr);
    execv(JOSTLE_PYTHON, pointers.data());
    throw refused_file(JOSTLE_PYTHON, std::string("this Python does not start: ") + std::strerror(errno),
                       "Run: apt-get install python3");
}

std::string path_of_command() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
}
