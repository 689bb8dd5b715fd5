#include "tests/measure/eval/pose_source_option.h"

#include <map>
#include <string>

namespace mfar::eval {

void addPoseSource(CLI::App& sub, PoseSource& source) {
    const std::map<std::string, PoseSource> sources{
        {"recorded", PoseSource::Recorded}, {"tags", PoseSource::Tags}, {"none", PoseSource::None}};
    sub.add_option_function<std::string>(
           "--poses", [&source, sources](const std::string& name) { source = sources.at(name); },
           "poses that the methods get: recorded (default), tags (found by the tracker in the "
           "pictures with tags.toml; a still's pose is found in the still itself) or none")
        ->check(CLI::IsMember({"recorded", "tags", "none"}))
        ->option_text("recorded|tags|none");
}

}  // namespace mfar::eval
