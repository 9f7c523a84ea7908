#include "sweep_options.hpp"

#include "python_program.hpp"

namespace {

void add_texts(CLI::App& command, const char* name, std::vector<std::string>& texts, const char* type,
               const char* words) {
    command.add_option(name, texts, words)->type_name(type)->allow_extra_args(false);
}

void add_runs(CLI::App& command, SweepOptions& options) {
    command.add_option("scene", options.scene, "scene file (TOML)")->required();
    command.add_option("--replicas", options.replicas,
                       "runs of each point, with seeds that follow the scene's; default: 1");
    command.add_option("--processes", options.processes, "runs at a time; default: one a processor");
}

void add_curves(CLI::App& command, SweepOptions& options) {
    add_texts(command, "--plot", options.plots, "NAME",
              "draw this average, as Z or nematic_order: PNG and SVG; as often as you like");
    command.add_option("--against", options.against, "key of the horizontal axis; default: the first that varies");
}

}  // namespace

CLI::App* add_sweep_command(CLI::App& app, SweepOptions& options) {
    CLI::App* sweep = app.add_subcommand("sweep", "Run a scene at many values of its keys, and with many seeds");
    add_runs(*sweep, options);
    add_texts(*sweep, "--set", options.settings, "KEY=V1,V2",
              "values of a key, as --set box.volume_fraction=0.1,0.2; of several keys every combination is run");
    sweep->add_flag("--zip", options.zip, "the first values of all keys together, then the second, and so on");
    sweep->add_option("--out", options.out, "folder for the runs and the table; default: SCENE's name with .sweep");
    add_curves(*sweep, options);
    sweep->add_flag("--print-commands", options.print_commands,
                    "run nothing: print the command of each run, for a job array");
    return sweep;
}

CLI::App* add_collect_command(CLI::App& app, SweepOptions& options) {
    CLI::App* collect = app.add_subcommand("collect", "Make one table (CSV) of runs");
    collect->add_option("folders", options.folders, "folders of runs, or folders that hold some")->required();
    collect->add_option("--out", options.out, "folder for the table and its pictures; default: the table is printed");
    add_curves(*collect, options);
    return collect;
}

CLI::App* add_extrapolate_command(CLI::App& app, SweepOptions& options) {
    CLI::App* extrapolate = app.add_subcommand("extrapolate", "Averages at time step 0, from runs at several steps");
    add_runs(*extrapolate, options);
    add_texts(*extrapolate, "--set", options.settings, "KEY=V1,V2", "values of a key; each is extrapolated");
    extrapolate->add_option("--rms-steps", options.rms_steps, "values of time.rms_step; default: 0.06,0.042,0.03");
    extrapolate->add_option("--out", options.out,
                            "folder for the runs and the table; default: SCENE's name with .extrapolate");
    return extrapolate;
}

ExitCode sweep_command(const std::string& command, const SweepOptions& options, const std::string& typed) {
    std::vector<std::string> words = {"--out=" + options.out};
    const auto add = [&](const char* name, const std::vector<std::string>& texts) {
        for (const std::string& text : texts) words.push_back("--" + std::string(name) + "=" + text);
    };
    add("plot", options.plots);
    if (command != "extrapolate") add("against", {options.against});
    if (command != "collect") {
        add("set", options.settings);
        add("jostle", {path_of_command()});
        add("replicas", {options.replicas});
        add("processes", {options.processes});
    }
    if (command == "extrapolate") add("rms-steps", {options.rms_steps});
    if (command == "sweep") {
        add("typed", {typed});
        if (options.zip) words.emplace_back("--zip");
        if (options.print_commands) words.emplace_back("--print-commands");
    }
    words.emplace_back("--");
    if (command == "collect")
        words.insert(words.end(), options.folders.begin(), options.folders.end());
    else
        words.push_back(options.scene);
    return python_program("sweeps/" + command, words);
}
