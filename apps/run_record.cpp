#include "run_record.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <ctime>
#include <fstream>

#include "jostle/disk/durable_file.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/run_files/version.hpp"
#include "parsed_json.hpp"
#include "sealed_json.hpp"

using Json = nlohmann::ordered_json;

namespace {

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

/// The sessions of an earlier record; a record that cannot be read is only history, so nothing hangs on it.
Json sessions_of(const std::string& path) {
    Json sessions = Json::array();
    if (!jostle::file_exists(path)) return sessions;
    const Json record = parsed_json(jostle::read_file(path));
    if (!record.is_object() || !record.contains("sessions") || !record["sessions"].is_array()) return sessions;
    for (const Json& session : record["sessions"])
        if (session.is_object()) sessions.push_back(session);
    return sessions;
}

/// How an earlier record says that the run started; null where it does not.
Json start_of(const std::string& path) {
    if (!jostle::file_exists(path)) return nullptr;
    const Json record = parsed_json(jostle::read_file(path));
    const bool tells = record.is_object() && record.contains("start") && record["start"].is_object();
    return tells ? record["start"] : Json(nullptr);
}

}  // namespace

std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

RunRecord::RunRecord(const jostle::RunDirectory& directory, const RunOptions& options, const Together& together,
                     Json start)
    : directory_(directory),
      earlier_sessions_(sessions_of(directory.file("run.json"))),
      start_(start.is_null() ? start_of(directory.file("run.json")) : std::move(start)),
      command_line_(options.command_line),
      ranks_(together.ranks().count()),
      hosts_(together.hosts()),
      started_(utc_now()),
      began_(seconds_now()) {}

void RunRecord::write(const jostle::Simulation& simulation, const std::string& exit_reason) {
    if (!begun_) first_step_ = simulation.clock().step;
    begun_ = true;
    Json record = {{"program", "jostle"},
                   {"version", jostle::program_version},
                   {"git", jostle::program_commit},
                   {"compiler", jostle::program_compiler},
                   {"seed", simulation.settings().seed},
                   {"time_step", simulation.settings().time_step},
                   {"steps", simulation.clock().step},
                   {"exit_reason", exit_reason},
                   {"start", start_},
                   {"sessions", earlier_sessions_}};
    record["sessions"].push_back({{"started", started_},
                                  {"command", command_line_},
                                  {"host", host_name()},
                                  {"processor", processor()},
                                  {"ranks", ranks_},
                                  {"threads", jostle::parallel::thread_count()},
                                  {"first_step", first_step_},
                                  {"last_step", simulation.clock().step},
                                  {"wall_seconds", seconds_now() - began_},
                                  {"exit_reason", exit_reason}});
    if (ranks_ > 1) {
        record["sessions"].back()["colours_per_exchange"] = simulation.colours_per_exchange();
        record["sessions"].back()["hosts"] = hosts_;
    }
    jostle::replace_file(directory_.file("run.json"), sealed_json(record));
}
