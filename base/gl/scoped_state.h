#pragma once

#include "base/geometry.h"
#include "base/gl/gl.h"

namespace mfar::gpu {

/// Enables a capability of the context while the object exists.
template <GLenum Capability>
class Enabled {
public:
    Enabled() { glEnable(Capability); }
    Enabled(const Enabled&) = delete;
    Enabled& operator=(const Enabled&) = delete;
    ~Enabled() { glDisable(Capability); }
};

/// Limits draws and clears to these pixels of the target. The rectangle must not be empty.
class Scissor {
public:
    explicit Scissor(const PixelRect& r) { glScissor(r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0); }

private:
    Enabled<GL_SCISSOR_TEST> test_;
};

/// Keeps the nearest surface, by window depth.
class DepthTest {
public:
    DepthTest() { glDepthFunc(GL_LESS); }

private:
    Enabled<GL_DEPTH_TEST> test_;
};

/// Every fragment drawn writes its depth, without a test.
class DepthWritten {
public:
    DepthWritten() { glDepthFunc(GL_ALWAYS); }

private:
    Enabled<GL_DEPTH_TEST> test_;
};

/// Triangles whose corners run counter-clockwise in a picture with row 0 on top are not drawn: a
/// solid's faces seen from the inside.
class InsidesCulled {
public:
    InsidesCulled() {
        glCullFace(GL_BACK);
        glFrontFace(GL_CW);
    }
    ~InsidesCulled() { glFrontFace(GL_CCW); }

private:
    Enabled<GL_CULL_FACE> cull_;
};

/// target = drawn + (1 - drawn alpha) * target.
class PremultipliedBlend {
public:
    PremultipliedBlend() { glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); }

private:
    Enabled<GL_BLEND> blend_;
};

}  // namespace mfar::gpu
