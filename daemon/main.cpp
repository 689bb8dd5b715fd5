#include "daemon/app.h"
#include "daemon/exit_code.h"
#include "daemon/journal.h"
#include "daemon/log.h"
#include "daemon/options.h"
#include "daemon/restart_pause.h"
#include "daemon/rig.h"
#include "daemon/rig_cameras.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

int main(int argc, char** argv) {
    using namespace mfar;
    const Timestamp started = Timestamp::now();
    Log log(STDERR_FILENO, Log::styleOf(STDERR_FILENO), &Timestamp::now, Journal());
    // libcamera tells standard error by itself how it is; what is wrong, we say.
    setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
    try {
        const CommandLine line = parseCommandLine(argc, argv);
        if (line.print) {
            fmt::print("{}", *line.print);
            return static_cast<int>(ExitCode::Ok);
        }
        if (line.options.checkConfig) {
            (void)effectiveConfig(line.options);
            fmt::print("ok\n");
            return static_cast<int>(ExitCode::Ok);
        }
        if (line.options.releaseTrigger) {
            // The file may have been changed since the service took its line.
            const std::optional<TriggerLineConfig> taken = takenLine();
            releaseTrigger(taken ? *taken : effectiveConfig(line.options).cameras.trigger);
            return static_cast<int>(ExitCode::Ok);
        }
        App app(line.options, log);
        return static_cast<int>(app.run());
    } catch (const std::exception& error) {
        log.endStatus();
        log.error(error.what(), {message::kFailed});
        pauseBeforeRestart(exitCode(error), error.what(), started, log);
        return static_cast<int>(exitCode(error));
    }
}
