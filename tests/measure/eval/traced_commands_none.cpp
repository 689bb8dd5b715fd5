#include "tests/measure/eval/traced_commands.h"

namespace mfar::eval {

std::vector<EvalCommand> addTracedCommands(CLI::App& /*app*/, std::string& /*csv*/) {
    return {};
}

}  // namespace mfar::eval
