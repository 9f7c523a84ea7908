#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "commands.hpp"
#include "exit_code.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/run_files/version.hpp"
#include "standard_streams.hpp"
#include "stop_request.hpp"

namespace {

constexpr std::size_t longest_refusal = 500;  // bytes

constexpr const char* footer =
    "Exit status: 0 done, 1 internal error, 2 bad input, 3 contacts not resolved or overlap above the limit,\n"
    "4 disk, 75 stopped early (run the same command again to go on).";

/// Help or version, which were asked for; or what is wrong with the command line.
ExitCode told(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
        app.exit(error);
        return ExitCode::done;
    }
    const auto parsed = app.get_subcommands();
    std::fprintf(stderr, "jostle: %s. `jostle %s--help` tells what it takes\n",
                 jostle::on_one_line(error.what(), longest_refusal).c_str(),
                 parsed.empty() ? "" : (parsed[0]->get_name() + " ").c_str());
    return ExitCode::bad_input;
}

/// Reads the command line, and does what it says.
ExitCode obey(int argc, char** argv) {
    CLI::App app{"jostle: collision stress of assemblies of rods"};
    app.set_version_flag("--version", std::string("jostle ") + jostle::program_version + " (" + jostle::program_commit +
                                          ", " + jostle::program_compiler + ")");
    app.require_subcommand(1);
    app.footer(footer);
    const std::vector<Command> commands = add_commands(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return told(app, error);
    }
    const auto asked =
        std::find_if(commands.begin(), commands.end(), [](const Command& c) { return c.words->parsed(); });
    asked->begin();
    stop_request::release();
    return asked->carry_out();
}

}  // namespace

int main(int argc, char** argv) {
    stop_request::hold();
    open_standard_streams();
    return exit_status([&] { return obey(argc, argv); });
}
