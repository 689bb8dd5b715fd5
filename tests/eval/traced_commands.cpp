#include "tests/eval/traced_commands.h"

#include "tests/eval/slicing_command.h"

#include <memory>

namespace mfar::eval {

std::vector<EvalCommand> addTracedCommands(CLI::App& app, std::string& csv) {
    const auto slicing = std::make_shared<SlicingRequest>();
    std::vector<EvalCommand> out{
        {addSlicingCommand(app, *slicing), [slicing] { return evaluateSlicing(*slicing); }}};
    for (const EvalCommand& traced : out)
        traced.command->add_option("--csv", csv, "file for the table");
    return out;
}

}  // namespace mfar::eval
