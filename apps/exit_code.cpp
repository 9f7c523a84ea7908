#include "exit_code.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"
#include "standard_streams.hpp"

int exit_status(const std::function<ExitCode()>& command, const std::string& who) {
    const auto fail = [&who](ExitCode code, const char* what) {
        std::fprintf(stderr, "jostle: %s%s\n", who.c_str(), what);
        return static_cast<int>(code);
    };
    try {
        const ExitCode code = command();
        const std::string failure = output_failure();
        if (code == ExitCode::done && !failure.empty()) return fail(ExitCode::disk, failure.c_str());
        return static_cast<int>(code);
    } catch (const jostle::InputError& error) {
        return fail(ExitCode::bad_input, error.what());
    } catch (const jostle::DiskError& error) {
        return fail(ExitCode::disk, error.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::internal, "out of memory; `jostle check SCENE.toml` estimates what a scene needs");
    } catch (const std::exception& error) {
        return fail(ExitCode::internal, error.what());
    }
}
