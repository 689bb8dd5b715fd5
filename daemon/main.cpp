#include "daemon/after_output.h"
#include "daemon/app.h"
#include "daemon/exit_code.h"
#include "daemon/journal.h"
#include "daemon/log.h"
#include "daemon/options.h"
#include "daemon/restart_pause.h"
#include "daemon/rig_messages.h"
#include "daemon/rig_trigger.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>

namespace {

int afterPrinting() {
    return mfar::afterOutput(0, "mfard", static_cast<int>(mfar::ExitCode::OutputFailed));
}

}  // namespace

int main(int argc, char** argv) {
    using namespace mfar;
    const Timestamp started = Timestamp::now();
    Log log(STDERR_FILENO, Log::styleOf(STDERR_FILENO), &Timestamp::now, Journal());
    const LibcameraLog libcameraLog = libcameraLogIn(log);
    try {
        const CommandLine line = parseCommandLine(argc, argv);
        if (line.print) {
            std::fputs(line.print->c_str(), stdout);
            return afterPrinting();
        }
        if (line.options.checkConfig) {
            for (const std::string& note : notesOf(usableConfig(line.options)))
                log.warning(note);
            std::puts("ok");
            return afterPrinting();
        }
        if (line.options.releaseTrigger) {
            releaseTrigger(effectiveConfig(line.options).cameras.trigger);
            return static_cast<int>(ExitCode::Ok);
        }
        const ExitCode code = App(line.options, log).run();
        // Logs the messages that libcamera repeated while the cameras were closed.
        log.endStatus();
        return static_cast<int>(code);
    } catch (const std::exception& error) {
        log.endStatus();
        log.error(error.what(), {message::kFailed});
        pauseBeforeRestart(exitCode(error), error.what(), started, log);
        return static_cast<int>(exitCode(error));
    }
}
