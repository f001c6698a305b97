// A window with light shafts by GLFW, glad and Tyndall, to copy. While Space is down there are none; Escape ends.
#include <glad/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <tyndall/tyndall.h>

#include <cmath>
#include <cstdio>

static GladGLContext gl;
static float slide; // of the roof
static const char* const kBoxVertex = R"(#version 330 core
uniform mat4 clipFromView;
uniform vec3 eye, boxes[38]; // of boxes centre and half size
out vec3 world;
void main() { // a cube as one strip of triangles
  ivec3 bits = ivec3(0x287A, 0x02AF, 0x31E3) >> gl_VertexID & 1;
  world = boxes[2 * gl_InstanceID] + boxes[2 * gl_InstanceID + 1] * (2 * bits - 1);
  gl_Position = clipFromView * vec4(world - eye, 1);
})";
static const char* const kDepthFragment = "#version 330 core\nvoid main() {}";
static const char* const kBoxFragment = R"(#version 330 core
uniform mat4 sunClipFromWorld;
uniform sampler2D shadowMap;
in vec3 world;
out vec4 colour;
void main() {
  vec3 place = (sunClipFromWorld * vec4(world, 1)).xyz * 0.5 + 0.5;
  float lit = float(texture(shadowMap, place.xy).r > place.z - 0.003);
  float upwards = max(normalize(cross(dFdx(world), dFdy(world))).y, 0);
  colour = vec4(vec3(0.5, 0.45, 0.4) * (lit * upwards * vec3(2.6, 2.2, 1.7) + 0.06), 1);
})";
static const char* const kTriangleVertex = R"(#version 330 core
void main() { gl_Position = vec4(gl_VertexID % 2 * 4 - 1, gl_VertexID / 2 * 4 - 1, 0, 1); })";
static const char* const kToneMapFragment = R"(#version 330 core
uniform sampler2D hdr;
out vec4 colour;
void main() { colour = vec4(pow(1 - exp(-texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb), vec3(1 / 2.2)), 1); })";

static GLuint program(const char* vertex, const char* fragment) {
  const GLuint name = gl.CreateProgram();
  for (const char* text : {vertex, fragment}) {
    const GLuint shader = gl.CreateShader(text == vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(name, shader);
  }
  gl.LinkProgram(name);
  return name;
}

static void allocate(GLuint texture, bool depth, int width, int height, GLuint framebuffer) {
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, depth ? GL_DEPTH_COMPONENT32F : GL_RGBA16F, width, height, 0,
                depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture(GL_FRAMEBUFFER, depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, texture, 0);
}

static void drawBoxes(GLuint program, const float (&clipFromView)[16], GLuint framebuffer, int width, int height) {
  std::vector<float> boxes = {0,  -0.1F, 0, 6,    0.1F, 9, 0, 2.5F, -9, 6,    3, 0.1F, // floor and walls
                              -6, 2.5F,  0, 0.1F, 3,    9, 6, 2.5F, 0,  0.1F, 3, 9};
  for (int i = 0; i < 15; ++i) // panels of the roof
    boxes.insert(boxes.end(), {3 * float(i % 5 - 2) + slide, 5, 6 * float(i % 3 - 1), 1.25F, 0.05F, 2.6F});
  gl.UseProgram(program);
  gl.UniformMatrix4fv(gl.GetUniformLocation(program, "clipFromView"), 1, GL_FALSE, clipFromView);
  gl.Uniform3fv(gl.GetUniformLocation(program, "boxes"), GLsizei(boxes.size() / 3), boxes.data());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_DEPTH_TEST);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 14, GLsizei(boxes.size() / 6));
  gl.Disable(GL_DEPTH_TEST);
}

static bool fail(const std::string& why) { return std::fprintf(stderr, "minimal-shafts: %s\n", why.c_str()) != 0; }

int main() {
  // A window, GL's functions, and an effect in the window's context.
  glfwInit();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* window = glfwCreateWindow(640, 360, "Tyndall", nullptr, nullptr);
  if (!window) return fail("no window with OpenGL 3.3");
  glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);
  glfwMakeContextCurrent(window);
  gladLoadGLContext(&gl, glfwGetProcAddress);
  const auto loader = [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
  const auto [effect, status] = tyndall::Effect::create({loader});
  if (!effect) return fail(status.message);

  // What engines have: programs, a shadow map, colour in HDR, depth.
  const GLuint toneMap = program(kTriangleVertex, kToneMapFragment), depthOnly = program(kBoxVertex, kDepthFragment),
               shaded = program(kBoxVertex, kBoxFragment);
  GLuint textures[3], framebuffers[2], vertexArray;
  gl.GenTextures(3, textures);
  gl.GenFramebuffers(2, framebuffers);
  gl.GenVertexArrays(1, &vertexArray);
  gl.BindVertexArray(vertexArray);
  const auto [shadowMap, colour, depth] = textures;
  allocate(shadowMap, true, 2048, 2048, framebuffers[0]);
  // Along (0.4, -1, 0.6) onto the floor: what x, y and z contribute, and the origin.
  const float sunClip[16] = {0.12F, 0, 0, 0, 0.048F, 0.06F, -0.3F, 0, 0, 0.1F, 0, 0, 0, 0, 0.8F, 1};
  gl.UseProgram(shaded);
  gl.UniformMatrix4fv(gl.GetUniformLocation(shaded, "sunClipFromWorld"), 1, GL_FALSE, sunClip);
  gl.Uniform3f(gl.GetUniformLocation(shaded, "eye"), 0, 1.7F, 8);

  // What Tyndall is told once.
  tyndall::Light sun;
  sun.direction = {0.4, -1, 0.6};
  sun.colour = {30, 24, 17};
  sun.shadow.texture = shadowMap;
  sun.shadow.views = {{tyndall::mat4(sunClip)}};
  tyndall::Frame frame;
  frame.colour = colour;
  frame.depth.texture = depth;
  frame.camera.viewFromWorld = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1.7, -8, 1};
  frame.lights = {sun};
  frame.medium.constituents = {{{0.02F, 0.02F, 0.02F}, tyndall::Phase::HenyeyGreenstein, 0.4F}};
  frame.medium.farDistance = 20; // of rays that leave through the roof

  while (!glfwWindowShouldClose(window) && !glfwGetKey(window, GLFW_KEY_ESCAPE)) {
    glfwPollEvents();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    if (width == 0 || height == 0) continue; // minimised
    if (width != frame.viewport.width || height != frame.viewport.height) {
      allocate(colour, false, width, height, framebuffers[1]);
      allocate(depth, true, width, height, framebuffers[1]);
      frame.viewport = {0, 0, width, height};
    }
    const float scale = 1.7F * float(height) / float(width); // from 0.1 to infinity:
    const float projection[16] = {scale, 0, 0, 0, 0, 1.7F, 0, 0, 0, 0, -1, -1, 0, 0, -0.2F, 0};
    frame.camera.clipFromView = tyndall::mat4(projection);
    slide = std::sin(float(glfwGetTime()) / 2);
    drawBoxes(depthOnly, sunClip, framebuffers[0], 2048, 2048); // the shadow map
    gl.BindTexture(GL_TEXTURE_2D, shadowMap);
    drawBoxes(shaded, projection, framebuffers[1], width, height); // colour and depth
    const auto drawn = glfwGetKey(window, GLFW_KEY_SPACE) ? tyndall::Status() : effect->render(frame); // the shafts
    if (!drawn) return fail(drawn.message);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.BindTexture(GL_TEXTURE_2D, colour);
    gl.UseProgram(toneMap);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    glfwSwapBuffers(window);
  }
}
