#include "daemon/exit_code.h"
#include "daemon/taken_line.h"
#include "tests/fuzz/file_bundle.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mfar;
    const test::FileBundle bundle(data, size, {"trigger"});
    try {
        const auto line = takenLine(bundle.folder() / "trigger");
        if (!line) return 0;
        noteTakenLine(bundle.folder() / "again", *line);
        test::requireThat(takenLine(bundle.folder() / "again") == line,
                          "a saved note about the trigger line differs when read again");
    } catch (const Failure&) {
        return 0;
    }
    return 0;
}
