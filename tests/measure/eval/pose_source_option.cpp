#include "tests/measure/eval/pose_source_option.h"

#include <map>
#include <string>

namespace mfar::eval {

void addPoseSource(CLI::App& sub, PoseSource& source) {
    const std::map<std::string, PoseSource> sources{
        {"recorded", PoseSource::Recorded}, {"tags", PoseSource::Tags}, {"none", PoseSource::None}};
    sub.add_option_function<std::string>(
           "--poses", [&source, sources](const std::string& name) { source = sources.at(name); },
           "source of the poses that the methods get: recorded: the recording (default); tags: the "
           "tracker, which detects the tags of the recording's tags.toml in every picture, stills "
           "included; none: no poses")
        ->check(CLI::IsMember({"recorded", "tags", "none"}))
        ->option_text("recorded|tags|none");
}

}  // namespace mfar::eval
