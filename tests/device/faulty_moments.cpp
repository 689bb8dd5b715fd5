#include "tests/device/faulty_moments.h"

#include "gles_shaders/shaders.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace mfar::faulty {
namespace {

// True once a test has called mfarFaultyGlLoseAt(). Without a test, no moments are recorded,
// because the list would grow while mfard runs.
bool isAsked = false;
std::string loseAt;  // name of the moment at which the context is lost; empty: none
std::vector<std::string> moments;
std::map<unsigned, std::string> shaders, programs;
std::string current;

}  // namespace

bool isLostAt(const char* function) {
    if (!isAsked) return false;
    moments.push_back(std::string(function) + " " + current);
    if (moments.back() != loseAt) return false;
    loseAt.clear();
    return true;
}

void sourceOf(unsigned shader, const char* text) {
    for (const mfar::shaders::Source& one : mfar::shaders::all())
        if (one.text == text) shaders[shader] = one.name;
}

// For a program that draws, this is called twice: for its vertex shader, then for its fragment
// shader. So the program has the fragment shader's name.
void attached(unsigned program, unsigned shader) {
    programs[program] = shaders[shader];
}

void used(unsigned program) {
    current = programs[program];
}

}  // namespace mfar::faulty

using namespace mfar::faulty;

void mfarFaultyGlLoseAt(const char* name) {
    isAsked = true;
    moments.clear();
    current.clear();
    loseAt = name != nullptr ? name : "";
}

const char* mfarFaultyGlMoment(int i) {
    const auto index = static_cast<std::size_t>(i);
    return index < moments.size() ? moments[index].c_str() : nullptr;
}
