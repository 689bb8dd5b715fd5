// Sets the trigger line to its inactive level. systemd runs this program whenever mfard has ended,
// because mfard may have crashed during a trigger pulse. It is a program of its own because it must
// end at once: mfard loads ten times as many libraries.

#include "daemon/exit_code.h"
#include "daemon/rig_trigger.h"
#include "daemon/taken_line.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

int main() {
    using namespace mfar;
    try {
        const std::filesystem::path file = takenLineFile();
        if (file.empty())
            throw Failure(ExitCode::Usage, "RUNTIME_DIRECTORY must be an absolute path");
        releaseTrigger(takenLine(file).value_or(TriggerLineConfig{}));
        return static_cast<int>(ExitCode::Ok);
    } catch (const std::exception& error) {
        fmt::print(stderr, "the trigger line was not released: {}\n", error.what());
        return static_cast<int>(exitCode(error));
    }
}
