#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "check_command.hpp"
#include "exit_code.hpp"
#include "frames_so_far.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/error/one_line.hpp"
#include "jostle/run_files/version.hpp"
#include "keys_command.hpp"
#include "python_program.hpp"
#include "run_command.hpp"
#include "standard_streams.hpp"
#include "stop_request.hpp"
#include "stress_command.hpp"
#include "sweep_options.hpp"
#include "verify_command.hpp"
#include "waiting_threads.hpp"
#include "wall_time.hpp"

namespace {

std::string joined(int count, char** words) {
    std::string line;
    for (int k = 0; k < count; ++k) line += (k == 0 ? "" : " ") + std::string(words[k]);
    return line;
}

constexpr std::size_t longest_refusal = 500;  // bytes

constexpr const char* footer =
    "Exit status: 0 done, 1 internal error, 2 bad input, 3 contacts not resolved or overlap above the limit,\n"
    "4 disk, 75 stopped early (run the same command again to go on).";

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
    command
        .add_option(
            "--set", settings,
            "KEY=VALUE in the place of what the scene says, as --set box.volume_fraction=0.3; as often as you like")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

CLI::App* add_stress_command(CLI::App& app, StressOptions& options) {
    CLI::App* stress = app.add_subcommand("stress", "Stress of contacts that another program found");
    stress->add_option("contacts", options.contacts, "contacts: CSV or HDF5 (docs/guide/stress_formula.md)")
        ->required();
    stress->add_option("--bodies", options.bodies, "bodies: CSV or HDF5")->required();
    CLI::Option* box = stress->add_option("--box", options.box, "edges of the box, which give its volume")->expected(3);
    stress->add_option("--periodic", options.periodic, "directions in which the box is periodic, or none")
        ->needs(box)
        ->capture_default_str();
    stress->add_option("--volume", options.volume, "volume to divide by; without it, stress times volume is given")
        ->excludes(box);
    stress->add_option("--convention", options.convention, "rigid_body, centre_of_mass_virial or centre_line")
        ->capture_default_str();
    stress->add_option("--per-body", options.per_body, "write the stress of each body to this file (CSV)");
    stress->add_option("--length-unit", options.length_unit, "name of the unit of length; default: what the files say");
    stress->add_option("--force-unit", options.force_unit, "name of the unit of force; default: what the files say");
    stress->add_flag("--json", options.json, "print JSON");
    return stress;
}

/// What `report` draws in the place of trajectory.h5; empty: nothing. What is damaged is said, and the page made
/// without it.
std::string frames_of(const std::string& folder, const std::string& out) {
    try {
        const std::string beside = out.empty() ? folder : std::filesystem::absolute(out).parent_path().string();
        const std::optional<int> frames = frames_so_far(folder, beside);
        return frames ? fmt::format("/dev/fd/{}", *frames) : "";
    } catch (const jostle::InputError& error) {
        fmt::print(stderr, "jostle: {}\n", error.what());
        return "";
    }
}

/// Reads the command line, and does what it says.
ExitCode obey(int argc, char** argv) {
    CLI::App app{"jostle: collision stress of assemblies of rods"};
    app.set_version_flag("--version", std::string("jostle ") + jostle::program_version + " (" + jostle::program_commit +
                                          ", " + jostle::program_compiler + ")");
    app.require_subcommand(1);
    app.footer(footer);

    RunOptions options;
    options.command_line = joined(argc, argv);
    std::string wall_time;
    CLI::App* run = app.add_subcommand("run", "Run a scene, or go on with a run of it that was stopped");
    run->add_option("scene", options.scene, "scene file (TOML)")->required();
    add_settings(*run, options.settings);
    run->add_option("--out", options.folder, "folder for the results; default: SCENE's name with .run");
    run->add_option("--threads", options.threads,
                    "number of threads, on which the result does not depend; default: one for every 2000 rods, at most "
                    "one a processor");
    run->add_option("--walltime", wall_time,
                    "stop, ready to go on, before this time is over: 23:50, 1:30:00, 24h, 90min or 1-12:00:00")
        ->check([](const std::string& text) {
            return seconds_of(text)
                       ? std::string{}
                       : "--walltime " + text + ": is no time; write 23:50, 1:30:00, 24h, 1h30min or 1-12:00:00";
        });
    run->add_flag("--fresh", options.fresh, "start anew; an earlier run in the folder is moved aside, not deleted");
    CLI::Option* quiet = run->add_flag("--quiet", options.quiet, "print errors only");
    run->add_flag("--json", options.json, "print the summary as JSON, nothing else")->excludes(quiet);
    run->footer(footer);

    std::string scene;
    CLI::App* check = app.add_subcommand("check", "Validate a scene and print what follows from it; runs nothing");
    check->add_option("scene", scene, "scene file (TOML)")->required();
    add_settings(*check, options.settings);

    bool keys_as_json = false;
    CLI::App* keys = app.add_subcommand("keys", "List the keys of a scene, with what each admits");
    keys->add_flag("--json", keys_as_json, "print JSON");

    std::string folder;
    CLI::App* verify = app.add_subcommand("verify", "Check the files of a run for damage");
    verify->add_option("folder", folder, "folder of a run")->required();

    std::string format, out;
    CLI::App* exporter = app.add_subcommand("export", "Write the rods of a run for OVITO, ParaView and others");
    exporter->add_option("folder", folder, "folder of a run")->required();
    exporter->add_option("--to", format, "gsd (OVITO, freud), vtk (ParaView) or xyz (OVITO, ASE)")->required();
    exporter->add_option("--out", out, "file or, for vtk, folder; default: in the folder of the run");

    std::string width = "1600", megabytes = "20";
    CLI::App* report =
        app.add_subcommand("report", "Make a page that shows a run: rods to turn, plots to zoom, averages");
    report->add_option("folder", folder, "folder of a run")->required();
    report->add_option("--out", out, "folder for the page and its pictures; default: report in the folder of the run");
    report->add_option("--width", width, "width of the still picture of the rods, in pixels")->capture_default_str();
    report->add_option("--megabytes", megabytes, "room for the rods in the page; of more frames it holds some")
        ->capture_default_str();

    std::string frame = "-1", view, colour;
    report->add_option("--frame", frame, "what to begin with: number of a frame, from 0, or from -1 backwards")
        ->capture_default_str();
    CLI::App* movie = app.add_subcommand("movie", "Make a film of a run: one camera, one scale of colours");
    movie->add_option("folder", folder, "folder of a run")->required();
    movie->add_option("--out", out, "MP4 file; default: movie.mp4 in the folder of the run");
    std::string size = "1280x720", fps = "12";
    movie->add_option("--size", size, "width and height in pixels")->capture_default_str();
    movie->add_option("--fps", fps, "pictures a second")->capture_default_str();
    for (CLI::App* pictures : {report, movie}) {
        pictures->add_option("--view", view, "look along x, y or z; default: from above and aside");
        pictures->add_option("--colour", colour, "direction, angle, speed, ...; default: what suits the run");
    }

    SweepOptions sweep_options;
    CLI::App* sweep = add_sweep_command(app, sweep_options);
    CLI::App* collect = add_collect_command(app, sweep_options);
    CLI::App* extrapolate = add_extrapolate_command(app, sweep_options);

    StressOptions stress_options;
    CLI::App* stress = add_stress_command(app, stress_options);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {  // help or version
            app.exit(error);
            return ExitCode::done;
        }
        const auto parsed = app.get_subcommands();
        std::fprintf(stderr, "jostle: %s. `jostle %s--help` tells what it takes\n",
                     jostle::on_one_line(error.what(), longest_refusal).c_str(),
                     parsed.empty() ? "" : (parsed[0]->get_name() + " ").c_str());
        return ExitCode::bad_input;
    }
    options.wall_time = seconds_of(wall_time);
    if (run->parsed()) return run_command(options);
    if (check->parsed()) return check_command(scene, options.settings);
    if (keys->parsed()) return keys_command(keys_as_json);
    if (stress->parsed()) return stress_command(stress_options);
    for (const CLI::App* command : {sweep, collect, extrapolate})
        if (command->parsed()) return sweep_command(command->get_name(), sweep_options, argv[0]);
    if (verify->parsed()) return verify_command(folder);
    if (exporter->parsed())
        return python_program("presentation/export", {"--to=" + format, "--out=" + out, "--", folder});
    if (movie->parsed())
        return python_program("presentation/movie",
                              {"--size=" + size, "--fps=" + fps, "--view=" + view, "--colour=" + colour,
                               "--frames=" + frames_of(folder, out), "--out=" + out, "--", folder});
    return python_program("presentation/report",
                          {"--width=" + width, "--megabytes=" + megabytes, "--frame=" + frame, "--view=" + view,
                           "--colour=" + colour, "--frames=" + frames_of(folder, out), "--out=" + out, "--", folder});
}

}  // namespace

int main(int argc, char** argv) {
    stop_request::hold();
    open_standard_streams();
    give_way_to_other_programs(argv);
    if (argc > 1 && std::string_view(argv[1]) == "run") stop_request::install();
    stop_request::release();
    return exit_status([&] { return obey(argc, argv); });
}
