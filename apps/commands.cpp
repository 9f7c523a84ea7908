#include "commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "check_command.hpp"
#include "frames_so_far.hpp"
#include "jostle/error/input_error.hpp"
#include "keys_command.hpp"
#include "python_program.hpp"
#include "run_command.hpp"
#include "stop_request.hpp"
#include "stress_command.hpp"
#include "sweep_options.hpp"
#include "verify_command.hpp"
#include "waiting_threads.hpp"
#include "wall_time.hpp"

// What a command reads is kept until the command line is read whole: each command owns its options by a shared pointer.

namespace {

using Texts = std::vector<std::string>;

std::string joined(int count, char** words) {
    std::string line;
    for (int k = 0; k < count; ++k) line += (k == 0 ? "" : " ") + std::string(words[k]);
    return line;
}

void add_scene(CLI::App& command, std::string& scene, Texts& settings) {
    command.add_option("scene", scene, "scene file (TOML)")->required();
    command
        .add_option(
            "--set", settings,
            "KEY=VALUE in the place of what the scene says, as --set box.volume_fraction=0.3; as often as you like")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_folder(CLI::App& command, std::string& folder) {
    command.add_option("folder", folder, "folder of a run")->required();
}

void add_wall_time(CLI::App& command, RunOptions& options) {
    command
        .add_option_function<std::string>(
            "--walltime", [&options](const std::string& text) { options.wall_time = seconds_of(text); },
            "stop, ready to go on, before this time is over: 23:50, 1:30:00, 24h, 90min or 1-12:00:00")
        ->check([](const std::string& text) {
            return seconds_of(text)
                       ? std::string{}
                       : "--walltime " + text + ": is no time; write 23:50, 1:30:00, 24h, 1h30min or 1-12:00:00";
        });
}

Command add_run_command(CLI::App& app, int argc, char** argv) {
    auto options = std::make_shared<RunOptions>();
    auto spin_waiting = std::make_shared<bool>(false);
    options->command_line = joined(argc, argv);
    CLI::App* run = app.add_subcommand("run", "Run a scene, or go on with a run of it that was stopped");
    add_scene(*run, options->scene, options->settings);
    run->add_option("--out", options->folder, "folder for the results; default: SCENE's name with .run");
    run->add_option("--threads", options->threads,
                    "number of threads, on which the result does not depend; default: one for every 2000 rods, at most "
                    "one a processor");
    add_wall_time(*run, *options);
    run->add_flag("--fresh", options->fresh, "start anew; an earlier run in the folder is moved aside, not deleted");
    CLI::Option* quiet = run->add_flag("--quiet", options->quiet, "print errors only");
    run->add_flag("--json", options->json, "print the summary as JSON, nothing else")->excludes(quiet);
    run->add_option(
           "--colours-per-exchange", options->colours_per_exchange,
           "ranks (of mpirun, srun) exchange velocities once in so many colours of a sweep, on which the result "
           "does not depend; default: as often as makes steps fastest")
        ->check(CLI::Range(1, 64));
    run->add_option("--ranks-write-above", options->ranks_write_above,
                    "where ranks have more rods than this together, every rank writes its part of frames and "
                    "checkpoints, which have the same bytes; all ranks must see the folder then; default: 1e8")
        ->check(CLI::Range(0.0, 1e18));
    run->add_flag("--alone", options->alone,
                  "one process makes this run, though a launcher (mpirun, srun) has started several");
    run->add_flag("--spin-waiting", *spin_waiting,
                  "let threads that wait keep their processors for milliseconds, where nothing else wants them");
    run->footer(app.get_footer());
    return {run, [=] { return run_command(*options); },
            [=] {
                if (!*spin_waiting) limit_spin_waiting(argv);
                stop_request::install();
            }};
}

Command add_check_command(CLI::App& app) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* check = app.add_subcommand("check", "Validate a scene and print what follows from it; runs nothing");
    add_scene(*check, options->scene, options->settings);
    return {check, [=] { return check_command(options->scene, options->settings); }};
}

Command add_keys_command(CLI::App& app) {
    auto json = std::make_shared<bool>(false);
    CLI::App* keys = app.add_subcommand("keys", "List the keys of a scene, with what each admits");
    keys->add_flag("--json", *json, "print JSON");
    return {keys, [=] { return keys_command(*json); }};
}

Command add_verify_command(CLI::App& app) {
    auto folder = std::make_shared<std::string>();
    CLI::App* verify = app.add_subcommand("verify", "Check the files of a run for damage");
    add_folder(*verify, *folder);
    return {verify, [=] { return verify_command(*folder); }};
}

Command add_stress_command(CLI::App& app) {
    auto options = std::make_shared<StressOptions>();
    CLI::App* stress = app.add_subcommand("stress", "Stress of contacts that another program found");
    stress->add_option("contacts", options->contacts, "contacts: CSV or HDF5 (docs/guide/stress_formula.md)")
        ->required();
    stress->add_option("--bodies", options->bodies, "bodies: CSV or HDF5")->required();
    CLI::Option* box =
        stress->add_option("--box", options->box, "edges of the box, which give its volume")->expected(3);
    stress->add_option("--periodic", options->periodic, "directions in which the box is periodic, or none")
        ->needs(box)
        ->capture_default_str();
    stress->add_option("--volume", options->volume, "volume to divide by; without it, stress times volume is given")
        ->excludes(box);
    stress->add_option("--convention", options->convention, "rigid_body, centre_of_mass_virial or centre_line")
        ->capture_default_str();
    stress->add_option("--per-body", options->per_body, "write the stress of each body to this file (CSV)");
    stress->add_option("--length-unit", options->length_unit,
                       "name of the unit of length; default: what the files say");
    stress->add_option("--force-unit", options->force_unit, "name of the unit of force; default: what the files say");
    stress->add_flag("--json", options->json, "print JSON");
    return {stress, [=] { return stress_command(*options); }};
}

Command add_export_command(CLI::App& app) {
    struct Options {
        std::string folder, format, out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* exporter = app.add_subcommand("export", "Write the rods of a run for OVITO, ParaView and others");
    add_folder(*exporter, options->folder);
    exporter->add_option("--to", options->format, "gsd (OVITO, freud), vtk (ParaView) or xyz (OVITO, ASE)")->required();
    exporter->add_option("--out", options->out, "file or, for vtk, folder; default: in the folder of the run");
    return {exporter, [=] {
                return python_program("presentation/export",
                                      {"--to=" + options->format, "--out=" + options->out, "--", options->folder});
            }};
}

/// What `report` and `movie` share.
struct PictureOptions {
    std::string folder, out, view, colour;
};

void add_pictures(CLI::App& command, PictureOptions& options) {
    add_folder(command, options.folder);
    command.add_option("--view", options.view, "look along x, y or z; default: from above and aside");
    command.add_option("--colour", options.colour, "direction, angle, speed, ...; default: what suits the run");
}

/// What is drawn in the place of trajectory.h5; empty: nothing. What is damaged is said, and the page made without it.
std::string frames_of(const PictureOptions& options) {
    try {
        const std::string beside =
            options.out.empty() ? options.folder : std::filesystem::absolute(options.out).parent_path().string();
        const std::optional<int> frames = frames_so_far(options.folder, beside);
        return frames ? fmt::format("/dev/fd/{}", *frames) : "";
    } catch (const jostle::InputError& error) {
        fmt::print(stderr, "jostle: {}\n", error.what());
        return "";
    }
}

/// Hands over to a program of presentation/, with its own words before those that all have.
ExitCode draw(const std::string& program, Texts words, const PictureOptions& options) {
    for (const std::string& word :
         {"--view=" + options.view, "--colour=" + options.colour, "--frames=" + frames_of(options),
          "--out=" + options.out, std::string("--"), options.folder})
        words.push_back(word);
    return python_program("presentation/" + program, words);
}

Command add_report_command(CLI::App& app) {
    struct Options : PictureOptions {
        std::string width = "1600", megabytes = "20", frame = "-1";
    };
    auto options = std::make_shared<Options>();
    CLI::App* report =
        app.add_subcommand("report", "Make a page that shows a run: rods to turn, plots to zoom, averages");
    add_pictures(*report, *options);
    report->add_option("--out", options->out, "folder for the page and its pictures; default: report in the run's");
    report->add_option("--width", options->width, "width of the still picture of the rods, in pixels")
        ->capture_default_str();
    report->add_option("--megabytes", options->megabytes, "room for the rods in the page; of more frames it holds some")
        ->capture_default_str();
    report->add_option("--frame", options->frame, "what to begin with: number of a frame, from 0, or from -1 backwards")
        ->capture_default_str();
    return {report, [=] {
                return draw(
                    "report",
                    {"--width=" + options->width, "--megabytes=" + options->megabytes, "--frame=" + options->frame},
                    *options);
            }};
}

Command add_movie_command(CLI::App& app) {
    struct Options : PictureOptions {
        std::string size = "1280x720", fps = "12";
    };
    auto options = std::make_shared<Options>();
    CLI::App* movie = app.add_subcommand("movie", "Make a film of a run: one camera, one scale of colours");
    add_pictures(*movie, *options);
    movie->add_option("--out", options->out, "MP4 file; default: movie.mp4 in the folder of the run");
    movie->add_option("--size", options->size, "width and height in pixels")->capture_default_str();
    movie->add_option("--fps", options->fps, "pictures a second")->capture_default_str();
    return {movie, [=] { return draw("movie", {"--size=" + options->size, "--fps=" + options->fps}, *options); }};
}

/// Those of sweeps/: `add` gives the command its words.
Command add_command_of_sweeps(CLI::App& app, CLI::App* (*add)(CLI::App&, SweepOptions&), const char* typed) {
    auto options = std::make_shared<SweepOptions>();
    CLI::App* command = add(app, *options);
    return {command, [=] { return sweep_command(command->get_name(), *options, typed); }};
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app, int argc, char** argv) {
    return {add_run_command(app, argc, argv),
            add_check_command(app),
            add_keys_command(app),
            add_verify_command(app),
            add_export_command(app),
            add_report_command(app),
            add_movie_command(app),
            add_command_of_sweeps(app, add_sweep_command, argv[0]),
            add_command_of_sweeps(app, add_collect_command, argv[0]),
            add_command_of_sweeps(app, add_extrapolate_command, argv[0]),
            add_stress_command(app)};
}
