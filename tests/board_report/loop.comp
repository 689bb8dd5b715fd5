// samples/ contains the drivers' statistics of this shader. In a loop, the shader reads a texture
// and a storage buffer. After the loop, it writes the sum to the buffer.
layout(local_size_x = 4, local_size_y = 4) in;
layout(std430, binding = 0) buffer Sums {
    int count;
    float sums[];
};
layout(binding = 0) uniform sampler2D picture;

void main() {
    int at = int(gl_GlobalInvocationID.x);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) sum += texelFetch(picture, ivec2(i, at), 0).r * sums[at + i];
    sums[at] = sum;
}
