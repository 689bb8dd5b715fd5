#include "tests/measure/eval/traced_commands.h"

#include "daemon/output_checks.h"
#include "tests/measure/eval/slicing_command.h"
#include "tests/measure/eval/traced_command.h"
#include "tests/measure/eval/warp_command.h"

#include <memory>

namespace mfar::eval {

std::vector<EvalCommand> addTracedCommands(CLI::App& app, std::string& csv) {
    const auto slicing = std::make_shared<SlicingRequest>();
    const auto warp = std::make_shared<WarpRequest>();
    const auto files = std::make_shared<WarpFiles>();
    const auto traced = std::make_shared<TracedRequest>();
    std::vector<EvalCommand> out{
        {addSlicingCommand(app, *slicing),
         [=](const ProgressPart& progress) {
             slicing->progress = progress;
             return evaluateSlicing(*slicing);
         },
         true},
        {addWarpCommand(app, *warp, *files),
         [=](const ProgressPart& progress) {
             warp->progress = progress;
             return runWarpCommand(*warp, *files);
         },
         true},
        {addTracedCommand(app, *traced), [=](const ProgressPart& progress) {
             traced->progress = progress;
             return runTracedCommand(*traced);
         }}};
    for (const EvalCommand& each : out)
        each.command->add_option("--csv", csv, "file to write the table into")
            ->check(fileToWrite());
    return out;
}

}  // namespace mfar::eval
