#pragma once

#include "base/geometry.h"
#include "base/gl/gl.h"

namespace mfar::gpu {

template <GLenum Capability>
class Enabled {
public:
    Enabled() { glEnable(Capability); }
    Enabled(const Enabled&) = delete;
    Enabled& operator=(const Enabled&) = delete;
    ~Enabled() { glDisable(Capability); }
};

/// While this object exists, draws and clears change only a rectangle of the target. The rectangle
/// must not be empty.
class Scissor {
public:
    explicit Scissor(const PixelRect& r) { glScissor(r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0); }

private:
    Enabled<GL_SCISSOR_TEST> test_;
};

class DepthTest {
public:
    DepthTest() { glDepthFunc(GL_LESS); }

private:
    Enabled<GL_DEPTH_TEST> test_;
};

/// While this object exists, every fragment passes the depth test and writes its depth.
class DepthWritten {
public:
    DepthWritten() { glDepthFunc(GL_ALWAYS); }

private:
    Enabled<GL_DEPTH_TEST> test_;
};

/// While this object exists, triangles whose corners run clockwise in the picture (row 0 is on top)
/// are not drawn. These are the faces of a solid that are seen from the inside.
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

/// Blends with premultiplied alpha: target = drawn colour + (1 - drawn alpha) * target.
class PremultipliedBlend {
public:
    PremultipliedBlend() { glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); }

private:
    Enabled<GL_BLEND> blend_;
};

}  // namespace mfar::gpu
